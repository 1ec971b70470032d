//! What can be wrong with a material.

use std::path::{Path, PathBuf};

use strict_yaml::Fault;

/// Why a material was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MaterialError {
    /// A value is out of its range.
    #[error("{what} is {found}, expected {expected}")]
    Value {
        /// What was given.
        what: String,
        /// The value found.
        found: String,
        /// The range it must lie in.
        expected: &'static str,
    },
    /// A parameter of the scattering model is out of its range.
    #[error(transparent)]
    Scattering(#[from] fibre_scattering::ScatteringError),
    /// A material file says what it may not; every fault that could be found at once.
    #[error("{}", lines(.0))]
    File(Vec<Fault>),
    /// There is no preset of that name.
    #[error("unknown preset `{name}`, {hint}")]
    Preset {
        /// What was asked for.
        name: String,
        /// The name that may have been meant, or all there are.
        hint: String,
    },
    /// A file could not be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why not.
        #[source]
        source: std::io::Error,
    },
    /// A picture cannot serve as a texture.
    #[error("{}: cannot serve as a texture: {reason}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// The groom lacks what the material needs, or a ramp is none.
    #[error(transparent)]
    Groom(#[from] groom::GroomError),
}

impl MaterialError {
    pub(crate) fn value(what: impl Into<String>, found: impl ToString, expected: &'static str) -> Self {
        MaterialError::Value { what: what.into(), found: found.to_string(), expected }
    }

    pub(crate) fn picture(path: &Path, reason: impl ToString) -> Self {
        MaterialError::Picture { path: path.to_owned(), reason: reason.to_string() }
    }
}

fn lines(faults: &[Fault]) -> String {
    faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
