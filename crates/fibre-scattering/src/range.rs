//! Values held to their ranges: refused by name, never brought to the nearer bound.

use std::f32::consts::FRAC_PI_2;
use std::ops::RangeInclusive;

use glam::Vec3;

use crate::error::ScatteringError;

/// `found`, if it lies in the range; NaN lies in none. `words` is what the user reads of the range.
pub(crate) fn within(
    name: &'static str,
    found: f32,
    range: RangeInclusive<f32>,
    words: &'static str,
) -> Result<f32, ScatteringError> {
    if range.contains(&found) {
        Ok(found)
    } else {
        Err(ScatteringError::OutOfRange { name, found, range: words })
    }
}

/// A share of the whole, in [0, 1].
pub(crate) fn share(name: &'static str, found: f32) -> Result<f32, ScatteringError> {
    within(name, found, 0.0..=1.0, "[0, 1]")
}

/// A finite value of at least 0.
pub(crate) fn not_negative(name: &'static str, found: f32) -> Result<f32, ScatteringError> {
    within(name, found, 0.0..=f32::MAX, "[0, infinity)")
}

/// Values each finite and at least 0.
pub(crate) fn none_negative<const N: usize>(
    names: [&'static str; N],
    found: [f32; N],
) -> Result<(), ScatteringError> {
    names.into_iter().zip(found).try_for_each(|(name, found)| not_negative(name, found).map(|_| ()))
}

/// Absorption coefficients of a cortex.
pub(crate) fn absorption(sigma_a: Vec3) -> Result<Vec3, ScatteringError> {
    none_negative(["sigma_a.r", "sigma_a.g", "sigma_a.b"], sigma_a.to_array())?;
    Ok(sigma_a)
}

/// Absorption coefficients of a medulla.
pub(crate) fn medulla_absorption(sigma_a: Vec3) -> Result<(), ScatteringError> {
    none_negative(["medulla.sigma_a.r", "medulla.sigma_a.g", "medulla.sigma_a.b"], sigma_a.to_array())
}

/// A roughness. A smoother lobe than 0.001 would be narrower than 0.05 degrees: single precision could not
/// place it.
pub(crate) fn roughness(name: &'static str, found: f32) -> Result<f32, ScatteringError> {
    within(name, found, 1e-3..=1.0, "[0.001, 1]")
}

/// A tilt in radians.
pub(crate) fn tilt(name: &'static str, found: f32) -> Result<f32, ScatteringError> {
    if found > -FRAC_PI_2 && found < FRAC_PI_2 {
        Ok(found)
    } else {
        Err(ScatteringError::OutOfRange { name, found, range: "(-pi/2, pi/2)" })
    }
}

/// An index of refraction over that of air.
pub(crate) fn index(name: &'static str, found: f32) -> Result<f32, ScatteringError> {
    within(name, found, 1.0001..=3.0, "[1.0001, 3]")
}
