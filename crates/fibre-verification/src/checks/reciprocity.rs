//! What stays the same when the two directions, or the two sides of the fibre, change places.

use std::f64::consts::{FRAC_PI_2, PI};

use fibre_scattering::Absorption;

use crate::landmarks::azimuthal_scale;
use crate::quadrature::integral;
use crate::random::Random;
use crate::scatterer::{Model, View, direction, narrow};

/// Asymmetry of pairs of directions: the mean of |a - b| over the mean of (a + b) / 2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reciprocity {
    /// Averaged over the offset, both directions at the same inclination: symmetric without tilt.
    pub level: f64,
    /// Averaged over the offset, any two directions: f cos(theta_i) against its exchange.
    pub any: f64,
    /// Averaged over the offset, any two directions: f itself.
    pub any_f: f64,
    /// At a fixed offset, any two directions.
    pub near: f64,
}

/// f cos(theta_i), all lobes, green, in the best precision there is.
fn value(model: &dyn Model, view: View, absorption: Absorption, wi: [f64; 3]) -> f64 {
    match model.double_at(view, absorption) {
        Some(double) => double.evaluate_with_pdf(wi).0.iter().map(|lobe| lobe[1]).sum(),
        None => f64::from(model.at(view, absorption).evaluate_with_pdf(narrow(wi)).0.sum().y),
    }
}

/// The mean over the offset, with the offset's angle as the variable, so that grazing offsets are resolved.
pub(crate) fn over_offsets(model: &dyn Model, theta_o: f64, f: impl Fn(View) -> f64) -> f64 {
    // Lobes sweep the whole turn as the offset goes across, at most six times as fast as its angle.
    let scale = azimuthal_scale(&model.parameters().hair);
    let count = (4.0 / scale).clamp(12.0, 2000.0) as u32;
    let edges: Vec<f64> = (0..=count).map(|i| -FRAC_PI_2 + PI * f64::from(i) / f64::from(count)).collect();
    0.5 * integral(&edges, |gamma| gamma.cos() * f(View { theta_o, phi_o: 0.0, h: gamma.sin() }))
}

/// Exchanges the two directions of `pairs` random pairs.
#[must_use]
pub fn reciprocity(model: &dyn Model, absorption: Absorption, pairs: u32, seed: u64) -> Reciprocity {
    let mut random = Random::new(seed, 0x4ec);
    let mut sums = [(0.0_f64, 0.0_f64); 4];
    let mut push = |slot: usize, a: f64, b: f64| {
        sums[slot].0 += (a - b).abs();
        sums[slot].1 += 0.5 * (a + b);
    };
    for _ in 0..pairs {
        let angle = |u: f64| 1.3 * (2.0 * u - 1.0);
        let (theta_o, near) = (angle(random.fine()), angle(random.fine()));
        let phi = PI * (2.0 * random.fine() - 1.0);
        let h = 2.0 * random.fine() - 1.0;
        let averaged = |theta_o: f64, theta_i: f64, phi: f64| {
            let wi = direction(theta_i, phi);
            over_offsets(model, theta_o, |view| value(model, view, absorption, wi))
        };
        // Inclinations about the mirror's, where there is light.
        let theta_i = (-theta_o + 0.3 * near).clamp(-1.4, 1.4);
        let (there, back) = (averaged(theta_o, theta_i, phi), averaged(theta_i, theta_o, -phi));
        push(1, there, back);
        push(2, there / theta_i.cos(), back / theta_o.cos());
        push(0, averaged(theta_o, -theta_o, phi), averaged(-theta_o, theta_o, -phi));
        let fixed = |theta_o, theta_i, phi| {
            value(model, View { theta_o, phi_o: 0.0, h }, absorption, direction(theta_i, phi))
        };
        push(3, fixed(theta_o, theta_i, phi), fixed(theta_i, theta_o, -phi));
    }
    let [level, any, any_f, near] = sums.map(|(off, mean)| if mean > 0.0 { off / mean } else { 0.0 });
    Reciprocity { level, any, any_f, near }
}

/// Worst relative change when offset and azimuth change their signs together: none, by the fibre's symmetry.
#[must_use]
pub fn mirror_symmetry(model: &dyn Model, view: View, absorption: Absorption, count: u32, seed: u64) -> f64 {
    let (left, right) = (model.at(view, absorption), model.at(View { h: -view.h, ..view }, absorption));
    let mut random = Random::new(seed, 0x513);
    let mut worst = 0.0_f64;
    for _ in 0..count {
        let Some(sample) = left.sample(random.four()) else { continue };
        let mut wi = sample.wi;
        wi.z = -wi.z;
        let (values, pdf) = right.evaluate_with_pdf(wi);
        let pairs = [(sample.pdf, pdf), (sample.values.sum().element_sum(), values.sum().element_sum())];
        for (a, b) in pairs {
            let off = f64::from((a - b).abs() / a.max(b).max(f32::MIN_POSITIVE));
            worst = if off.is_nan() { f64::INFINITY } else { worst.max(off) };
        }
    }
    worst
}
