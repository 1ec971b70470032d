//! RenderMan's `PxrMarschnerHair`.

use glam::Vec3;

use super::{absent, beta_m_from_variance, beta_n_from_scale, of_spread, tilt};
use crate::error::ScatteringError;
use crate::hair::parameters::{HairParameters, RoughnessScales};
use crate::range;

/// The parameters of RenderMan's `PxrMarschnerHair` that describe a fibre, and its defaults.
///
/// A correspondence by spread: its lobes are fitted to data (Pekelis et al. 2015, "A Data-Driven Light
/// Scattering Model for Hair"), and neither their shape nor their absorption is this model's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PxrMarschnerHair {
    /// Share of diffuse reflection, which this model does without: 0.
    pub diffuse_gain: f32,
    /// Factor on R, at least 0.
    pub specular_gain_r: f32,
    /// Factor on TRT, at least 0.
    pub specular_gain_trt: f32,
    /// Factor on TT, at least 0.
    pub specular_gain_tt: f32,
    /// Colour of R, at least 0; its mean counts.
    pub specular_color_r: Vec3,
    /// Colour of TRT, at least 0; physically the square of TT's.
    pub specular_color_trt: Vec3,
    /// Colour of TT, in (0, 1]: what one crossing of the fibre lets through.
    pub specular_color_tt: Vec3,
    /// Width of R along the fibre, in *degrees*, above 0.
    pub specular_cone_angle_r: f32,
    /// The same of TRT.
    pub specular_cone_angle_trt: f32,
    /// The same of TT.
    pub specular_cone_angle_tt: f32,
    /// Shift of R in *degrees*, negative towards the root: Marschner's alpha_R.
    pub specular_offset: f32,
    /// Index of refraction.
    pub specular_ior: f32,
    /// Width around the fibre, in *degrees*; RenderMan recommends 10 to 25.
    pub specular_glint_width: f32,
    /// Smaller over larger axis of the cross-section; RenderMan recommends 0.85 to 1.
    pub specular_eccentricity: f32,
}

impl Default for PxrMarschnerHair {
    fn default() -> Self {
        PxrMarschnerHair {
            diffuse_gain: 0.0,
            specular_gain_r: 1.0,
            specular_gain_trt: 1.0,
            specular_gain_tt: 1.0,
            specular_color_r: Vec3::ONE,
            specular_color_trt: Vec3::splat(0.4),
            specular_color_tt: Vec3::splat(0.4),
            specular_cone_angle_r: 8.0,
            specular_cone_angle_trt: 8.0,
            specular_cone_angle_tt: 8.0,
            specular_offset: -3.0,
            specular_ior: 1.55,
            specular_glint_width: 10.0,
            specular_eccentricity: 1.0,
        }
    }
}

impl PxrMarschnerHair {
    /// Hair that corresponds to it.
    ///
    /// Names and defaults are from RenderMan's reference; the rest is this:
    ///
    /// - A cone angle is taken for the lobe's standard deviation along the fibre, so that v is its square in
    ///   radians; beta_m and the scales of TT and TRT are those that give the three v. The residual, which
    ///   RenderMan leaves out, spreads as TRT and keeps weight 1.
    /// - The glint width is taken for the Gaussian deviation around the fibre that s of eq. 8 stands for.
    /// - The tilt is minus the offset: Marschner moves R by `2 alpha_R` in the outgoing angle, to the root where
    ///   it is negative. TRT moves 4 tilts here and 3 in Marschner's paper.
    /// - Absorption is that whose mean crossing at normal incidence lets TT's colour through. TRT, which crosses
    ///   twice, then has that colour squared: its weight is the mean of what it should have over that, since
    ///   a weight is a number. R's is the mean of its colour.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter out of its range, or a diffuse part.
    pub fn parameters(&self) -> Result<HairParameters, ScatteringError> {
        absent("diffuseGain", self.diffuse_gain, 0.0, "{0}: fibres of this model have no diffuse part")?;
        let variance = |name, degrees: f32| {
            let radians =
                range::within(name, degrees, f32::MIN_POSITIVE..=90.0, "[0.0417, 90] degrees")?.to_radians();
            Ok(radians * radians)
        };
        let v = variance("specularConeAngleR", self.specular_cone_angle_r)?;
        let scale = |name, degrees: f32| {
            let scale = (variance(name, degrees)? / v).sqrt();
            let range = "[0.1, 8] times specularConeAngleR";
            range::within("", scale, 0.1..=8.0, range).map_err(|_| ScatteringError::OutOfRange {
                name,
                found: degrees,
                range,
            })
        };
        let (cone, width) = (self.specular_cone_angle_r, self.specular_glint_width);
        let glint = ("specularGlintWidth", "[0.0153, 180] degrees");
        range::within(glint.0, width, f32::MIN_POSITIVE..=180.0, glint.1)?;
        let aspect = ("specularEccentricity", self.specular_eccentricity);
        let roughness_scales = RoughnessScales {
            tt: scale("specularConeAngleTT", self.specular_cone_angle_tt)?,
            trt: scale("specularConeAngleTRT", self.specular_cone_angle_trt)?,
        };
        let parameters = HairParameters {
            beta_m: of_spread("specularConeAngleR", cone, beta_m_from_variance(v), "[0.0417, 90] degrees")?,
            beta_n: of_spread(glint.0, width, beta_n_from_scale(width.to_radians()), glint.1)?,
            alpha: -tilt("specularOffset", self.specular_offset)?,
            eta: self.specular_ior,
            sigma_a: self.absorption()?,
            lobe_weights: self.weights()?,
            roughness_scales,
            aspect: range::within(aspect.0, aspect.1, 0.1..=1.0, "[0.1, 1]")?,
            ..HairParameters::default()
        };
        parameters.check()?;
        Ok(parameters)
    }

    /// Per fibre radius, from TT's colour.
    fn absorption(&self) -> Result<Vec3, ScatteringError> {
        let eta = range::within("specularIor", self.specular_ior, 1.0001..=3.0, "[1.0001, 3]")?;
        // The integral of 2 cos(gamma_t) over h in [0, 1], at normal incidence.
        let a = 1.0 / eta;
        let crossing = (1.0 - a * a).sqrt() + a.asin() / a;
        let mut sigma_a = [0.0; 3];
        for (sigma, channel) in sigma_a.iter_mut().zip(self.specular_color_tt.to_array()) {
            let through = range::within("specularColorTT", channel, 1e-6..=1.0, "[1e-6, 1]")?;
            *sigma = -through.ln() / crossing;
        }
        Ok(sigma_a.into())
    }

    /// What each lobe is multiplied by; `specular_color_tt` has passed its check.
    fn weights(&self) -> Result<[f32; 5], ScatteringError> {
        for (name, gain) in [
            ("specularGainR", self.specular_gain_r),
            ("specularGainTT", self.specular_gain_tt),
            ("specularGainTRT", self.specular_gain_trt),
        ] {
            range::not_negative(name, gain)?;
        }
        for (name, color) in
            [("specularColorR", self.specular_color_r), ("specularColorTRT", self.specular_color_trt)]
        {
            for channel in color.to_array() {
                range::not_negative(name, channel)?;
            }
        }
        let mean = |color: Vec3| color.element_sum() / 3.0;
        let twice = self.specular_color_tt * self.specular_color_tt;
        let r = self.specular_gain_r * mean(self.specular_color_r);
        let trt = self.specular_gain_trt * mean(self.specular_color_trt / twice);
        Ok([r, self.specular_gain_tt, trt, 1.0, 1.0])
    }
}
