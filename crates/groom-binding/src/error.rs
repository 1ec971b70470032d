//! What can be wrong with a binding.

/// A binding that cannot be made, or not to this pose.
#[derive(Debug, thiserror::Error)]
pub enum BindingError {
    /// An option is out of range.
    #[error("{name} is {found}, expected {expected}")]
    OutOfRange {
        /// The option.
        name: &'static str,
        /// What was given.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// The surface, pose or groom does not fit the others.
    #[error("{place}: {found}, expected {expected}")]
    Invalid {
        /// Where: vertex, triangle or strand.
        place: String,
        /// What was found there.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// A change of the groom on its way to the mesh.
    #[error("{option}: {source}")]
    Alignment {
        /// Which change.
        option: &'static str,
        /// What is wrong with it.
        source: groom::GroomError,
    },
    /// What is needed of the mesh's file cannot be had: a picture, say.
    #[error(transparent)]
    Mesh(#[from] moving_mesh::MeshError),
    /// The groom does not take an attribute.
    #[error(transparent)]
    Groom(#[from] groom::GroomError),
}

impl BindingError {
    /// What was found at a place, and what would be right there.
    pub(crate) fn invalid(
        place: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        BindingError::Invalid { place: place.into(), found: found.into(), expected: expected.into() }
    }
}
