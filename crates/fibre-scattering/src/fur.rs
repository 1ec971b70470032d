//! Fur: hair's lobes, dimmed by the medulla, and the light the medulla scatters.

use std::sync::Arc;

use glam::Vec3;

use crate::bcsdf::{HairBcsdf, HairScatter};
use crate::error::ScatteringError;
use crate::lobe::LobeValues;
use crate::medulla::FurParameters;
use crate::medulla_table::{MedullaKey, MedullaTable};
use crate::per_strand::Absorption;
use crate::sample::FibreSample;

/// A fur material, ready to be met by rays. Without a medulla it is hair, bit for bit.
#[derive(Debug, Clone)]
pub struct FurBcsdf {
    hair: HairBcsdf,
    table: Option<Arc<MedullaTable>>,
}

impl FurBcsdf {
    /// Prepares a material with the table it needs ([`MedullaKey::needed`]).
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter outside its bounds, or the table that is missing
    /// or was made for another material.
    pub fn new(
        parameters: &FurParameters,
        table: Option<Arc<MedullaTable>>,
    ) -> Result<FurBcsdf, ScatteringError> {
        parameters.check()?;
        match (MedullaKey::needed(parameters), &table) {
            (Some(_), None) => Err(ScatteringError::Table),
            _ => Ok(FurBcsdf { hair: HairBcsdf::new(&parameters.hair)?, table }),
        }
    }

    /// The fibre as seen from `wo` at the offset `h`: see [`HairBcsdf::at`].
    #[must_use]
    pub fn at(&self, wo: Vec3, h: f32, absorption: Absorption) -> FurScatter<'_> {
        let hair = self.hair.with_absorption(absorption).at(wo, h);
        FurScatter { hair, table: self.table.as_deref() }
    }
}

/// A fibre of fur met by a ray.
#[derive(Debug, Clone, Copy)]
pub struct FurScatter<'a> {
    hair: HairScatter,
    #[allow(dead_code)]
    table: Option<&'a MedullaTable>,
}

impl FurScatter<'_> {
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
