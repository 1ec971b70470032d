//! The offset across the fibre integrated out, in closed form cell by cell.
//!
//! N_p of the far field is half the integral over h of `A_p(h) D(phi - Phi_p(h))`. Cut into cells in which A is
//! constant and Phi goes evenly from end to end, each cell's part is the logistic blurred by a box, which has
//! a closed form, where a quadrature by nodes would leave a row of peaks. Cells are even in the angle
//! `asin(h)` and not in h: Phi is nearly even in that, and R exactly so.
//!
//! A box joined to its neighbour of another height leaves a step; a logistic at least half as wide as the box
//! (half against half) smooths it. Whatever the cells, they hold all the light: the weights sum to 1 and each
//! density integrates to 1.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::Vec4;

use crate::arithmetic::lanes::Lanes;
use crate::hair::attenuation::{Chord, attenuations_of_three};
use crate::hair::ellipse::{Crossing, Ellipse};
use crate::hair::fibre::Fibre;

/// Logistics are no narrower than this part of their box's half-width.
const SMOOTHING: f32 = 0.5;
/// Boxes are no narrower than this part of the logistic, whose variance that raises by a four-thousandth.
const NARROWEST: f32 = 0.05;
/// What f32's turn is short of a full one.
const TAU_REST: f32 = -1.748_455_6e-7;
const PI32: f32 = std::f32::consts::PI;
const TAU32: f32 = std::f32::consts::TAU;

/// Where a material's cells lie across the fibre: the ends and the middle of each.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    /// One more than cells: `asin(h)`.
    gammas: Vec<f32>,
    /// The offset at each end.
    ends: Vec<f32>,
    middles: Vec<f32>,
    /// The part of the width each cell has.
    weights: Vec<f32>,
}

impl Places {
    pub fn new(cells: u32) -> Self {
        let gamma = |end: f64| (end / f64::from(cells) * 2.0 - 1.0) * FRAC_PI_2;
        let all = || (0..cells).map(f64::from);
        Places {
            gammas: all().chain([f64::from(cells)]).map(|end| gamma(end) as f32).collect(),
            ends: all().chain([f64::from(cells)]).map(|end| gamma(end).sin() as f32).collect(),
            middles: all().map(|cell| gamma(cell + 0.5).sin() as f32).collect(),
            weights: all().map(|cell| (0.5 * (gamma(cell + 1.0).sin() - gamma(cell).sin())) as f32).collect(),
        }
    }
}

/// One cell's part of the four lobes, one lobe a lane. The residual's is the same all around.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cell {
    centre: Vec4,
    /// Half of the box.
    half: Vec4,
    inverse_scale: Vec4,
    /// `(1 - exp(-2 half / s)) / (2 half k)`, k the share of the logistic inside one turn.
    height: Vec4,
    /// `1 / (2 half k)`, 0 for the residual.
    inverse_width: Vec4,
    /// The share of the logistic, untrimmed, beyond one end of the turn.
    beyond: Vec4,
    /// Share carried, per channel, and chance.
    pub channels: [Vec4; 3],
    pub chance: Vec4,
}

/// What light does inside one cell: ends and middle of the lobes' azimuths, and what they carry.
struct Section {
    /// Azimuth of R, TT and TRT in the middle, in [-pi, pi].
    centre: [f32; 3],
    /// By how much it goes from the middle to either end.
    half: [f32; 3],
    channels: [Vec4; 3],
}

/// All cells of a fibre seen from `(cos_theta, turn)`, with weights and attenuations; chances not yet shared out.
pub(crate) fn cells(places: &Places, fibre: &Fibre<f32>, cos_theta: f32, turn: [f32; 2]) -> Vec<Cell> {
    match fibre.ellipse {
        None => round(places, fibre, cos_theta),
        Some(ellipse) => elliptical(places, fibre, ellipse, cos_theta, turn),
    }
}

fn round(places: &Places, fibre: &Fibre<f32>, cos_theta: f32) -> Vec<Cell> {
    let count = places.middles.len();
    let e = fibre.surface.eta2_minus_1;
    let inside = cos_theta / (e + cos_theta * cos_theta).sqrt();
    // The left half; the right one is its mirror image.
    let half = count.div_ceil(2);
    let mut cells: Vec<Cell> = Vec::with_capacity(count);
    let ends = places.gammas.iter().zip(&places.ends).map(|(&gamma, &h)| (gamma, (h * inside).asin()));
    let spans = ends.clone().zip(ends.skip(1));
    for ((((gamma_0, inner_0), (gamma_1, inner_1)), &h), &weight) in
        spans.zip(&places.middles).zip(&places.weights).take(half)
    {
        let chord = Chord::under(&fibre.surface, cos_theta, h);
        let lobes = chord.attenuations_through(fibre.sigma_a.map(|sigma| sigma * chord.length));
        let channel = |c: usize| Vec4::new(lobes[0][c], lobes[1][c], lobes[2][c], lobes[3][c]);
        let exit = |p: f32, start: f32| wrapped(p * (inner_0 + inner_1) - (gamma_0 + gamma_1) + start);
        let reach = |p: f32| (p * (inner_1 - inner_0) - (gamma_1 - gamma_0)).abs();
        cells.push(fibre.cell(
            &Section {
                centre: [exit(0.0, 0.0), exit(1.0, PI32), exit(2.0, 0.0)],
                half: [reach(0.0), reach(1.0), reach(2.0)],
                channels: [channel(0), channel(1), channel(2)],
            },
            weight,
        ));
    }
    for mirrored in (0..count - half).rev() {
        let cell = cells[mirrored];
        cells.push(Cell { centre: -cell.centre, ..cell });
    }
    cells
}

fn elliptical(
    places: &Places,
    fibre: &Fibre<f32>,
    ellipse: Ellipse,
    cos_theta: f32,
    turn: [f32; 2],
) -> Vec<Cell> {
    let crossing = |h: f32| {
        let e = f64::from(fibre.surface.eta2_minus_1);
        ellipse.crossing(e, f64::from(cos_theta), turn.map(f64::from), f64::from(h))
    };
    let ends: Vec<Crossing> = places.ends.iter().map(|&h| crossing(h)).collect();
    let spans = ends.iter().zip(ends.iter().skip(1));
    spans
        .zip(places.middles.iter().zip(&places.weights))
        .map(|((from, to), (&h, &weight))| {
            let middle = crossing(h);
            let between =
                |a: (f64, f64), b: (f64, f64)| f64::atan2(a.0 * b.1 - a.1 * b.0, a.0 * b.0 + a.1 * b.1);
            // By way of the middle: the whole may be more than half a turn.
            let part = |p: usize| {
                let (first, second) =
                    (between(from.turns[p], middle.turns[p]), between(middle.turns[p], to.turns[p]));
                let start = from.turns[p].1.atan2(from.turns[p].0);
                let whole = 0.5 * (first + second);
                (wrapped((start + whole) as f32), whole.abs().min(PI) as f32)
            };
            let parts = [part(0), part(1), part(2)];
            let reflected = middle.cos2.map(|cos2| fibre.surface.reflectance_of_leaving(cos2 as f32));
            let sigma_a = Vec4::new(fibre.sigma_a[0], fibre.sigma_a[1], fibre.sigma_a[2], 0.0);
            let lengths = middle.lengths.map(|length| length as f32);
            let section = Section {
                centre: parts.map(|part| part.0),
                half: parts.map(|part| part.1),
                channels: channels(sigma_a, |sigma| {
                    attenuations_of_three(reflected, lengths.map(|length| sigma * length))
                }),
            };
            fibre.cell(&section, weight)
        })
        .collect()
}

/// Per channel the four lobes' attenuations, worked out once where channels are alike.
fn channels(depths: Vec4, attenuations: impl Fn(f32) -> [f32; 4]) -> [Vec4; 3] {
    let red = Vec4::from_array(attenuations(depths.x));
    let of = |depth: f32| if depth == depths.x { red } else { Vec4::from_array(attenuations(depth)) };
    [red, of(depths.y), of(depths.z)]
}

impl Fibre<f32> {
    fn cell(&self, section: &Section, weight: f32) -> Cell {
        let lanes = |[r, tt, trt]: [f32; 3]| Vec4::new(r, tt, trt, 0.0);
        let scale = lanes(self.azimuthal_scales());
        let reach = lanes(section.half);
        let scale = scale.max(reach * SMOOTHING);
        let half = reach.max(scale * NARROWEST);
        let last = Vec4::new(0.0, 0.0, 0.0, 1.0);
        let inverse_scale = (Vec4::ONE - last) / (scale + last);
        let edge = (inverse_scale * PI32).exp_of_minus();
        let below = Vec4::ONE + edge;
        let (_, filled) = (half * inverse_scale * 2.0).fall_and_rest();
        let inverse_width = (Vec4::ONE - last) * below / ((half + last) * 2.0 * (Vec4::ONE - edge) + last);
        let weights = Vec4::from_array(self.four_weights()) * weight;
        let channels = section.channels.map(|channel| channel * weights);
        Cell {
            centre: lanes(section.centre),
            half,
            inverse_scale,
            height: filled * inverse_width + last * (4.0 / TAU32),
            inverse_width,
            beyond: edge / below,
            chance: channels[0].max(channels[1]).max(channels[2]),
            channels,
        }
    }
}

impl Cell {
    /// Each lobe's density at an azimuth in [-pi, pi].
    ///
    /// The logistic's integral from `lo` to `hi` is `(1 - exp(lo - hi)) / ((1 + exp(lo)) (1 + exp(-hi)))`, with
    /// nothing to cancel. Where the box goes past the far side of the fibre, what lies beyond it is taken off
    /// and what comes round from the other end is added.
    #[inline(always)]
    pub fn densities(&self, phi: f32) -> Vec4 {
        let apart = (Vec4::splat(phi) - self.centre).abs();
        let around = (Vec4::splat(TAU32) - apart) + Vec4::splat(TAU_REST);
        let x = apart.min(around).max(Vec4::ZERO);
        let (low, high) = (x - self.half, x + self.half);
        let fall_low = (low.abs() * self.inverse_scale).exp_of_minus();
        let fall_high = (high * self.inverse_scale).exp_of_minus();
        let near = Vec4::ONE / (Vec4::ONE + fall_low);
        let left_of = Vec4::select(low.cmplt(Vec4::ZERO), near, fall_low * near);
        let beyond_high = fall_high / (Vec4::ONE + fall_high);
        let within = self.height * left_of * (Vec4::ONE - beyond_high);
        let past = high.cmpgt(Vec4::splat(PI32));
        if !past.any() {
            return within;
        }
        let back = (Vec4::splat(TAU32) - high).max(Vec4::ZERO);
        let fall_back = (back * self.inverse_scale).exp_of_minus();
        let come_round = beyond_high + fall_back / (Vec4::ONE + fall_back) - self.beyond * 2.0;
        within + Vec4::select(past, (come_round * self.inverse_width).max(Vec4::ZERO), Vec4::ZERO)
    }

    /// An azimuth distributed as lobe `p`'s density says, one of R, TT and TRT, from two uniform numbers;
    /// within three half turns.
    pub fn sample(&self, p: usize, place: f32, u: f32) -> f32 {
        let beyond = self.beyond[p];
        let inside = 1.0 - 2.0 * beyond;
        let before = beyond + inside * u;
        let after = beyond + inside * (1.0 - u);
        let logistic = ((before / after).ln() / self.inverse_scale[p]).clamp(-PI32, PI32);
        self.centre[p] + self.half[p] * (2.0 * place - 1.0) + logistic
    }
}

/// The same angle in [-pi, pi], for angles within a turn and a half of it.
fn wrapped(angle: f32) -> f32 {
    let turns = (angle / TAU32).round();
    (angle - turns * TAU32) - turns * TAU_REST
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hair::parameters::HairParameters;

    /// Boxes of every width, over logistics of every width, where they cross the far side and where not.
    #[test]
    fn densities_integrate_to_one_and_are_those_of_the_definition() {
        for (beta_n, nodes) in [(0.05, 1), (0.05, 2), (0.3, 3), (0.3, 9), (0.8, 1), (0.8, 4), (1.0, 2)] {
            let fibre = Fibre::<f32>::new(&HairParameters { beta_n, ..HairParameters::default() });
            for cell in cells(&Places::new(nodes), &fibre, 0.8, [1.0, 0.0]) {
                let count = 20_000;
                let mut sum = [0.0; 4];
                for step in 0..count {
                    let phi = ((f64::from(step) + 0.5) / f64::from(count) * 2.0 - 1.0) * PI;
                    let found = cell.densities(phi as f32).to_array();
                    for p in 0..4 {
                        sum[p] += f64::from(found[p]) * 2.0 * PI / f64::from(count);
                    }
                    if step % 997 == 0 {
                        for p in 0..3 {
                            let exact = by_definition(&cell, p, phi);
                            assert!(
                                (f64::from(found[p]) - exact).abs() < 1e-4 * exact.max(0.01),
                                "{phi} {p} {found:?} {exact} {cell:?}"
                            );
                        }
                    }
                }
                assert!(sum.iter().all(|sum| (sum - 1.0).abs() < 1e-5), "{sum:?} {cell:?}");
            }
        }
    }

    /// The trimmed logistic, a turn's copy after another, averaged over the box.
    fn by_definition(cell: &Cell, p: usize, phi: f64) -> f64 {
        let scale = 1.0 / f64::from(cell.inverse_scale[p]);
        let inside = (PI / 2.0 / scale).tanh();
        let count = 4000;
        let mut sum = 0.0;
        for step in 0..count {
            let place = (f64::from(step) + 0.5) / f64::from(count) * 2.0 - 1.0;
            let x = phi - f64::from(cell.centre[p]) - f64::from(cell.half[p]) * place;
            let x = x - 2.0 * PI * (x / (2.0 * PI)).round();
            let fall = (-x.abs() / scale).exp();
            sum += fall / ((1.0 + fall) * (1.0 + fall) * scale * inside) / f64::from(count);
        }
        sum
    }
}
