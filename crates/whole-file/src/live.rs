//! The temporary files this process has open, so that an interrupt can remove them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static LIVE: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn live() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    // A panic elsewhere cannot leave a set of paths half changed.
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

pub(crate) fn enter(path: &Path) {
    live().insert(path.to_owned());
}

pub(crate) fn leave(path: &Path) {
    live().remove(path);
}

/// Removes every temporary file of this process that was not committed.
///
/// For interrupt handlers that exit right after: a [`crate::WholeFile`] still being written to keeps
/// writing to a file without a name, and its commit fails.
pub fn abandon_all() {
    for path in std::mem::take(&mut *live()) {
        // Already renamed or removed is as good as removed.
        let _ = std::fs::remove_file(path);
    }
}
