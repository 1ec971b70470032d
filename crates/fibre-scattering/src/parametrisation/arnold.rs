//! Arnold's `standard_hair`.

use glam::Vec3;

use super::{absent, grey, tilt};
use crate::absorption::{Pigments, absorption_from_color};
use crate::error::ScatteringError;
use crate::hair::parameters::HairParameters;
use crate::range;

/// The parameters of Arnold's `standard_hair` that describe a fibre, and its defaults.
///
/// A correspondence: Arnold says that it follows d'Eon's model for the speculars and Zinke's for the diffuse
/// part, and no more; the formulas from its controls to that model are not published.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArnoldHair {
    /// Factor on `base_color`, in [0, 1].
    pub base: f32,
    /// Colour of a head of hair, linear, in [0, 1]; white adds no absorption to the melanin's.
    pub base_color: Vec3,
    /// Amount of pigment, in [0, 1].
    pub melanin: f32,
    /// Share of pheomelanin, in [0, 1].
    pub melanin_redness: f32,
    /// Roughness along the fibre, in [0.001, 1].
    pub roughness: f32,
    /// Roughness around the fibre, in [0.001, 1]; of account with `roughness_anisotropic` only.
    pub roughness_azimuthal: f32,
    /// Whether the roughness around the fibre is `roughness_azimuthal` and not `roughness`.
    pub roughness_anisotropic: bool,
    /// Index of refraction.
    pub ior: f32,
    /// Tilt of the scales in *degrees*; 0 to 10 for human hair.
    pub shift: f32,
    /// Factor on R; a grey.
    pub specular_tint: Vec3,
    /// Factor on TRT; a grey.
    pub specular2_tint: Vec3,
    /// Factor on TT; a grey.
    pub transmission_tint: Vec3,
    /// Share of diffuse reflection, which this model does without: 0.
    pub diffuse: f32,
}

impl Default for ArnoldHair {
    fn default() -> Self {
        ArnoldHair {
            base: 1.0,
            base_color: Vec3::ONE,
            melanin: 1.0,
            melanin_redness: 0.5,
            roughness: 0.2,
            roughness_azimuthal: 0.2,
            roughness_anisotropic: false,
            ior: 1.55,
            shift: 3.0,
            specular_tint: Vec3::ONE,
            specular2_tint: Vec3::ONE,
            transmission_tint: Vec3::ONE,
            diffuse: 0.0,
        }
    }
}

impl ArnoldHair {
    /// Hair that corresponds to it.
    ///
    /// Taken from Arnold's user guide: melanin and base colour are two ways to say absorption, here added;
    /// tints multiply R, TRT and TT; the shift tilts the scales, here towards the root as in Marschner's and
    /// d'Eon's papers. Supposed, as its sister OmniHair (same controls and defaults, declared to be Chiang's
    /// model) has it: roughness is Chiang's, absorption from colour is Chiang's fit, melanin is
    /// [`Pigments::DEON`]'s. The residual keeps weight 1.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter out of its range, a tint that is no grey, or a diffuse
    /// part.
    pub fn parameters(&self) -> Result<HairParameters, ScatteringError> {
        let azimuthal = if self.roughness_anisotropic { self.roughness_azimuthal } else { self.roughness };
        for (name, found) in [("roughness", self.roughness), ("roughness_azimuthal", azimuthal)] {
            range::roughness(name, found)?;
        }
        range::share("base", self.base)?;
        for channel in self.base_color.to_array() {
            range::share("base_color", channel)?;
        }
        absent("diffuse", self.diffuse, 0.0, "{0}: fibres of this model have no diffuse part")?;
        let base = absorption_from_color(self.base * self.base_color, azimuthal)?;
        let melanin = Pigments::DEON.absorption_from_melanin(self.melanin, self.melanin_redness)?;
        let parameters = HairParameters {
            beta_m: self.roughness,
            beta_n: azimuthal,
            alpha: tilt("shift", self.shift)?,
            eta: range::index("ior", self.ior)?,
            sigma_a: base + melanin,
            lobe_weights: [
                grey("specular_tint", self.specular_tint)?,
                grey("transmission_tint", self.transmission_tint)?,
                grey("specular2_tint", self.specular2_tint)?,
                1.0,
                1.0,
            ],
            ..HairParameters::default()
        };
        parameters.check()?;
        Ok(parameters)
    }
}
