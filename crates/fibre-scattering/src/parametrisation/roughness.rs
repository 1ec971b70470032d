//! From the spread of a lobe back to the roughness that gives it: Chiang et al. 2016, eqs. 7 and 8, inverted.

use crate::error::ScatteringError;
use crate::hair::parameters::{azimuthal_deviation, longitudinal_variance};

/// The roughness along the fibre whose R lobe has the variance `v`, in (0, 27.436], in radians squared where
/// it is small: the inverse of eq. 7, `v = (0.726 b + 0.812 b^2 + 3.7 b^20)^2`.
///
/// # Errors
/// [`ScatteringError::OutOfRange`] for a variance that no roughness in (0, 1] gives.
pub fn beta_m_from_variance(v: f32) -> Result<f32, ScatteringError> {
    refused("longitudinal variance v", v, longitudinal_variance, "(0, 27.436], which beta_m in (0, 1] gives")
}

/// The roughness around the fibre whose logistic has the scale `s` times the root of pi/8, s in (0, 6.831]:
/// the inverse of eq. 8, `s = 0.265 b + 1.194 b^2 + 5.372 b^22`.
///
/// That root is MaterialX's to apply and not part of its `s`; times the root it is pbrt's and Cycles' `s`.
///
/// # Errors
/// [`ScatteringError::OutOfRange`] for a scale that no roughness in (0, 1] gives.
pub fn beta_n_from_scale(s: f32) -> Result<f32, ScatteringError> {
    refused("azimuthal scale s", s, azimuthal_deviation, "(0, 6.831], which beta_n in (0, 1] gives")
}

/// A roughness that was worked out from `found`, which is what is refused where the roughness is below 0.001.
pub(super) fn of_spread(
    name: &'static str,
    found: f32,
    roughness: Result<f32, ScatteringError>,
    range: &'static str,
) -> Result<f32, ScatteringError> {
    const LEAST: f32 = 1e-3;
    match roughness {
        // That of 0.001 itself may come back less by its rounding.
        Ok(beta) if beta >= LEAST * (1.0 - 1e-6) => Ok(beta.max(LEAST)),
        _ => Err(ScatteringError::OutOfRange { name, found, range }),
    }
}

fn refused(
    name: &'static str,
    found: f32,
    spread: fn(f64) -> f64,
    range: &'static str,
) -> Result<f32, ScatteringError> {
    // Rounding to f32 must not put the spread of the greatest roughness out of reach.
    let greatest = spread(1.0) as f32;
    if !(found > 0.0 && found <= greatest) {
        return Err(ScatteringError::OutOfRange { name, found, range });
    }
    let beta = inverse(spread, f64::from(found)) as f32;
    Ok(beta.clamp(f32::MIN_POSITIVE, 1.0))
}

/// Where a spread, which grows with the roughness, reaches `target`: by bisection down to neighbours in f64,
/// the smaller of which may be 0 no longer than the target is.
fn inverse(spread: fn(f64) -> f64, target: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    // Each halving gives one bit: f64's 53 and as many again for roughness as small as f32's smallest.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if spread(middle) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
