//! What can go wrong while a layer is written.

use std::io;

/// A layer that could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The stream refused.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// A path no prim or property can have.
    #[error("`{path}` is no path of a {what}; expected {expected}")]
    Path {
        /// The path.
        path: String,
        /// `prim` or `property`.
        what: &'static str,
        /// What would be right.
        expected: &'static str,
    },
    /// A prim or property was given twice.
    #[error("`{path}` is in the layer already")]
    Twice {
        /// Its path.
        path: String,
    },
    /// A prim lies under a path where there is none.
    #[error("`{path}` has no parent prim; write that one too")]
    NoParent {
        /// The prim's path.
        path: String,
    },
    /// A prim of another writer.
    #[error("prim number {index} is not of this layer")]
    UnknownPrim {
        /// Its number.
        index: usize,
    },
    /// More than the format can count.
    #[error("{found} {what} are more than {limit}")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How much there is.
        found: u64,
        /// How much there may be.
        limit: u64,
    },
}
