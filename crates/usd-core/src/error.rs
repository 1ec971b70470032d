//! What can go wrong with a subprocess.

use std::io;

/// usd-core is not there, or did not do what it was asked for.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UsdCoreError {
    /// No Python has the package.
    #[error(
        "usd-core is not installed for any Python here (tried {tried}); install it with \
         `python3 -m pip install usd-core numpy`, or point GROOMKIT_PYTHON to a Python that has it"
    )]
    Missing {
        /// The Pythons that were asked.
        tried: String,
    },
    /// The system refused to start it or to hold its scripts.
    #[error("{what}: {source}")]
    Io {
        /// What was being done.
        what: String,
        /// What the system said.
        source: io::Error,
    },
    /// It ran and failed.
    #[error("{script} {file}: {told}")]
    Failed {
        /// Which of our Python programs.
        script: &'static str,
        /// The file it was given.
        file: String,
        /// Its last words.
        told: String,
    },
    /// It answered something that is no answer.
    #[error("{script} {file}: its answer cannot be read: {source}")]
    Answer {
        /// Which of our Python programs.
        script: &'static str,
        /// The file it was given.
        file: String,
        /// Why not.
        source: serde_json::Error,
    },
}

impl UsdCoreError {
    pub(crate) fn io(what: impl Into<String>, source: io::Error) -> Self {
        UsdCoreError::Io { what: what.into(), source }
    }
}
