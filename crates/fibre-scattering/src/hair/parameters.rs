//! What describes a fibre, and the bounds it is held to.

use glam::Vec3;

use crate::error::ScatteringError;
use crate::range;

/// A hair fibre as Chiang et al. 2016 describe it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairParameters {
    /// Roughness along the fibre, in [0.001, 1].
    pub beta_m: f32,
    /// Roughness around the fibre, in [0.001, 1].
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
    pub lobe_weights: [f32; 5],
    /// How much rougher TT and TRT are than R, along the fibre.
    pub roughness_scales: RoughnessScales,
    /// Layers of cuticle scales, as Yan et al. 2017 count them, in [0.01, 100]; `None`, the bare surface, is
    /// Fresnel's reflectance itself.
    pub cuticle_layers: Option<f32>,
    /// A film of water over the fibre; `None` for dry hair. For hair under water there is no film: give the
    /// index of the fibre over that of water, 1.55 / 1.33 = 1.165, as `eta`.
    pub film: Option<WaterFilm>,
    /// Smaller over larger axis of an elliptical cross-section, in [0.1, 1]; 1 is round. The larger axis
    /// lies along y of the fibre's frame.
    pub aspect: f32,
}

/// Factors on the longitudinal roughness of R (its deviation, not its variance) that give TT's and TRT's:
/// `scale_TT` and `scale_TRT` of MaterialX.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughnessScales {
    /// Of TT, in [0.1, 8].
    pub tt: f32,
    /// Of TRT and the residual, in [0.1, 8].
    pub trt: f32,
}

impl Default for RoughnessScales {
    /// 0.5 and 2: Marschner et al. 2003.
    fn default() -> Self {
        RoughnessScales { tt: 0.5, trt: 2.0 }
    }
}

/// A film of water, thin beside the fibre and everywhere parallel to its surface.
///
/// Water lies between the fibre and the air, and both steps in index are smaller than the one it replaces:
/// less is reflected, from outside and from inside, and more light goes through, forward and through
/// pigment. Wet hair is darker. What it does reflect comes from the smooth water and not from the cuticle:
/// R takes the film's roughness and no tilt, and wet hair shines. (Of hair at 1.55 under water, a fifth of R, seen
/// straight on, comes from the cuticle through the water; it is given the film's roughness with the rest.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaterFilm {
    /// Index of refraction of the film over that of air, in [1.0001, 3].
    pub eta: f32,
    /// Roughness of its surface, in the measure of `beta_m` and `beta_n`, in [0.001, 1].
    pub roughness: f32,
}

impl Default for WaterFilm {
    /// Water: 1.33, roughness 0.1.
    fn default() -> Self {
        WaterFilm { eta: 1.33, roughness: 0.1 }
    }
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
            lobe_weights: [1.0; 5],
            roughness_scales: RoughnessScales::default(),
            cuticle_layers: None,
            film: None,
            aspect: 1.0,
        }
    }
}

impl HairParameters {
    /// Checks every bound stated on the fields.
    ///
    /// # Errors
    /// The first bound broken, as a [`ScatteringError`]; NaN breaks every bound.
    pub fn check(&self) -> Result<(), ScatteringError> {
        range::roughness("beta_m", self.beta_m)?;
        range::roughness("beta_n", self.beta_n)?;
        range::tilt("alpha", self.alpha)?;
        range::index("eta", self.eta)?;
        range::absorption(self.sigma_a)?;
        range::none_negative(LOBE_WEIGHTS, self.lobe_weights)?;
        let RoughnessScales { tt, trt } = self.roughness_scales;
        range::within("roughness_scales.tt", tt, 0.1..=8.0, "[0.1, 8]")?;
        range::within("roughness_scales.trt", trt, 0.1..=8.0, "[0.1, 8]")?;
        if let Some(layers) = self.cuticle_layers {
            range::within("cuticle_layers", layers, 0.01..=100.0, "[0.01, 100]")?;
        }
        if let Some(film) = self.film {
            range::index("film.eta", film.eta)?;
            range::roughness("film.roughness", film.roughness)?;
        }
        range::within("aspect", self.aspect, 0.1..=1.0, "[0.1, 1]")?;
        Ok(())
    }

    /// What other shaders ask for instead of the roughnesses: for R, TT and TRT the longitudinal variance v
    /// and the azimuthal scale s of Chiang et al. 2016, eqs. 7 and 8. s is without the factor sqrt(pi/8),
    /// which MaterialX's `chiang_hair_bsdf` applies itself (its `roughness_R`, `roughness_TT`, `roughness_TRT`).
    #[must_use]
    pub fn lobe_spreads(&self) -> [[f32; 2]; 3] {
        let [r, tt, trt, _] = self.variances();
        let first = self.film.map_or(self.beta_n, |film| film.roughness);
        let scale = |beta_n: f32| azimuthal_deviation(f64::from(beta_n));
        [(r, first), (tt, self.beta_n), (trt, self.beta_n)].map(|(v, beta)| [v as f32, scale(beta) as f32])
    }

    /// The longitudinal variance of R, TT, TRT and the residual, which is as rough as TRT. R's is the film's
    /// where there is one.
    pub(crate) fn variances(&self) -> [f64; 4] {
        let dry = longitudinal_variance(f64::from(self.beta_m));
        let first = self.film.map_or(dry, |film| longitudinal_variance(f64::from(film.roughness)));
        let scaled = |scale: f32| dry * f64::from(scale) * f64::from(scale);
        let RoughnessScales { tt, trt } = self.roughness_scales;
        [first, scaled(tt), scaled(trt), scaled(trt)]
    }
}

const LOBE_WEIGHTS: [&str; 5] = [
    "lobe_weights.R",
    "lobe_weights.TT",
    "lobe_weights.TRT",
    "lobe_weights.residual",
    "lobe_weights.scattered",
];

/// v of R from the roughness along the fibre: Chiang et al. 2016, eq. 7.
pub(crate) fn longitudinal_variance(beta_m: f64) -> f64 {
    let deviation = 0.726 * beta_m + 0.812 * beta_m * beta_m + 3.7 * beta_m.powi(20);
    deviation * deviation
}

/// s from the roughness around the fibre: Chiang et al. 2016, eq. 8 without the root of pi/8.
pub(crate) fn azimuthal_deviation(beta_n: f64) -> f64 {
    0.265 * beta_n + 1.194 * beta_n * beta_n + 5.372 * beta_n.powi(22)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_are_those_of_materialx() {
        // What ND_chiang_hair_roughness gives for longitudinal 0.1, azimuthal 0.2 and scales 0.5 and 2.
        let mut parameters = HairParameters { beta_m: 0.1, beta_n: 0.2, ..HairParameters::default() };
        let [r, tt, trt] = parameters.lobe_spreads();
        let v = (0.0726_f32 + 0.00812).powi(2);
        for (found, expected) in [(r, v), (tt, 0.25 * v), (trt, 4.0 * v)] {
            assert!((found[0] - expected).abs() < 1e-7 && (found[1] - 0.10076).abs() < 1e-6, "{found:?}");
        }
        parameters.roughness_scales = RoughnessScales { tt: 1.5, trt: 0.8 };
        parameters.film = Some(WaterFilm { roughness: 0.2, ..WaterFilm::default() });
        let [r, tt, trt] = parameters.lobe_spreads();
        let film = longitudinal_variance(f64::from(0.2_f32)) as f32;
        for (found, expected) in [(r, film), (tt, 2.25 * v), (trt, 0.64 * v)] {
            assert!((found[0] - expected).abs() < 1e-7 && (found[1] - 0.10076).abs() < 1e-6, "{found:?}");
        }
    }
}
