//! What can go wrong with an archive.

use std::io;

/// An archive that could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OgawaError {
    /// The system refused.
    #[error("{source}")]
    Io {
        /// What it said.
        #[from]
        source: io::Error,
    },
    /// The bytes are not an Ogawa archive, or a broken one.
    #[error("byte {offset}: {what}: found {found}, expected {expected}")]
    Invalid {
        /// Where in the file.
        offset: u64,
        /// Which part of the layout.
        what: &'static str,
        /// What is there.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// A property is asked for something it is not.
    #[error("property `{name}`: found {found}, expected {expected}")]
    Property {
        /// Its name.
        name: String,
        /// What it is.
        found: String,
        /// What it should have been.
        expected: String,
    },
    /// A name or text that the layout has no bytes for.
    #[error("{what} {found:?}, expected {expected}")]
    Unwritable {
        /// What it is the name of.
        what: &'static str,
        /// The text.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
}

impl OgawaError {
    pub(crate) fn invalid(
        offset: u64,
        what: &'static str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        OgawaError::Invalid { offset, what, found: found.into(), expected: expected.into() }
    }
}
