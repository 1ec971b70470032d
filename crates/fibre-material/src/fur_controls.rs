//! The fur controls of "A User Friendly Hair Reflectance Model in Houdini" (2019), section 3.2.2, as the
//! friendly face of the double cylinder's parameters.

use fibre_scattering::{HairParameters, Medulla};
use glam::Vec3;

use crate::MaterialError;
use crate::color::{checked, fit};

/// Base colour, medulla colour, medulla index, medulla scattering and cuticle layers. The base colour is the
/// material's [`crate::HairColor`]; the other four are here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FurControls {
    /// Colour of the medulla, linear Rec. 709, channels in 0..1; `None`: as the cortex around it.
    pub medulla_color: Option<Vec3>,
    /// How much of the fibre is medulla: 0, none, the base colour counts alone; 1, all, the medulla's counts.
    pub medulla_index: f32,
    /// How much the medulla scatters, 0..5, per micrometre of a fibre 40 micrometres thick.
    pub medulla_scattering: f32,
    /// Layers of cuticle scales as Yan et al. 2017 count them; `None`: the bare surface.
    pub cuticle_layers: Option<f32>,
}

impl Default for FurControls {
    /// The middle of each of the thesis' rows of pictures.
    fn default() -> Self {
        FurControls {
            medulla_color: None,
            medulla_index: 0.5,
            medulla_scattering: 0.065,
            cuticle_layers: None,
        }
    }
}

impl FurControls {
    /// The widest medulla the model takes, what an index of 1 comes to.
    pub const WIDEST: f32 = 0.99;

    /// Radius, in micrometres, of the fibre that medulla scattering is stated for.
    pub const RADIUS: f32 = 20.0;

    /// Mean cosine of the medulla's phase function, which the thesis has no control for: between the 0.44 and
    /// 0.79 of the published parameter sets (see the presets `fur-kappa-0.88` and `fur-kappa-0.86`).
    pub const ANISOTROPY: f32 = 0.6;

    /// The model's parameters for these controls, on a fibre whose surface is `hair`. Each control moves one
    /// parameter, always in the same direction:
    ///
    /// - **index**: `kappa = 0.99 index`. At 0 there is no medulla and the fibre is hair of the base colour,
    ///   bit for bit; at 1 hardly any cortex is left, and the medulla's absorption is the fibre's. In between
    ///   light crosses both, as in table 2.3 of the thesis.
    /// - **colour**: absorption of the medulla by the fit that the base colour goes through (Chiang et al.
    ///   2016, eq. 9), so that equal colours make a fibre of one absorption throughout. It says what the
    ///   medulla absorbs; how bright it comes out depends on the scattering too. The mean path through a body
    ///   that scatters is as long as through one that does not, which makes the fit a fair first guess.
    /// - **scattering**: `sigma_s = 20 scattering`, per fibre radius. The thesis states no unit and shows
    ///   0.01, 0.065 and 0.2; taken per micrometre, in a fibre 40 micrometres thick, they are 0.2, 1.3 and 4
    ///   per radius, about what was measured on fur (1.69 and 3.15), and scatter 18 %, 72 % and 98 % of the
    ///   light that crosses the middle of a medulla of index 0.5: three looks. Per radius, as the numbers
    ///   stand, the largest would scatter a fifth.
    /// - **cuticle layers**: as they are.
    ///
    /// # Errors
    /// [`MaterialError::Value`] names the control out of range.
    pub fn parameters(&self, hair: HairParameters) -> Result<(HairParameters, Medulla), MaterialError> {
        let FurControls { medulla_color, medulla_index, medulla_scattering, cuticle_layers } = *self;
        if !(0.0..=1.0).contains(&medulla_index) {
            return Err(MaterialError::value("fur.medulla_index", medulla_index, "0..1"));
        }
        if !(0.0..=5.0).contains(&medulla_scattering) {
            return Err(MaterialError::value("fur.medulla_scattering", medulla_scattering, "0..5"));
        }
        let sigma_a = match medulla_color {
            Some(color) => fit(checked(color, || "fur.medulla_color".into())?, hair.beta_n)?,
            None => Vec3::ZERO,
        };
        let kappa = Self::WIDEST * medulla_index;
        let sigma_s = Self::RADIUS * medulla_scattering;
        let hair = HairParameters { cuticle_layers: cuticle_layers.or(hair.cuticle_layers), ..hair };
        Ok((hair, Medulla { kappa, sigma_s, sigma_a, g: Self::ANISOTROPY }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn medulla(controls: FurControls) -> Medulla {
        controls.parameters(HairParameters::default()).unwrap().1
    }

    #[test]
    fn every_control_moves_its_parameter_up_or_down_and_no_other() {
        let base = FurControls { medulla_color: Some(Vec3::splat(0.5)), ..FurControls::default() };
        let mut last = medulla(FurControls { medulla_index: 0.0, medulla_scattering: 0.0, ..base });
        assert_eq!((last.kappa, last.sigma_s), (0.0, 0.0));
        for i in 1..=100 {
            let t = i as f32 / 100.0;
            let index = medulla(FurControls { medulla_index: t, ..base });
            assert!(index.kappa > last.kappa && index.kappa <= 0.99);
            assert_eq!(Medulla { kappa: 0.0, ..index }, Medulla { kappa: 0.0, ..medulla(base) });
            let scattering = medulla(FurControls { medulla_scattering: 5.0 * t, ..base });
            assert!(scattering.sigma_s > last.sigma_s && scattering.check().is_ok());
            let grey = Some(Vec3::splat(1.0 - t));
            let dark = medulla(FurControls { medulla_color: grey, ..base });
            assert!(dark.sigma_a.x > last.sigma_a.x || i == 1);
            last = Medulla { kappa: index.kappa, sigma_s: scattering.sigma_s, ..dark };
        }
    }

    #[test]
    fn equal_colours_absorb_alike() {
        let color = Vec3::new(0.856, 0.213, 0.047);
        let hair = HairParameters::default();
        let cortex = fit(color, hair.beta_n).unwrap();
        let controls = FurControls { medulla_color: Some(color), ..FurControls::default() };
        assert_eq!(controls.parameters(hair).unwrap().1.sigma_a, cortex);
    }

    #[test]
    fn bad_controls_are_named() {
        let good = FurControls::default();
        let color = Some(Vec3::new(0.5, 1.5, 0.5));
        for (controls, words) in [
            (FurControls { medulla_index: 1.01, ..good }, "fur.medulla_index is 1.01, expected 0..1"),
            (FurControls { medulla_index: f32::NAN, ..good }, "fur.medulla_index is NaN"),
            (FurControls { medulla_scattering: -0.1, ..good }, "fur.medulla_scattering is -0.1"),
            (FurControls { medulla_color: color, ..good }, "fur.medulla_color is [0.5, 1.5, 0.5]"),
        ] {
            let told = controls.parameters(HairParameters::default()).unwrap_err().to_string();
            assert!(told.contains(words), "{told}");
        }
    }
}
