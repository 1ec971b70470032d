//! Fur in double precision: the measure of the fast path.

use std::sync::Arc;

use crate::error::ScatteringError;
use crate::fur::bcsdf::suitable;
use crate::fur::medulla::FurParameters;
use crate::fur::model::{Fur, FurHit};
use crate::fur::scattered::passed;
use crate::fur::table::MedullaTable;

/// [`FurBcsdf`](crate::FurBcsdf) in `f64` over the same table, for tests and for offline figures.
#[derive(Debug, Clone)]
pub struct FurReference {
    fur: Fur<f64>,
    absorption: [[f64; 3]; 2],
}

impl FurReference {
    /// Prepares a material.
    ///
    /// # Errors
    /// As [`FurBcsdf::new`](crate::FurBcsdf::new).
    pub fn new(
        parameters: &FurParameters,
        table: Option<Arc<MedullaTable>>,
    ) -> Result<FurReference, ScatteringError> {
        parameters.check()?;
        let table = suitable(parameters, table)?;
        let absorption = [parameters.hair.sigma_a, parameters.medulla.sigma_a]
            .map(|sigma| sigma.to_array().map(f64::from));
        Ok(FurReference { fur: Fur::new(parameters, table), absorption })
    }

    /// The fibre as seen from `wo` at the offset `h`, with the material's own absorption.
    #[must_use]
    pub fn at(&self, wo: [f64; 3], h: f64) -> FurReferenceScatter<'_> {
        self.at_absorbing(wo, h, self.absorption)
    }

    /// The same with another absorption per fibre radius, of cortex and medulla; each at least 0.
    #[must_use]
    pub fn at_absorbing(&self, wo: [f64; 3], h: f64, absorption: [[f64; 3]; 2]) -> FurReferenceScatter<'_> {
        let absorption = absorption.map(|sigma| sigma.map(|sigma| sigma.max(0.0)));
        let hit = self.fur.at(wo, h, absorption, |table, row| passed(table, row, absorption));
        FurReferenceScatter { hit }
    }
}

/// [`FurScatter`](crate::FurScatter) in `f64`; directions and RGB are arrays of three.
#[derive(Debug, Clone, Copy)]
pub struct FurReferenceScatter<'a> {
    hit: FurHit<'a, f64>,
}

impl FurReferenceScatter<'_> {
    /// f cos(theta_i) of each lobe, and the density per steradian.
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: [f64; 3]) -> ([[f64; 3]; 5], f64) {
        self.hit.evaluate_with_pdf(wi)
    }

    /// Draws a direction from four uniform numbers in [0, 1).
    #[must_use]
    pub fn sample_direction(&self, u: [f64; 4]) -> Option<[f64; 3]> {
        self.hit.sample_direction(u).map(|(wi, _)| wi)
    }

    /// The share each lobe scatters, times its weight.
    #[must_use]
    pub fn albedo(&self) -> [[f64; 3]; 5] {
        self.hit.attenuations()
    }
}
