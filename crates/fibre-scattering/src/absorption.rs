//! Absorption of the cortex from what people know about a head of hair: its colour or pigments.

use glam::Vec3;

/// Absorption per radius of eumelanin (brown to black) at unit concentration: d'Eon et al. 2011.
const EUMELANIN: Vec3 = Vec3::new(0.419, 0.697, 1.37);
/// The same of pheomelanin (yellow to red).
const PHEOMELANIN: Vec3 = Vec3::new(0.187, 0.4, 1.05);

/// The darkest colour there is: beyond it the absorption would be without bound.
const DARKEST: f32 = 1e-6;

/// Absorption per fibre radius that gives *a whole head of hair* under even light the albedo
/// `color` (linear, each in 0..1): Chiang et al. 2016, eq. 9.
///
/// The fit counts the light that goes from fibre to fibre; a fibre alone is brighter. `beta_n` is
/// the roughness around the fibre. Channels of 1 or more are not absorbed at all, channels below
/// 1e-6 (and NaN) count as 1e-6.
#[must_use]
pub fn absorption_from_color(color: Vec3, beta_n: f32) -> Vec3 {
    let b = beta_n;
    let divisor = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
    Vec3::from_array(color.to_array().map(|channel| {
        // Not `clamp`, which would keep NaN.
        let bounded = if channel > DARKEST { channel.min(1.0) } else { DARKEST };
        let ratio = bounded.ln() / divisor;
        ratio * ratio
    }))
}

/// Absorption per fibre radius from an amount of melanin and how red it is, both in 0..1.
///
/// `concentration` is perceptually even: the pigment is `-ln(1 - concentration)`, bounded at a
/// concentration of 0.9999, as in MaterialX and Cycles. `redness` is the share of pheomelanin. The
/// pigments' colours are those of [`absorption_from_pigments`], as in MaterialX (Cycles has
/// others). Arguments outside 0..1 are brought to the nearer bound.
#[must_use]
pub fn absorption_from_melanin(concentration: f32, redness: f32) -> Vec3 {
    let melanin = -(1.0 - concentration.clamp(0.0, 1.0)).max(1e-4).ln();
    let redness = redness.clamp(0.0, 1.0);
    absorption_from_pigments(melanin * (1.0 - redness), melanin * redness)
}

/// Absorption per fibre radius from the concentrations of the two pigments of hair, each at least 0
/// (human hair: eumelanin 0.3 blond, 1.3 brown, 8 black; pheomelanin 0..2): d'Eon et al. 2011.
#[must_use]
pub fn absorption_from_pigments(eumelanin: f32, pheomelanin: f32) -> Vec3 {
    eumelanin.max(0.0) * EUMELANIN + pheomelanin.max(0.0) * PHEOMELANIN
}
