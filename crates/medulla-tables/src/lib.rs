//! Tables of fur's medulla: built on all threads, kept in memory and on disk.
//!
//! A table depends on what bends and scatters light and on nothing that absorbs it. [`find`] looks for it in
//! this process, then in the cache on disk ([`cache_folder`]), and builds it if it is in neither; the
//! answer says which it was. A cache that cannot be read or written is no error: the table is built, and a
//! [`CacheFault`] says what was wrong.
//!
//! ```no_run
//! use fibre_scattering::{FurBcsdf, FurParameters, Medulla};
//!
//! let medulla = Medulla { kappa: 0.86, sigma_s: 3.15, g: 0.79, ..Medulla::NONE };
//! let parameters = FurParameters { medulla, ..FurParameters::default() };
//! let found = medulla_tables::needed(&parameters)?;
//! let fur = FurBcsdf::new(&parameters, found.map(|found| found.table))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod cache;
mod memory;

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use fibre_scattering::{FurParameters, MedullaKey, MedullaTable};

pub use build::build;
pub use cache::{CacheFault, cache_file, cache_folder};

/// A table and where it came from.
#[derive(Debug, Clone)]
pub struct Found {
    /// The table, shared by all who ask for its key.
    pub table: Arc<MedullaTable>,
    /// Where it came from.
    pub source: Source,
    /// What was wrong with the cache on disk, if anything was.
    pub fault: Option<CacheFault>,
}

/// Where a table came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// It was in this process already.
    Memory,
    /// Read from the cache on disk, and checked.
    Disk,
    /// Built now.
    Built {
        /// How long that took.
        elapsed: Duration,
    },
}

/// Why a table could not be had.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// The key is outside its bounds.
    #[error(transparent)]
    Scattering(#[from] fibre_scattering::ScatteringError),
}

/// The table of `key`: from memory, from the cache on disk, or built. See [`find`] to learn which.
///
/// # Errors
/// The first parameter of `key` outside its bounds.
pub fn table(key: &MedullaKey) -> Result<Arc<MedullaTable>, TableError> {
    Ok(find(key)?.table)
}

/// [`table`], and where it came from.
///
/// # Errors
/// As [`table`].
pub fn find(key: &MedullaKey) -> Result<Found, TableError> {
    find_in(key, cache_folder().as_deref())
}

/// The table that `parameters` need, if they need one: [`MedullaKey::needed`], then [`find`].
///
/// # Errors
/// As [`table`].
pub fn needed(parameters: &FurParameters) -> Result<Option<Found>, TableError> {
    MedullaKey::needed(parameters).map(|key| find(&key)).transpose()
}

/// [`find`] with another folder for the cache on disk, which need not exist, or with none.
///
/// # Errors
/// As [`table`].
pub fn find_in(key: &MedullaKey, folder: Option<&Path>) -> Result<Found, TableError> {
    key.check()?;
    if let Some(table) = memory::get(key) {
        return Ok(Found { table, source: Source::Memory, fault: None });
    }
    let (table, source, fault) = cache::get_or_build(key, folder)?;
    Ok(Found { table: memory::keep(table), source, fault })
}
