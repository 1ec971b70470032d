//! What describes a fibre, and the bounds it is held to.

use std::f32::consts::FRAC_PI_2;

use glam::Vec3;

use crate::error::ScatteringError;

/// Roughness below this is taken as this: the lobe is then already narrower than 0.05 degrees, and
/// single precision could not place it better.
pub(crate) const SMALLEST_ROUGHNESS: f32 = 1e-3;

const ETA_MIN: f32 = 1.0001;
const ETA_MAX: f32 = 3.0;

/// A hair fibre as Chiang et al. 2016 describe it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairParameters {
    /// Roughness along the fibre, in (0, 1]; below 0.001 counts as 0.001.
    pub beta_m: f32,
    /// Roughness around the fibre, in (0, 1]; below 0.001 counts as 0.001.
    pub beta_n: f32,
    /// Tilt of the cuticle's scales against the fibre, in radians, in (-pi/2, pi/2). Positive for
    /// real hair, whose scales open towards the tip: see the crate's page for the direction in
    /// which lobes move.
    pub alpha: f32,
    /// Index of refraction of the fibre over that of what surrounds it, in [1.0001, 3].
    pub eta: f32,
    /// Absorption of the cortex in red, green and blue, per fibre *radius*; at least 0.
    pub sigma_a: Vec3,
    /// Look development: what each lobe is multiplied by (1 is physical); at least 0. The order is
    /// that of [`Lobe::ALL`](crate::Lobe::ALL).
    pub lobe_weights: [f32; 4],
}

impl Default for HairParameters {
    /// A white human hair: `beta_m` and `beta_n` 0.3, tilt 2 degrees, `eta` 1.55, no absorption.
    fn default() -> Self {
        HairParameters {
            beta_m: 0.3,
            beta_n: 0.3,
            alpha: 2.0_f32.to_radians(),
            eta: 1.55,
            sigma_a: Vec3::ZERO,
            lobe_weights: [1.0; 4],
        }
    }
}

impl HairParameters {
    /// Checks every bound stated on the fields.
    ///
    /// # Errors
    /// The first bound broken, as a [`ScatteringError`]; NaN breaks every bound.
    pub fn check(&self) -> Result<(), ScatteringError> {
        for (name, found) in [("beta_m", self.beta_m), ("beta_n", self.beta_n)] {
            if !(found > 0.0 && found <= 1.0) {
                return Err(ScatteringError::Roughness { name, found });
            }
        }
        if !(self.alpha > -FRAC_PI_2 && self.alpha < FRAC_PI_2) {
            return Err(ScatteringError::Tilt { found: self.alpha });
        }
        if !(ETA_MIN..=ETA_MAX).contains(&self.eta) {
            return Err(ScatteringError::IndexOfRefraction { found: self.eta });
        }
        for (channel, found) in self.sigma_a.to_array().into_iter().enumerate() {
            if !(found.is_finite() && found >= 0.0) {
                return Err(ScatteringError::Absorption { channel, found });
            }
        }
        for (lobe, found) in self.lobe_weights.into_iter().enumerate() {
            if !(found.is_finite() && found >= 0.0) {
                return Err(ScatteringError::LobeWeight { lobe, found });
            }
        }
        Ok(())
    }
}
