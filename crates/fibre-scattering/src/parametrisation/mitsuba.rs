//! Mitsuba 3's `hair` plugin.

use glam::Vec3;

use super::{exclusive, tilt};
use crate::absorption::Pigments;
use crate::error::ScatteringError;
use crate::hair::parameters::HairParameters;
use crate::range;

/// The parameters of Mitsuba 3's `hair` plugin and its defaults.
///
/// Exact: the same model, but for Mitsuba's series for the Bessel function, which is up to 0.5 % off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MitsubaHair {
    /// Concentration of eumelanin, at least 0; 1.3 where neither it nor `sigma_a` is given.
    pub eumelanin: Option<f32>,
    /// Concentration of pheomelanin, at least 0; 0.2 where neither it nor `sigma_a` is given.
    pub pheomelanin: Option<f32>,
    /// Absorption in place of pigments, at least 0; times `scale` it is per fibre radius.
    pub sigma_a: Option<Vec3>,
    /// Factor on `sigma_a`, at least 0; of no account for pigments.
    pub scale: f32,
    /// Index of refraction of the fibre: amber.
    pub int_ior: f32,
    /// Index of refraction around it: air, which Mitsuba does not take for 1.
    pub ext_ior: f32,
    /// Roughness along the fibre, in [0.001, 1].
    pub longitudinal_roughness: f32,
    /// Roughness around the fibre, in [0.001, 1].
    pub azimuthal_roughness: f32,
    /// Tilt of the scales in *degrees*, with Mitsuba's sign, which is pbrt's.
    pub scale_tilt: f32,
}

impl Default for MitsubaHair {
    fn default() -> Self {
        MitsubaHair {
            eumelanin: None,
            pheomelanin: None,
            sigma_a: None,
            scale: 1.0,
            int_ior: 1.55,
            ext_ior: 1.000_277,
            longitudinal_roughness: 0.3,
            azimuthal_roughness: 0.3,
            scale_tilt: 2.0,
        }
    }
}

impl MitsubaHair {
    /// The same hair in this crate's parameters.
    ///
    /// Source: Mitsuba 3, `src/bsdfs/hair.cpp`; the pigments are [`Pigments::DEON`]. `eta` is `int_ior` over
    /// `ext_ior`; the tilt changes its sign, as for [`PbrtHair`](super::PbrtHair).
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter out of its range, or pigments and `sigma_a` at once.
    pub fn parameters(&self) -> Result<HairParameters, ScatteringError> {
        let pigments = self.eumelanin.is_some() || self.pheomelanin.is_some();
        exclusive(("sigma_a", self.sigma_a.is_some()), ("eumelanin or pheomelanin", pigments))?;
        let sigma_a = match self.sigma_a {
            Some(sigma_a) => range::absorption(sigma_a)? * range::not_negative("scale", self.scale)?,
            None => {
                Pigments::DEON.absorption(self.eumelanin.unwrap_or(1.3), self.pheomelanin.unwrap_or(0.2))?
            }
        };
        for (name, found) in [("int_ior", self.int_ior), ("ext_ior", self.ext_ior)] {
            range::within(name, found, 1.0..=10.0, "[1, 10]")?;
        }
        let eta = self.int_ior / self.ext_ior;
        if range::index("eta", eta).is_err() {
            let range = "[1.0001, 3] times ext_ior";
            return Err(ScatteringError::OutOfRange { name: "int_ior", found: self.int_ior, range });
        }
        for (name, found) in [
            ("longitudinal_roughness", self.longitudinal_roughness),
            ("azimuthal_roughness", self.azimuthal_roughness),
        ] {
            range::roughness(name, found)?;
        }
        let parameters = HairParameters {
            beta_m: self.longitudinal_roughness,
            beta_n: self.azimuthal_roughness,
            alpha: -tilt("scale_tilt", self.scale_tilt)?,
            eta,
            sigma_a,
            ..HairParameters::default()
        };
        parameters.check()?;
        Ok(parameters)
    }
}
