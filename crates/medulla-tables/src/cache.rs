//! Tables on disk: one file each, named after its key, with a digest of its bytes at the end.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use fibre_scattering::{MedullaKey, MedullaTable, ScatteringError};

use crate::Source;
use crate::build::build;

/// What was wrong with the cache on disk. The table is sound all the same.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CacheFault {
    /// A file was there and could not be read.
    #[error("cannot read the medulla's table from {path}: {reason}; it was built anew")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
    /// A file was there and is not what it should be: cut short, changed, or of another version.
    #[error("{path} is damaged or not a medulla's table; it was built anew and replaced")]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// The table could not be written: it will be built again next time.
    #[error("cannot keep the medulla's table in {path}: {reason}; it will be built again next time")]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
}

/// The folder of the cache: `$GROOMKIT_CACHE`, else `$XDG_CACHE_HOME/groomkit`, else `~/.cache/groomkit`;
/// none where no variable says where. Empty variables and, of the last two, relative paths do not
/// count.
#[must_use]
pub fn cache_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let absolute = |name| variable(name).filter(|path| path.is_absolute());
    variable("GROOMKIT_CACHE")
        .or_else(|| absolute("XDG_CACHE_HOME").map(|path| path.join("groomkit")))
        .or_else(|| absolute("HOME").map(|path| path.join(".cache/groomkit")))
}

/// Where in `folder` the table of `key` is kept. The name tells the version of the format too: programs of
/// different versions may share a folder.
#[must_use]
pub fn cache_file(folder: &Path, key: &MedullaKey) -> PathBuf {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&MedullaTable::VERSION.to_le_bytes());
    hasher.update(&key.to_bytes());
    folder.join(format!("medulla-{}.table", hasher.finalize().to_hex()))
}

/// The table of `key`, which has passed its check: read from `folder`, or built and kept there.
pub(crate) fn get_or_build(
    key: &MedullaKey,
    folder: Option<&Path>,
) -> Result<(MedullaTable, Source, Option<CacheFault>), ScatteringError> {
    let path = folder.map(|folder| cache_file(folder, key));
    let mut fault = None;
    if let Some(path) = &path {
        match read(path, key) {
            Ok(Some(table)) => return Ok((table, Source::Disk, None)),
            Ok(None) => {}
            Err(found) => fault = Some(found),
        }
    }
    let start = Instant::now();
    let table = build(key)?;
    let elapsed = start.elapsed();
    if let Some(path) = path
        && let Err(error) = write(&path, &table)
    {
        fault.get_or_insert(CacheFault::Unwritable { path, reason: error.to_string() });
    }
    Ok((table, Source::Built { elapsed }, fault))
}

/// The table of a file; nothing where there is none.
fn read(path: &Path, key: &MedullaKey) -> Result<Option<MedullaTable>, CacheFault> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => {
            return Err(CacheFault::Unreadable { path: path.to_owned(), reason: error.to_string() });
        }
    };
    match checked(&bytes).filter(|table| table.key() == key) {
        Some(table) => Ok(Some(table)),
        None => Err(CacheFault::Damaged { path: path.to_owned() }),
    }
}

/// The table of a file's bytes, if they are those that were written.
fn checked(bytes: &[u8]) -> Option<MedullaTable> {
    let (table, digest) = bytes.split_last_chunk::<{ blake3::OUT_LEN }>()?;
    if blake3::hash(table) != *digest {
        return None;
    }
    MedullaTable::from_bytes(table).ok()
}

fn write(path: &Path, table: &MedullaTable) -> Result<(), Box<dyn std::error::Error>> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut bytes = table.to_bytes();
    let digest = blake3::hash(&bytes);
    bytes.extend_from_slice(digest.as_bytes());
    Ok(whole_file::write_whole(path, &bytes)?)
}
