//! Blender Cycles' Principled Hair BSDF, model Chiang.

use glam::Vec3;

use crate::absorption::{Pigments, absorption_from_color};
use crate::error::ScatteringError;
use crate::hair::parameters::{HairParameters, RoughnessScales, longitudinal_variance};
use crate::range;

/// Where Cycles takes the absorption from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CyclesParametrization {
    /// *Direct coloring*: `color`.
    #[default]
    Color,
    /// *Melanin concentration*: `melanin`, `melanin_redness` and `tint`.
    Melanin,
    /// *Absorption coefficient*: `absorption_coefficient`.
    Absorption,
}

/// The inputs of Blender's *Principled Hair BSDF* with the model set to Chiang, and Blender's defaults.
///
/// Exact: the same model with the same sign of the tilt, but for Cycles' series for the Bessel function. The
/// model Huang is another one (microfacets on an ellipse) and has no counterpart here. *Random Color* and
/// *Random Roughness* vary strands and belong to a groom's material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CyclesHair {
    /// Which of the following colours the hair.
    pub parametrization: CyclesParametrization,
    /// Colour of a head of hair, linear Rec. 709, in [0, 1].
    pub color: Vec3,
    /// Amount of pigment, in [0, 1].
    pub melanin: f32,
    /// Share of pheomelanin, in [0, 1].
    pub melanin_redness: f32,
    /// Dye over the melanin, linear Rec. 709, in [0, 1]; white is none.
    pub tint: Vec3,
    /// Absorption per fibre radius, at least 0.
    pub absorption_coefficient: Vec3,
    /// Roughness along the fibre, in [0.001, 1].
    pub roughness: f32,
    /// Roughness around the fibre, in [0.001, 1].
    pub radial_roughness: f32,
    /// How much smoother the surface reflects than the rest scatters: R's roughness is `roughness` times
    /// `1 - coat`. In [0, 1), and not so near 1 that R is more than 4 times narrower than
    /// without it, or smoother than 0.001.
    pub coat: f32,
    /// Index of refraction.
    pub ior: f32,
    /// Tilt of the scales, in radians as in Blender's files; Blender's panel shows degrees.
    pub offset: f32,
}

impl Default for CyclesHair {
    fn default() -> Self {
        CyclesHair {
            parametrization: CyclesParametrization::Color,
            color: Vec3::new(0.017_513, 0.005_763, 0.002_059),
            melanin: 0.8,
            melanin_redness: 1.0,
            tint: Vec3::ONE,
            absorption_coefficient: Vec3::new(0.245_531, 0.52, 1.365),
            roughness: 0.3,
            radial_roughness: 0.3,
            coat: 0.0,
            ior: 1.55,
            offset: 2.0_f32.to_radians(),
        }
    }
}

impl CyclesHair {
    /// The same hair in this crate's parameters.
    ///
    /// Source: Blender, `intern/cycles/kernel/svm/closure.h` and
    /// `closure/bsdf_principled_hair_chiang.h`. Melanin has [`Pigments::CYCLES`]; the tint's absorption, by
    /// Chiang's fit at `radial_roughness`, is added to it. `coat` acts on beta_m of R before eq. 7, so that
    /// the scales of TT and TRT are those that leave them as they are without it.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first input out of its range. Cycles brings them to the nearer bound.
    pub fn parameters(&self) -> Result<HairParameters, ScatteringError> {
        for (name, found) in [("roughness", self.roughness), ("radial_roughness", self.radial_roughness)] {
            range::roughness(name, found)?;
        }
        let sigma_a = match self.parametrization {
            CyclesParametrization::Color => absorption_from_color(self.color, self.radial_roughness)?,
            CyclesParametrization::Melanin => {
                let melanin = Pigments::CYCLES.absorption_from_melanin(self.melanin, self.melanin_redness)?;
                melanin + tint_absorption(self.tint, self.radial_roughness)?
            }
            CyclesParametrization::Absorption => range::absorption(self.absorption_coefficient)?,
        };
        let (beta_m, roughness_scales) = self.coated()?;
        let parameters = HairParameters {
            beta_m,
            beta_n: self.radial_roughness,
            alpha: range::tilt("offset", self.offset)?,
            eta: range::index("ior", self.ior)?,
            sigma_a,
            roughness_scales,
            ..HairParameters::default()
        };
        parameters.check()?;
        Ok(parameters)
    }

    /// R's roughness, and the scales that leave TT and TRT those of `roughness`.
    fn coated(&self) -> Result<(f32, RoughnessScales), ScatteringError> {
        let words = "[0, 1), with R at most 4 times narrower than without and not smoother than 0.001";
        range::within("coat", self.coat, 0.0..=1.0, words)?;
        if self.coat == 0.0 {
            return Ok((self.roughness, RoughnessScales::default()));
        }
        let beta_m = self.roughness * (1.0 - self.coat);
        let variance = |beta: f32| longitudinal_variance(f64::from(beta));
        let narrower = (variance(self.roughness) / variance(beta_m)).sqrt();
        if !(0.0..=4.0).contains(&narrower) || range::roughness("coat", beta_m).is_err() {
            return Err(ScatteringError::OutOfRange { name: "coat", found: self.coat, range: words });
        }
        let narrower = narrower as f32;
        Ok((beta_m, RoughnessScales { tt: 0.5 * narrower, trt: 2.0 * narrower }))
    }
}

/// The fit, with a name of its own for what is refused.
fn tint_absorption(tint: Vec3, beta_n: f32) -> Result<Vec3, ScatteringError> {
    for channel in tint.to_array() {
        range::share("tint", channel)?;
    }
    absorption_from_color(tint, beta_n)
}
