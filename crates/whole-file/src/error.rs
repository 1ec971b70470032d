//! What can go wrong on the way to a whole file.

use std::io;
use std::path::PathBuf;

/// A file that could not be written; the old file at the path, if any, is untouched.
#[derive(Debug, thiserror::Error)]
#[error("{}: could not {action}: {source}", path.display())]
pub struct WholeFileError {
    /// The file that was asked for.
    pub path: PathBuf,
    /// Which step failed.
    pub action: &'static str,
    /// What the system said.
    pub source: io::Error,
}

impl From<WholeFileError> for io::Error {
    fn from(error: WholeFileError) -> Self {
        io::Error::new(error.source.kind(), error)
    }
}
