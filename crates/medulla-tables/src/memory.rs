//! Tables of this process.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use fibre_scattering::{MedullaKey, MedullaTable};

/// By [`MedullaKey::to_bytes`]: floats have no hash of their own.
type Tables = HashMap<[u8; 28], Arc<MedullaTable>>;

fn tables() -> MutexGuard<'static, Tables> {
    static TABLES: OnceLock<Mutex<Tables>> = OnceLock::new();
    // Tables are put in place whole: a panic elsewhere cannot leave half of one.
    TABLES.get_or_init(Mutex::default).lock().unwrap_or_else(PoisonError::into_inner)
}

pub(crate) fn get(key: &MedullaKey) -> Option<Arc<MedullaTable>> {
    tables().get(&key.to_bytes()).cloned()
}

/// Keeps a table; if another thread was faster, its table, which is the same. (No lock is held while a
/// table is built: a thread of rayon's that waited for one could be the one that has to build it.)
pub(crate) fn keep(table: MedullaTable) -> Arc<MedullaTable> {
    tables().entry(table.key().to_bytes()).or_insert_with(|| Arc::new(table)).clone()
}
