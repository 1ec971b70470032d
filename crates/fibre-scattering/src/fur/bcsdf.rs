//! Fur in single precision: what a renderer calls.

use std::sync::Arc;

use glam::Vec3;

use crate::error::ScatteringError;
use crate::fur::medulla::FurParameters;
use crate::fur::model::{Fur, FurHit};
use crate::fur::scattered::{Passed, all_passed, passed};
use crate::fur::table::{MedullaKey, MedullaTable};
use crate::lobe::{Lobe, LobeValues};
use crate::per_strand::Absorption;
use crate::sample::FibreSample;

/// A fur material, ready to be met by rays. Without a medulla it is hair, bit for bit.
#[derive(Debug, Clone)]
pub struct FurBcsdf {
    fur: Fur<f32>,
    absorption: Absorption,
    /// What each row of the table lets pass for the material's own absorption.
    passed: Arc<[Passed<f32>]>,
}

impl FurBcsdf {
    /// Prepares a material with the table it needs ([`MedullaKey::needed`]; of any quality).
    ///
    /// # Errors
    /// A [`ScatteringError`] naming the first parameter outside its bounds, or the table that is missing
    /// or was made for another material.
    pub fn new(
        parameters: &FurParameters,
        table: Option<Arc<MedullaTable>>,
    ) -> Result<FurBcsdf, ScatteringError> {
        parameters.check()?;
        let table = suitable(parameters, table)?;
        let absorption = Absorption::new(parameters.hair.sigma_a, parameters.medulla.sigma_a)?;
        let passed = match &table {
            Some(table) => (0..MedullaTable::row_count())
                .map(|row| passed(table, row, coefficients(absorption)))
                .collect(),
            None => Arc::default(),
        };
        Ok(FurBcsdf { fur: Fur::new(parameters, table), absorption, passed })
    }

    /// The fibre as seen from `wo` at the offset `h`: see [`HairBcsdf::at`](crate::HairBcsdf::at).
    /// `absorption` stands in place of the material's; where it is the same, this is faster.
    #[must_use]
    pub fn at(&self, wo: Vec3, h: f32, absorption: Absorption) -> FurScatter<'_> {
        let sigmas = coefficients(absorption);
        let own = absorption == self.absorption;
        let white = sigmas == [[0.0; 3]; 2];
        let hit = self.fur.at(wo.to_array(), h, sigmas, |table, row| match self.passed.get(row) {
            _ if white => all_passed(),
            Some(&passed) if own => passed,
            _ => passed(table, row, sigmas),
        });
        FurScatter { hit }
    }
}

/// The table if `parameters` need one, and only if it is theirs.
pub(crate) fn suitable(
    parameters: &FurParameters,
    table: Option<Arc<MedullaTable>>,
) -> Result<Option<Arc<MedullaTable>>, ScatteringError> {
    match (MedullaKey::needed(parameters), table) {
        (None, _) => Ok(None),
        (Some(needed), Some(table)) if table.key().serves(&needed) => Ok(Some(table)),
        (Some(_), _) => Err(ScatteringError::Table),
    }
}

/// Of cortex and medulla.
fn coefficients(absorption: Absorption) -> [[f32; 3]; 2] {
    [absorption.cortex(), absorption.medulla()].map(|sigma| sigma.to_array())
}

/// A fibre of fur met by a ray.
#[derive(Debug, Clone, Copy)]
pub struct FurScatter<'a> {
    hit: FurHit<'a, f32>,
}

impl FurScatter<'_> {
    /// As [`HairScatter::evaluate`](crate::HairScatter::evaluate).
    #[must_use]
    pub fn evaluate(&self, wi: Vec3) -> LobeValues {
        self.evaluate_with_pdf(wi).0
    }

    /// As [`HairScatter::pdf`](crate::HairScatter::pdf).
    #[must_use]
    pub fn pdf(&self, wi: Vec3) -> f32 {
        self.evaluate_with_pdf(wi).1
    }

    /// As [`HairScatter::evaluate_with_pdf`](crate::HairScatter::evaluate_with_pdf).
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        let (values, pdf) = self.hit.evaluate_with_pdf(wi.to_array());
        (LobeValues(values.map(Vec3::from_array)), pdf)
    }

    /// As [`HairScatter::sample`](crate::HairScatter::sample).
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> Option<FibreSample> {
        let (wi, lobe) = self.hit.sample_direction(u)?;
        let wi = Vec3::from_array(wi);
        // Evaluated at the direction as rounded, as hair is.
        let (values, pdf) = self.evaluate_with_pdf(wi);
        (pdf > 0.0 && pdf.is_finite()).then_some(FibreSample { wi, values, pdf, lobe: Lobe::ALL[lobe] })
    }

    /// As [`HairScatter::albedo`](crate::HairScatter::albedo).
    #[must_use]
    pub fn albedo(&self) -> [Vec3; 5] {
        self.hit.attenuations().map(Vec3::from_array)
    }
}
