//! pbrt-v4's `hair` material.

use glam::Vec3;

use super::{exclusive, tilt};
use crate::absorption::{Pigments, absorption_from_color};
use crate::error::ScatteringError;
use crate::hair::parameters::HairParameters;
use crate::range;

/// The parameters of pbrt-v4's `hair` material and its defaults.
///
/// Exact: the same model. Colour is given in one of three ways; with none, it is eumelanin at 1.3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PbrtHair {
    /// Absorption per fibre radius, at least 0.
    pub sigma_a: Option<Vec3>,
    /// Colour of a head of hair, linear, in [0, 1]; `color` in earlier versions.
    pub reflectance: Option<Vec3>,
    /// Concentration of eumelanin, at least 0; 0 where only pheomelanin is given.
    pub eumelanin: Option<f32>,
    /// Concentration of pheomelanin, at least 0; 0 where only eumelanin is given.
    pub pheomelanin: Option<f32>,
    /// Index of refraction.
    pub eta: f32,
    /// Roughness along the fibre, in [0.001, 1].
    pub beta_m: f32,
    /// Roughness around the fibre, in [0.001, 1].
    pub beta_n: f32,
    /// Tilt of the scales in *degrees*, with pbrt's sign: see [`PbrtHair::parameters`].
    pub alpha: f32,
}

impl Default for PbrtHair {
    fn default() -> Self {
        PbrtHair {
            sigma_a: None,
            reflectance: None,
            eumelanin: None,
            pheomelanin: None,
            eta: 1.55,
            beta_m: 0.3,
            beta_n: 0.3,
            alpha: 2.0,
        }
    }
}

impl PbrtHair {
    /// The same hair in this crate's parameters.
    ///
    /// Source: pbrt-v4, `src/pbrt/materials.cpp` (`HairMaterial`) and `bxdfs.h` (`HairBxDF`); the pigments
    /// are [`Pigments::DEON`]. On a curve that runs from root to tip, pbrt tilts the other way: its
    /// positive `alpha` brings R nearer to the tip. The picture is kept and the sign changed; who wants
    /// hair as it grows gives pbrt's `alpha` as negative.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter out of its range, or two ways of giving the colour
    /// at once, of which pbrt takes the first and warns.
    pub fn parameters(&self) -> Result<HairParameters, ScatteringError> {
        let pigments = self.eumelanin.is_some() || self.pheomelanin.is_some();
        let (sigma_a, reflectance) = (self.sigma_a.is_some(), self.reflectance.is_some());
        exclusive(("sigma_a", sigma_a), ("reflectance", reflectance))?;
        exclusive(("sigma_a", sigma_a), ("eumelanin or pheomelanin", pigments))?;
        exclusive(("reflectance", reflectance), ("eumelanin or pheomelanin", pigments))?;
        let sigma_a = match (self.sigma_a, self.reflectance) {
            (Some(sigma_a), _) => range::absorption(sigma_a)?,
            (None, Some(color)) => absorption_from_color(color, self.beta_n)?,
            (None, None) if pigments => {
                Pigments::DEON.absorption(self.eumelanin.unwrap_or(0.0), self.pheomelanin.unwrap_or(0.0))?
            }
            (None, None) => Pigments::DEON.absorption(1.3, 0.0)?,
        };
        let parameters = HairParameters {
            beta_m: self.beta_m,
            beta_n: self.beta_n,
            alpha: -tilt("alpha", self.alpha)?,
            eta: self.eta,
            sigma_a,
            ..HairParameters::default()
        };
        parameters.check()?;
        Ok(parameters)
    }
}
