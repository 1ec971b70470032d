//! Where light that the medulla scattered leaves the fibre: a table per material.
//!
//! How much light is scattered is known exactly. The table says, for light that is: by how long a path
//! through cortex and medulla it leaves, and in which direction, depending on the path.

use crate::error::ScatteringError;
use crate::fur::counts::Counts;
use crate::fur::grid::ROWS;
use crate::fur::medulla::{FurParameters, Medulla};
use crate::fur::paths::{NODES, PathNode};
use crate::fur::row::{CLASSES, MedullaRow, default_walks};
use crate::hair::parameters::{HairParameters, WaterFilm};

/// What a table is made for: everything that bends or scatters light, nothing that absorbs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MedullaKey {
    /// As [`crate::Medulla::kappa`]; above 0.
    pub kappa: f32,
    /// As [`crate::Medulla::sigma_s`]; above 0.
    pub sigma_s: f32,
    /// As [`crate::Medulla::g`].
    pub g: f32,
    /// As [`crate::HairParameters::eta`].
    pub eta: f32,
    /// As [`crate::HairParameters::cuticle_layers`].
    pub cuticle_layers: Option<f32>,
    /// Index of the film of water, if there is one.
    pub film_eta: Option<f32>,
    /// Walks traced for each row, at most 100 million; 0 for as many as make a table in about two seconds
    /// on two cores ([`MedullaKey::walks_per_row`]).
    pub walks: u32,
}

/// More are taken for a mistake: they would need gigabytes.
const MOST_WALKS: u32 = 100_000_000;

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

    /// How many walks each row is made of.
    #[must_use]
    pub fn walks_per_row(&self) -> u32 {
        if self.walks == 0 { default_walks(self) } else { self.walks }
    }

    /// Whether a table of this key serves where one of `other` is asked for: all but the quality is the same.
    #[must_use]
    pub fn serves(&self, other: &MedullaKey) -> bool {
        MedullaKey { walks: other.walks, ..*self } == *other
    }

    /// The material of this key, as far as the key knows it.
    pub(crate) fn parameters(&self) -> FurParameters {
        let hair = HairParameters {
            eta: self.eta,
            cuticle_layers: self.cuticle_layers,
            film: self.film_eta.map(|eta| WaterFilm { eta, ..WaterFilm::default() }),
            ..HairParameters::default()
        };
        let medulla = Medulla { kappa: self.kappa, sigma_s: self.sigma_s, g: self.g, ..Medulla::NONE };
        FurParameters { hair, medulla }
    }

    /// Checks the bounds of all parameters.
    ///
    /// # Errors
    /// The first bound broken; a medulla that does not scatter breaks that of `kappa` or `sigma_s`.
    pub fn check(&self) -> Result<(), ScatteringError> {
        self.parameters().check()?;
        if self.walks > MOST_WALKS {
            let (name, range) = ("walks", "[0, 1e8]");
            return Err(ScatteringError::OutOfRange { name, found: self.walks as f32, range });
        }
        for (name, found, range) in
            [("medulla.kappa", self.kappa, "(0, 0.99]"), ("medulla.sigma_s", self.sigma_s, "(0, 100]")]
        {
            if found <= 0.0 {
                return Err(ScatteringError::OutOfRange { name, found, range });
            }
        }
        Ok(())
    }
}

/// Light scattered by the medulla, as walks through the whole fibre found it. About 500 KiB.
#[derive(Debug, Clone, PartialEq)]
pub struct MedullaTable {
    key: MedullaKey,
    pub(crate) counts: Vec<Counts>,
    pub(crate) nodes: Vec<[[PathNode; NODES]; CLASSES]>,
}

impl MedullaTable {
    /// Sines of the inclinations, and the step of the azimuth from TT's, between which the density of the
    /// scattered lobe is linear: where a quadrature must begin anew.
    #[must_use]
    pub fn knots() -> (&'static [f64], f64) {
        (&crate::fur::grid::KNOTS, crate::fur::grid::STEP_AROUND)
    }

    /// What it was made for.
    #[must_use]
    pub fn key(&self) -> &MedullaKey {
        &self.key
    }

    /// How many rows a table has.
    #[must_use]
    pub const fn row_count() -> usize {
        ROWS
    }

    /// Makes one row: the same on any thread, in any order.
    ///
    /// # Errors
    /// As [`MedullaTable::build`]; `row` beyond [`MedullaTable::row_count`] is out of range too.
    pub fn walk_row(key: &MedullaKey, row: usize) -> Result<MedullaRow, ScatteringError> {
        key.check()?;
        if row >= ROWS {
            return Err(ScatteringError::OutOfRange { name: "row", found: row as f32, range: "[0, 80)" });
        }
        Ok(MedullaRow::walk(key, row))
    }

    /// The table of all rows of `key`, in order.
    ///
    /// # Errors
    /// [`ScatteringError::Table`] where rows are missing.
    pub fn from_rows(key: &MedullaKey, rows: &[MedullaRow]) -> Result<MedullaTable, ScatteringError> {
        key.check()?;
        if rows.len() != ROWS {
            return Err(ScatteringError::Table);
        }
        let counts = rows.iter().map(|row| Counts::clone(&row.counts)).collect();
        let nodes = rows.iter().map(|row| row.nodes).collect();
        Ok(MedullaTable { key: *key, counts, nodes })
    }

    /// Builds the table on this thread. See the crate `medulla-tables` for all threads and a cache on disk.
    ///
    /// # Errors
    /// [`ScatteringError::OutOfRange`] where the key is outside the bounds of its parameters.
    pub fn build(key: &MedullaKey) -> Result<MedullaTable, ScatteringError> {
        let rows: Result<Vec<_>, _> = (0..ROWS).map(|row| Self::walk_row(key, row)).collect();
        Self::from_rows(key, &rows?)
    }

    /// Bytes it takes in memory.
    #[must_use]
    pub fn size(&self) -> usize {
        size_of_val(self.counts.as_slice()) + size_of_val(self.nodes.as_slice()) + size_of::<Self>()
    }

    /// Of parts that have been checked.
    pub(crate) fn of_parts(
        key: MedullaKey,
        counts: Vec<Counts>,
        nodes: Vec<[[PathNode; NODES]; CLASSES]>,
    ) -> MedullaTable {
        MedullaTable { key, counts, nodes }
    }
}
