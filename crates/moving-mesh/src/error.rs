//! What can be wrong with a mesh file.

use std::io;
use std::path::PathBuf;

use usd_core::UsdCoreError;

/// A mesh that could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The system could not read the file, or a file it refers to.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file breaks its format's rules.
    #[error("{}: {place}: {fault}", path.display())]
    Invalid {
        /// The file.
        path: PathBuf,
        /// Where in it, in the format's own terms.
        place: String,
        /// What was found and what would be right.
        fault: String,
    },
    /// The file is sound but uses what groomkit does not read.
    #[error("{}: {what} is not supported; {remedy}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What it uses.
        what: String,
        /// What to do instead.
        remedy: &'static str,
    },
    /// The file has no such animation.
    #[error("{}: no animation {asked}; it has {known}", path.display())]
    NoAnimation {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        asked: String,
        /// What there is.
        known: String,
    },
    /// The file has no such camera.
    #[error("{}: no camera{asked}; it has {known}", path.display())]
    NoCamera {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        asked: String,
        /// What there is.
        known: String,
    },
    /// The file needs OpenUSD's own package, which is not there or did not do it.
    #[error("{}: USD composition and skinning are evaluated by usd-core: {source}", path.display())]
    UsdCore {
        /// The file.
        path: PathBuf,
        /// What usd-core said, or how to install it.
        source: UsdCoreError,
    },
    /// A number given to this crate is out of its range.
    #[error("{name} {value}: expected {range}")]
    Parameter {
        /// Which one.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What would be right.
        range: &'static str,
    },
}

/// A fault inside a file whose path the caller knows: place and fault, or unsupported.
#[derive(Debug)]
pub(crate) enum Fault {
    Invalid {
        place: String,
        fault: String,
    },
    Unsupported {
        what: String,
        remedy: &'static str,
    },
    Io {
        path: PathBuf,
        source: io::Error,
    },
    NoAnimation {
        asked: String,
        known: String,
    },
    NoCamera {
        asked: String,
        known: String,
    },
    UsdCore(UsdCoreError),
    /// In another file, whose name it has.
    Told(Box<MeshError>),
}

impl Fault {
    pub(crate) fn invalid(place: impl Into<String>, fault: impl Into<String>) -> Self {
        Fault::Invalid { place: place.into(), fault: fault.into() }
    }

    /// The same fault at a place that is found below `above`.
    pub(crate) fn below(self, above: &str) -> Self {
        match self {
            Fault::Invalid { place, fault } => Fault::Invalid { place: format!("{above}: {place}"), fault },
            other => other,
        }
    }

    pub(crate) fn in_file(self, path: &std::path::Path) -> MeshError {
        let path = path.to_owned();
        match self {
            Fault::Invalid { place, fault } => MeshError::Invalid { path, place, fault },
            Fault::Unsupported { what, remedy } => MeshError::Unsupported { path, what, remedy },
            Fault::Io { path, source } => MeshError::Io { path, source },
            Fault::Told(error) => *error,
            Fault::UsdCore(source) => MeshError::UsdCore { path, source },
            Fault::NoAnimation { asked, known } => MeshError::NoAnimation { path, asked, known },
            Fault::NoCamera { asked, known } => MeshError::NoCamera { path, asked, known },
        }
    }
}
