//! What can go wrong between a description and a picture on disk.

use std::path::PathBuf;

use whole_file::WholeFileError;

/// A scene, picture or file that cannot be made as asked.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A setting or a part of the scene is out of its range.
    #[error("{what} is {found}, expected {expected}")]
    Argument {
        /// What was given.
        what: &'static str,
        /// The value found.
        found: String,
        /// The range it must lie in.
        expected: &'static str,
    },
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why not.
        #[source]
        source: std::io::Error,
    },
    /// A picture file breaks its format's rules.
    #[error("{}: not a readable picture: {reason}", path.display())]
    InvalidPicture {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A picture file may be sound, but is nothing that light can be taken from.
    #[error("{}: cannot serve as an environment: {reason}", path.display())]
    UnsupportedPicture {
        /// The file.
        path: PathBuf,
        /// What is missing.
        reason: String,
    },
    /// The picture could not be encoded.
    #[error("{}: cannot be encoded: {reason}", path.display())]
    Encode {
        /// The file that was to be written.
        path: PathBuf,
        /// What the encoder said.
        reason: String,
    },
    /// The hair material is out of its range.
    #[error("hair object {object}: {source}")]
    Scattering {
        /// Index into the scene's hair.
        object: usize,
        /// What the scattering model said.
        #[source]
        source: fibre_scattering::ScatteringError,
    },
    /// The material of a groom is out of its range.
    #[error("hair object {object}: {source}")]
    Material {
        /// Index into the scene's hair.
        object: usize,
        /// What is wrong with it.
        #[source]
        source: fibre_material::MaterialError,
    },
    /// The table of a fur material could not be had.
    #[error("hair object {object}: {source}")]
    Table {
        /// Index into the scene's hair.
        object: usize,
        /// Why not.
        #[source]
        source: medulla_tables::TableError,
    },
    /// The geometry cannot be traced.
    #[error(transparent)]
    Tracing(#[from] strand_tracing::TracingError),
    /// A mesh cannot be posed.
    #[error(transparent)]
    Mesh(#[from] moving_mesh::MeshError),
    /// The threads could not be started.
    #[error("cannot start {threads} threads: {reason}")]
    Threads {
        /// How many were asked for (0: one a core).
        threads: usize,
        /// What the operating system said.
        reason: String,
    },
    /// A checkpoint is of another picture than the one asked for.
    #[error("the checkpoint's {what} is {found}, expected {expected}")]
    OtherCheckpoint {
        /// What differs.
        what: &'static str,
        /// What the checkpoint has.
        found: String,
        /// What is asked for.
        expected: String,
    },
    /// The caller asked to stop; nothing was kept.
    #[error("rendering was cancelled")]
    Cancelled,
}

impl RenderError {
    /// A value out of its range.
    pub(crate) fn argument(what: &'static str, found: impl ToString, expected: &'static str) -> Self {
        RenderError::Argument { what, found: found.to_string(), expected }
    }
}

impl From<WholeFileError> for RenderError {
    fn from(fault: WholeFileError) -> Self {
        let WholeFileError { path, action, source } = fault;
        let source = std::io::Error::new(source.kind(), format!("could not {action}: {source}"));
        RenderError::Io { path, source }
    }
}
