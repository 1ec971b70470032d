//! MaterialX's hair nodes, both ways.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::Vec3;

use super::{absent, grey};
use super::{beta_m_from_variance, beta_n_from_scale, of_spread};
use crate::absorption::Pigments;
use crate::error::ScatteringError;
use crate::hair::parameters::{HairParameters, RoughnessScales, azimuthal_deviation, longitudinal_variance};
use crate::range;

/// The inputs of MaterialX 1.39's `chiang_hair_bsdf` and its defaults.
///
/// Exact, but for what its shader adds: it brings every (v, s) to [0.001, 1], takes pi/2 for the residual's
/// 1/(2 pi), and, before mid-2026, divides all by pi. Note that the defaults of the node give each lobe an s of
/// its own, which no `chiang_hair_roughness` makes and this model does not have: they are refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialXHair {
    /// Factor on R; a grey.
    pub tint_r: Vec3,
    /// Factor on TT; a grey.
    pub tint_tt: Vec3,
    /// Factor on TRT and on the residual; a grey.
    pub tint_trt: Vec3,
    /// Index of refraction.
    pub ior: f32,
    /// (v, s) of R: longitudinal variance, azimuthal scale.
    pub roughness_r: [f32; 2],
    /// (v, s) of TT.
    pub roughness_tt: [f32; 2],
    /// (v, s) of TRT and of the residual.
    pub roughness_trt: [f32; 2],
    /// Tilt of the scales, in (0, 1) for -pi/2 to pi/2; 0.5 is none. (At 0 and 1 scales would stand upright.)
    pub cuticle_angle: f32,
    /// Absorption per fibre radius, at least 0. (The specification says diameter; its shader says radius.)
    pub absorption_coefficient: Vec3,
}

impl Default for MaterialXHair {
    fn default() -> Self {
        MaterialXHair {
            tint_r: Vec3::ONE,
            tint_tt: Vec3::ONE,
            tint_trt: Vec3::ONE,
            ior: 1.55,
            roughness_r: [0.1, 0.1],
            roughness_tt: [0.05, 0.05],
            roughness_trt: [0.2, 0.2],
            cuticle_angle: 0.5,
            absorption_coefficient: Vec3::ZERO,
        }
    }
}

impl MaterialXHair {
    /// The same hair in this crate's parameters.
    ///
    /// Source: MaterialX, `libraries/pbrlib/pbrlib_defs.mtlx` and `genglsl/mx_chiang_hair_bsdf.glsl`. Chiang's
    /// eqs. 7 and 8 are inverted for R's (v, s); the scales of TT and TRT are the roots of their v over R's.
    /// The tilt has this crate's sign.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first input out of its range, a tint that is no grey (lobe weights are
    /// numbers: a mean would be another colour in silence), or an s that is not the same for all lobes.
    pub fn parameters(&self) -> Result<HairParameters, ScatteringError> {
        let [v, s] = self.roughness_r;
        let beta_m = of_spread("roughness_R v", v, beta_m_from_variance(v), "[5.2826e-7, 27.436]")?;
        let beta_n = of_spread("roughness_R s", s, beta_n_from_scale(s), "[2.6620e-4, 6.831]")?;
        for (name, found) in
            [("roughness_TT s", self.roughness_tt[1]), ("roughness_TRT s", self.roughness_trt[1])]
        {
            // Files give six digits.
            if !(-1e-5..=1e-5).contains(&(found / s - 1.0)) {
                return Err(ScatteringError::OutOfRange { name, found, range: "{the s of roughness_R}" });
            }
        }
        let scale = |name, of: [f32; 2]| {
            let scale = (f64::from(of[0]) / f64::from(v)).sqrt() as f32;
            let range = "[0.01, 64] times the v of roughness_R";
            // Files give six digits.
            if (0.1 * (1.0 - 1e-5)..=8.0 * (1.0 + 1e-5)).contains(&scale) {
                Ok(scale.clamp(0.1, 8.0))
            } else {
                Err(ScatteringError::OutOfRange { name, found: of[0], range })
            }
        };
        let roughness_scales = RoughnessScales {
            tt: scale("roughness_TT v", self.roughness_tt)?,
            trt: scale("roughness_TRT v", self.roughness_trt)?,
        };
        let trt = grey("tint_TRT", self.tint_trt)?;
        let tilted = self.cuticle_angle > 0.0 && self.cuticle_angle < 1.0;
        if !tilted {
            let (name, range) = ("cuticle_angle", "(0, 1)");
            return Err(ScatteringError::OutOfRange { name, found: self.cuticle_angle, range });
        }
        let parameters = HairParameters {
            beta_m,
            beta_n,
            alpha: self.cuticle_angle * PI - FRAC_PI_2,
            eta: range::index("ior", self.ior)?,
            sigma_a: range::absorption(self.absorption_coefficient)?,
            lobe_weights: [grey("tint_R", self.tint_r)?, grey("tint_TT", self.tint_tt)?, trt, trt, 1.0],
            roughness_scales,
            ..HairParameters::default()
        };
        parameters.check()?;
        Ok(parameters)
    }

    /// The inputs that stand for these parameters.
    ///
    /// # Errors
    /// A [`ScatteringError`] for parameters out of range, and for what the node has no input for: a residual
    /// weighted otherwise than TRT, cuticle layers, a film, an ellipse.
    pub fn from_parameters(parameters: &HairParameters) -> Result<MaterialXHair, ScatteringError> {
        parameters.check()?;
        let [r, tt, trt, residual, _] = parameters.lobe_weights;
        absent("lobe_weights[3]", residual, trt, "{lobe_weights[2]}: MaterialX has one tint for both")?;
        absent("aspect", parameters.aspect, 1.0, "{1}: MaterialX has no ellipse")?;
        let none = |name, found| ScatteringError::OutOfRange { name, found, range: "{}: MaterialX has none" };
        if let Some(layers) = parameters.cuticle_layers {
            return Err(none("cuticle_layers", layers));
        }
        if let Some(film) = parameters.film {
            return Err(none("film", film.eta));
        }
        let roughness = MaterialXRoughness {
            longitudinal: parameters.beta_m,
            azimuthal: parameters.beta_n,
            scale_tt: parameters.roughness_scales.tt,
            scale_trt: parameters.roughness_scales.trt,
        };
        let [roughness_r, roughness_tt, roughness_trt] = roughness.pairs()?;
        Ok(MaterialXHair {
            tint_r: Vec3::splat(r),
            tint_tt: Vec3::splat(tt),
            tint_trt: Vec3::splat(trt),
            ior: parameters.eta,
            roughness_r,
            roughness_tt,
            roughness_trt,
            cuticle_angle: parameters.alpha / PI + 0.5,
            absorption_coefficient: parameters.sigma_a,
        })
    }
}

/// The inputs of MaterialX's `chiang_hair_roughness` and its defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialXRoughness {
    /// Roughness along the fibre, in [0.001, 1]: beta_m.
    pub longitudinal: f32,
    /// Roughness around the fibre, in [0.001, 1]: beta_n.
    pub azimuthal: f32,
    /// Factor on TT's deviation, in [0.1, 8].
    pub scale_tt: f32,
    /// Factor on TRT's deviation, in [0.1, 8].
    pub scale_trt: f32,
}

impl Default for MaterialXRoughness {
    fn default() -> Self {
        MaterialXRoughness { longitudinal: 0.1, azimuthal: 0.2, scale_tt: 0.5, scale_trt: 2.0 }
    }
}

impl MaterialXRoughness {
    /// The node's outputs `roughness_R`, `roughness_TT` and `roughness_TRT`, each (v, s): Chiang et al. 2016,
    /// eqs. 7 and 8, and the scales squared on v.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first input out of its range.
    pub fn pairs(&self) -> Result<[[f32; 2]; 3], ScatteringError> {
        for (name, found) in [("longitudinal", self.longitudinal), ("azimuthal", self.azimuthal)] {
            range::roughness(name, found)?;
        }
        for (name, found) in [("scale_TT", self.scale_tt), ("scale_TRT", self.scale_trt)] {
            range::within(name, found, 0.1..=8.0, "[0.1, 8]")?;
        }
        let v = longitudinal_variance(f64::from(self.longitudinal));
        let s = azimuthal_deviation(f64::from(self.azimuthal)) as f32;
        let scaled = |scale: f32| [(v * f64::from(scale) * f64::from(scale)) as f32, s];
        Ok([scaled(1.0), scaled(self.scale_tt), scaled(self.scale_trt)])
    }
}

/// The inputs of MaterialX's `deon_hair_absorption_from_melanin` and its defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialXMelanin {
    /// Amount of pigment, in [0, 1].
    pub melanin_concentration: f32,
    /// Share of pheomelanin, in [0, 1].
    pub melanin_redness: f32,
    /// What unit eumelanin lets through over one radius, linear Rec. 709, in (0, 1].
    pub eumelanin_color: Vec3,
    /// The same of pheomelanin.
    pub pheomelanin_color: Vec3,
}

impl Default for MaterialXMelanin {
    fn default() -> Self {
        MaterialXMelanin {
            melanin_concentration: 0.25,
            melanin_redness: 0.5,
            eumelanin_color: Vec3::new(0.657_704, 0.498_077, 0.254_107),
            pheomelanin_color: Vec3::new(0.829_444, 0.670_32, 0.349_938),
        }
    }
}

impl MaterialXMelanin {
    /// The node's output, absorption per fibre radius: [`Pigments::absorption_from_melanin`] of pigments whose
    /// absorption is minus the logarithm of the colours.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first input out of its range.
    pub fn absorption(&self) -> Result<Vec3, ScatteringError> {
        let pigment = |name, color: Vec3| {
            let mut sigma = [0.0; 3];
            for (sigma, channel) in sigma.iter_mut().zip(color.to_array()) {
                *sigma = -range::within(name, channel, f32::MIN_POSITIVE..=1.0, "(0, 1]")?.ln();
            }
            Ok(Vec3::from_array(sigma))
        };
        range::share("melanin_concentration", self.melanin_concentration)?;
        let pigments = Pigments {
            eumelanin: pigment("eumelanin_color", self.eumelanin_color)?,
            pheomelanin: pigment("pheomelanin_color", self.pheomelanin_color)?,
        };
        pigments.absorption_from_melanin(self.melanin_concentration, self.melanin_redness)
    }
}
