//! What can be wrong with a glTF file.

use std::io;
use std::path::PathBuf;

/// A glTF file that could not be read. The file itself is the caller's to name.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The file breaks the rules of glTF 2.0.
    #[error("{place}: found {found}, expected {expected}")]
    Invalid {
        /// Where, in glTF's own terms: `GLB byte 12`, `JSON line 1 column 7`, `accessors[3]`.
        place: String,
        /// What is there.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// The file is sound but uses what is not read here.
    #[error("{what} is not supported; {remedy}")]
    Unsupported {
        /// What it uses.
        what: String,
        /// What to do instead.
        remedy: &'static str,
    },
    /// A file that the document names could not be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// That file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

impl GltfError {
    pub(crate) fn invalid(
        place: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        GltfError::Invalid { place: place.into(), found: found.into(), expected: expected.into() }
    }
}
