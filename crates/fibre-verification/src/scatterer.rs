//! What the checks ask of a model: so little that another one, or a broken one, can be put in its place.

use fibre_scattering::{
    Absorption, FibreSample, FibreScatter, FurParameters, FurReferenceScatter, LobeValues, ReferenceScatter,
};
use glam::Vec3;

use crate::landmarks::Landmarks;

/// A direction a fibre is seen from, and where across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Inclination of the outgoing direction, in radians.
    pub theta_o: f64,
    /// Its azimuth, in radians: of account for elliptical fibres only, 0 for others.
    pub phi_o: f64,
    /// Offset across the fibre, in -1..1.
    pub h: f64,
}

impl View {
    /// From an inclination in degrees.
    #[must_use]
    pub fn degrees(theta_o: f64, h: f64) -> View {
        View { theta_o: theta_o.to_radians(), phi_o: 0.0, h }
    }

    /// The same view from another azimuth, in degrees.
    #[must_use]
    pub fn turned(self, phi_o: f64) -> View {
        View { phi_o: phi_o.to_radians(), ..self }
    }

    /// The outgoing direction as the model is given it, in single precision.
    #[must_use]
    pub fn wo(&self) -> Vec3 {
        narrow(direction(self.theta_o, self.phi_o))
    }

    /// In words, for tables: `theta 30°, h 0.5`.
    #[must_use]
    pub fn words(&self) -> String {
        let (theta, phi) = (round(self.theta_o.to_degrees(), 1e6), round(self.phi_o.to_degrees(), 1e6));
        let turned = if phi == 0.0 { String::new() } else { format!(", phi {phi}°") };
        format!("theta {theta}°{turned}, h {}", round(self.h, 1e6))
    }
}

/// Without the noise of degrees and radians: to a multiple of 1 over `digits`.
pub(crate) fn round(x: f64, digits: f64) -> f64 {
    (x * digits).round() / digits + 0.0
}

/// Scattering as a function of the other direction: what a renderer calls.
pub trait Scatterer: Sync {
    /// f cos(theta_i) of each lobe and the density of [`Scatterer::sample`] per steradian.
    fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32);
    /// A direction from four uniform numbers.
    fn sample(&self, u: [f32; 4]) -> Option<FibreSample>;
    /// The share of light each lobe says it scatters.
    fn albedo(&self) -> [Vec3; 5];
}

/// The same function in double precision.
pub trait DoubleScatterer: Sync {
    /// f cos(theta_i) of each lobe and the density per steradian.
    fn evaluate_with_pdf(&self, wi: [f64; 3]) -> ([[f64; 3]; 5], f64);
}

/// A material whose scattering is checked.
pub trait Model: Sync {
    /// What it was made of.
    fn parameters(&self) -> &FurParameters;
    /// The fibre from `view`, with this absorption in place of its own.
    fn at(&self, view: View, absorption: Absorption) -> Box<dyn Scatterer + '_>;
    /// The same in double precision, where there is such a path.
    fn double_at(&self, view: View, absorption: Absorption) -> Option<Box<dyn DoubleScatterer + '_>>;
    /// Where its lobes lie, for the quadrature to find them.
    fn landmarks(&self, view: View) -> Landmarks;

    /// Whether the offset across the fibre counts.
    fn is_near(&self) -> bool {
        true
    }

    /// The same material without tilt, where it can be had.
    fn upright(&self) -> Option<Box<dyn Model + '_>> {
        None
    }

    /// The absorption of its own parameters.
    fn absorption(&self) -> Absorption {
        let FurParameters { hair, medulla } = self.parameters();
        // The parameters of a model have passed their check, and these bounds with it.
        Absorption::new(hair.sigma_a, medulla.sigma_a).unwrap_or_default()
    }
}

impl Scatterer for FibreScatter<'_> {
    fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        FibreScatter::evaluate_with_pdf(self, wi)
    }

    fn sample(&self, u: [f32; 4]) -> Option<FibreSample> {
        FibreScatter::sample(self, u)
    }

    fn albedo(&self) -> [Vec3; 5] {
        FibreScatter::albedo(self)
    }
}

impl DoubleScatterer for ReferenceScatter {
    fn evaluate_with_pdf(&self, wi: [f64; 3]) -> ([[f64; 3]; 5], f64) {
        ReferenceScatter::evaluate_with_pdf(self, wi)
    }
}

impl DoubleScatterer for FurReferenceScatter<'_> {
    fn evaluate_with_pdf(&self, wi: [f64; 3]) -> ([[f64; 3]; 5], f64) {
        FurReferenceScatter::evaluate_with_pdf(self, wi)
    }
}

/// The unit direction of an inclination and an azimuth, in radians.
#[must_use]
pub fn direction(theta: f64, phi: f64) -> [f64; 3] {
    let (sin, cos) = theta.sin_cos();
    [sin, cos * phi.cos(), cos * phi.sin()]
}

/// A direction in single precision.
#[must_use]
pub fn narrow(direction: [f64; 3]) -> Vec3 {
    Vec3::from_array(direction.map(|x| x as f32))
}

/// The unit direction nearest to one in single precision.
#[must_use]
pub fn widened(direction: Vec3) -> [f64; 3] {
    direction.as_dvec3().normalize_or_zero().to_array()
}

/// Inclination and azimuth of a direction.
#[must_use]
pub fn angles([x, y, z]: [f64; 3]) -> (f64, f64) {
    (x.atan2(y.hypot(z)), z.atan2(y))
}
