//! What can be wrong with a material.

/// Why a material was refused.
#[derive(Debug, thiserror::Error)]
pub enum MaterialError {
    /// A value is out of its range.
    #[error("{what} is {found}, expected {expected}")]
    Value {
        /// What was given.
        what: &'static str,
        /// The value found.
        found: String,
        /// The range it must lie in.
        expected: &'static str,
    },
    /// A parameter of the scattering model is out of its range.
    #[error(transparent)]
    Scattering(#[from] fibre_scattering::ScatteringError),
}

impl MaterialError {
    pub(crate) fn value(what: &'static str, found: impl ToString, expected: &'static str) -> Self {
        MaterialError::Value { what, found: found.to_string(), expected }
    }
}
