//! A table from nothing, on all threads.

use fibre_scattering::{MedullaKey, MedullaTable, ScatteringError};
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// Builds the table of `key` on the threads of the current rayon pool. Their number changes nothing in it.
///
/// # Errors
/// The first parameter of `key` outside its bounds.
pub fn build(key: &MedullaKey) -> Result<MedullaTable, ScatteringError> {
    let rows: Result<Vec<_>, _> = (0..MedullaTable::row_count())
        .into_par_iter()
        .with_max_len(1)
        .map(|row| MedullaTable::walk_row(key, row))
        .collect();
    MedullaTable::from_rows(key, &rows?)
}
