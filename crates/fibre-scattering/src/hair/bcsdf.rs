//! The model in single precision: what a renderer calls.

use glam::Vec3;

use crate::error::ScatteringError;
use crate::hair::fibre::{Fibre, Hit};
use crate::hair::parameters::HairParameters;
use crate::lobe::{Lobe, LobeValues};
use crate::per_strand::Absorption;
use crate::sample::FibreSample;

/// A fibre's material, with everything worked out that depends on neither direction nor offset.
#[derive(Debug, Clone, Copy)]
pub struct HairBcsdf {
    fibre: Fibre<f32>,
}

impl HairBcsdf {
    /// Prepares a material.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter outside its bounds.
    pub fn new(parameters: &HairParameters) -> Result<HairBcsdf, ScatteringError> {
        parameters.check()?;
        Ok(HairBcsdf { fibre: Fibre::new(parameters) })
    }

    /// The same material with another absorption per fibre radius, as for a colour per strand.
    ///
    /// Only a copy: nothing is worked out again. That of the medulla is of no account.
    #[must_use]
    pub fn with_absorption(&self, absorption: Absorption) -> HairBcsdf {
        let mut fibre = self.fibre;
        fibre.sigma_a = absorption.cortex().to_array();
        HairBcsdf { fibre }
    }

    /// The fibre as seen from the unit direction `wo` (fibre frame, away from the fibre) at the
    /// offset `h` across it, in -1..1 (brought there if rounding left it outside).
    #[must_use]
    pub fn at(&self, wo: Vec3, h: f32) -> HairScatter {
        HairScatter { hit: self.fibre.at(wo.to_array(), h) }
    }
}

/// A fibre met by a ray: scattering as a function of the other direction.
#[derive(Debug, Clone, Copy)]
pub struct HairScatter {
    hit: Hit<f32>,
}

impl HairScatter {
    /// f cos(theta_i) of each lobe for light from the unit direction `wi` (fibre frame, away from
    /// the fibre). The cosine is that against the fibre's normal plane; the caller multiplies by no
    /// other.
    #[must_use]
    pub fn evaluate(&self, wi: Vec3) -> LobeValues {
        self.evaluate_with_pdf(wi).0
    }

    /// The density, per steradian, with which [`HairScatter::sample`] draws `wi`.
    #[must_use]
    pub fn pdf(&self, wi: Vec3) -> f32 {
        self.hit.pdf(wi.to_array())
    }

    /// [`HairScatter::evaluate`] and [`HairScatter::pdf`] for the price of one.
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        let (values, pdf) = self.hit.evaluate_with_pdf(wi.to_array());
        (LobeValues(values.map(Vec3::from_array)), pdf)
    }

    /// Draws a direction from four uniform numbers in [0, 1): the first picks the lobe, the next
    /// two the inclination, the last the azimuth.
    ///
    /// `None` where the fibre swallows all light, or for the rare draw whose pdf rounds to 0.
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> Option<FibreSample> {
        let (wi, p) = self.hit.sample_direction(u)?;
        let wi = Vec3::from_array(wi);
        // Evaluated at the direction as rounded, so that a sample and a later evaluation of it
        // agree to the bit, however narrow the lobe.
        let (values, pdf) = self.evaluate_with_pdf(wi);
        (pdf > 0.0 && pdf.is_finite()).then_some(FibreSample { wi, values, pdf, lobe: Lobe::ALL[p] })
    }

    /// The share of light from any one direction that each lobe scatters, times its weight: the
    /// attenuations A_p. With unit weights they sum to at most 1, and to 1 without absorption.
    #[must_use]
    pub fn albedo(&self) -> [Vec3; 5] {
        self.hit.attenuations().map(Vec3::from_array)
    }
}
