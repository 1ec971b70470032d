//! The fibre seen from afar: scattering with the offset across the fibre integrated out.

use glam::{Vec3, Vec4};

use crate::arithmetic::real::Real;
use crate::error::ScatteringError;
use crate::hair::azimuthal::RESIDUAL;
use crate::hair::far_cells::{Cell, Places, cells};
use crate::hair::fibre::{Fibre, inclination_and_turn};
use crate::hair::longitudinal::{Inclination, Longitudinal, Mirrors};
use crate::hair::parameters::HairParameters;
use crate::lobe::{Lobe, LobeValues};
use crate::per_strand::Absorption;
use crate::sample::FibreSample;

/// A hair material whose offset is integrated over, for fibres that are narrower than a pixel: as if every hit
/// met all of the fibre's width. Less noise for the same look; what one misses is what only a near fibre shows.
///
/// `nodes` is the accuracy: the width is cut into so many cells. Against the mean of 4,096 offsets the error
/// falls with their square; whatever their number, energy is exact, and sampling follows the pdf.
#[derive(Debug, Clone)]
pub struct FarFieldBcsdf {
    fibre: Fibre<f32>,
    places: Places,
}

impl FarFieldBcsdf {
    /// Prepares a material; `nodes` in 1..=64. 16 are enough for most hair.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter outside its bounds.
    pub fn new(parameters: &HairParameters, nodes: u32) -> Result<FarFieldBcsdf, ScatteringError> {
        parameters.check()?;
        if !(1..=64).contains(&nodes) {
            return Err(ScatteringError::OutOfRange { name: "nodes", found: nodes as f32, range: "1..=64" });
        }
        Ok(FarFieldBcsdf { fibre: Fibre::new(parameters), places: Places::new(nodes) })
    }

    /// The fibre as seen from `wo`, with this absorption: see [`HairBcsdf::at`](crate::HairBcsdf::at). Much
    /// dearer than that of the near field: every cell is worked out here.
    #[must_use]
    pub fn at(&self, wo: Vec3, absorption: Absorption) -> FarFieldScatter {
        let mut fibre = self.fibre;
        fibre.sigma_a = absorption.cortex().to_array();
        let (theta_o, turn_o) = inclination_and_turn(wo.to_array());
        let mut cells = cells(&self.places, &fibre, theta_o.cos.min(1.0), turn_o);
        let sum = cells.iter().fold(Vec4::ZERO, |sum, cell| sum + cell.chance);
        let all = sum.element_sum();
        let share = if all > 0.0 { 1.0 / all } else { 0.0 };
        for cell in &mut cells {
            cell.chance *= share;
        }
        let (mirrors, along) = fibre.longitudinal(theta_o);
        FarFieldScatter { turn_o, mirrors, along, chances: sum * share, cells }
    }
}

/// A fibre met by a ray, wherever it was met.
#[derive(Debug, Clone)]
pub struct FarFieldScatter {
    turn_o: [f32; 2],
    mirrors: Mirrors<f32>,
    along: Longitudinal<f32>,
    /// Chance of each lobe, over all cells.
    chances: Vec4,
    cells: Vec<Cell>,
}

impl FarFieldScatter {
    /// As [`HairScatter::evaluate_with_pdf`](crate::HairScatter::evaluate_with_pdf).
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        let [cos_o, sin_o] = self.turn_o;
        let phi = (wi.z * cos_o - wi.y * sin_o).atan2(wi.y * cos_o + wi.z * sin_o);
        let (mut channels, mut chance) = ([Vec4::ZERO; 3], Vec4::ZERO);
        for cell in &self.cells {
            let densities = cell.densities(phi);
            for (sum, &channel) in channels.iter_mut().zip(&cell.channels) {
                *sum += channel * densities;
            }
            chance += cell.chance * densities;
        }
        let theta_i = Inclination { sin: wi.x, cos: (wi.y * wi.y + wi.z * wi.z).sqrt() };
        let along: Vec4 = self.along.densities(theta_i, &self.mirrors);
        let [red, green, blue] = channels.map(|channel| (channel * along).to_array());
        let value = |p: usize| Vec3::new(red[p], green[p], blue[p]);
        (LobeValues([value(0), value(1), value(2), value(3), Vec3::ZERO]), chance.dot(along))
    }

    /// As [`HairScatter::evaluate`](crate::HairScatter::evaluate).
    #[must_use]
    pub fn evaluate(&self, wi: Vec3) -> LobeValues {
        self.evaluate_with_pdf(wi).0
    }

    /// As [`HairScatter::pdf`](crate::HairScatter::pdf).
    #[must_use]
    pub fn pdf(&self, wi: Vec3) -> f32 {
        self.evaluate_with_pdf(wi).1
    }

    /// As [`HairScatter::sample`](crate::HairScatter::sample); the first number picks the cell, too.
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> Option<FibreSample> {
        let (p, left) = chosen(u[0], self.chances.to_array())?;
        let phi = if p == RESIDUAL {
            std::f32::consts::TAU * u[3]
        } else {
            let of_lobe = self.cells.iter().map(|cell| cell.chance[p]);
            let (cell, place) = chosen(left * self.chances[p], of_lobe)?;
            self.cells.get(cell)?.sample(p, place, u[3])
        };
        let ln_drop = self.along.drop(p, u[1]).ln_1p();
        let theta_i =
            self.along.sample(p, &self.mirrors, ln_drop, Real::sin_cos(std::f32::consts::TAU * u[2]));
        let (sin, cos) = Real::sin_cos(phi);
        let [cos_o, sin_o] = self.turn_o;
        let wi = Vec3::new(
            theta_i.sin,
            theta_i.cos * (cos * cos_o - sin * sin_o),
            theta_i.cos * (sin * cos_o + cos * sin_o),
        );
        let (values, pdf) = self.evaluate_with_pdf(wi);
        (pdf > 0.0 && pdf.is_finite()).then_some(FibreSample { wi, values, pdf, lobe: Lobe::ALL[p] })
    }

    /// As [`HairScatter::albedo`](crate::HairScatter::albedo).
    #[must_use]
    pub fn albedo(&self) -> [Vec3; 5] {
        let sum = |channel: usize| {
            self.cells.iter().fold(Vec4::ZERO, |sum, cell| sum + cell.channels[channel]).to_array()
        };
        let [red, green, blue] = [sum(0), sum(1), sum(2)];
        let lobe = |p: usize| Vec3::new(red[p], green[p], blue[p]);
        [lobe(0), lobe(1), lobe(2), lobe(3), Vec3::ZERO]
    }
}

/// Which of several chances a number falls on, and how far along it, in [0, 1); the last that is none when
/// rounding leaves no other.
fn chosen(u: f32, chances: impl IntoIterator<Item = f32>) -> Option<(usize, f32)> {
    let mut left = u;
    let mut last = None;
    for (index, chance) in chances.into_iter().enumerate() {
        if chance > 0.0 {
            // Rounding may leave a little less than nothing, or more than the last chance there is.
            last = Some((index, (left / chance).clamp(0.0, 1.0 - f32::EPSILON / 2.0)));
            if left < chance {
                break;
            }
            left -= chance;
        }
    }
    last
}
