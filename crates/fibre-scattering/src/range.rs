//! Values held to their ranges: refused by name, never brought to the nearer bound.

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

/// Absorption coefficients, each finite and at least 0.
pub(crate) fn absorption(sigma_a: Vec3) -> Result<Vec3, ScatteringError> {
    for (channel, found) in sigma_a.to_array().into_iter().enumerate() {
        if !(found.is_finite() && found >= 0.0) {
            return Err(ScatteringError::Absorption { channel, found });
        }
    }
    Ok(sigma_a)
}
