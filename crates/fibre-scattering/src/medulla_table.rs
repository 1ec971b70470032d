//! Where light that the medulla scattered leaves the fibre: a table per material.

use crate::error::ScatteringError;
use crate::medulla::FurParameters;

/// What a table is made for: everything that bends or scatters light, nothing that absorbs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MedullaKey {
    /// As [`crate::Medulla::kappa`].
    pub kappa: f32,
    /// As [`crate::Medulla::sigma_s`].
    pub sigma_s: f32,
    /// As [`crate::Medulla::g`].
    pub g: f32,
    /// As [`crate::HairParameters::eta`].
    pub eta: f32,
    /// As [`crate::HairParameters::cuticle_layers`].
    pub cuticle_layers: Option<f32>,
    /// Index of the film of water, if there is one.
    pub film_eta: Option<f32>,
    /// Walks traced for each row.
    pub walks: u32,
}

impl MedullaKey {
    /// The table `parameters` need at default quality; `None` where nothing scatters inside.
    #[must_use]
    pub fn needed(parameters: &FurParameters) -> Option<MedullaKey> {
        let FurParameters { hair, medulla } = parameters;
        medulla.scatters().then_some(MedullaKey {
            kappa: medulla.kappa,
            sigma_s: medulla.sigma_s,
            g: medulla.g,
            eta: hair.eta,
            cuticle_layers: hair.cuticle_layers,
            film_eta: hair.film.map(|film| film.eta),
            walks: 0,
        })
    }
}

/// Light scattered by the medulla, as walks through the whole fibre found it.
#[derive(Debug, Clone, PartialEq)]
pub struct MedullaTable {
    key: MedullaKey,
}

impl MedullaTable {
    /// What it was made for.
    #[must_use]
    pub fn key(&self) -> &MedullaKey {
        &self.key
    }

    /// Builds the table on this thread. See the crate `medulla-tables` for all threads and a cache on disk.
    ///
    /// # Errors
    /// [`ScatteringError::OutOfRange`] where the key is outside the bounds of its parameters.
    pub fn build(key: &MedullaKey) -> Result<MedullaTable, ScatteringError> {
        Ok(MedullaTable { key: *key })
    }
}
