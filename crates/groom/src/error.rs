//! What can be wrong with a groom.

use crate::Domain;

/// A groom that cannot be made as asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GroomError {
    /// The offsets are not `0 = o[0] < o[1] < ... < o[n] = point count`.
    #[error("strand offsets: entry {index} is {found}, expected {expected}")]
    Offsets {
        /// Index into the offsets array.
        index: usize,
        /// The value there.
        found: u64,
        /// What would be right, in words.
        expected: String,
    },
    /// An attribute's length does not fit its domain.
    #[error("attribute `{name}` has {found} values, but domain {domain:?} needs {expected}")]
    AttributeLength {
        /// The attribute's name.
        name: String,
        /// Its domain.
        domain: Domain,
        /// How many values it has.
        found: usize,
        /// How many the groom needs.
        expected: usize,
    },
    /// A standard attribute has values of the wrong type.
    #[error("attribute `{name}` holds {found} values, expected {expected}")]
    AttributeType {
        /// The attribute's name.
        name: String,
        /// The type found.
        found: &'static str,
        /// The type the name stands for.
        expected: &'static str,
    },
    /// An operation needs an attribute that is not there, or not in the form it needs.
    #[error("attribute `{name}` is {found}, expected {expected}")]
    AttributeMissing {
        /// The attribute's name.
        name: &'static str,
        /// What there is in its place.
        found: &'static str,
        /// What is needed, and for what.
        expected: &'static str,
    },
    /// An operation was asked for with a value out of its range.
    #[error("{what} is {found}, expected {expected}")]
    Argument {
        /// Which argument.
        what: &'static str,
        /// The value given.
        found: String,
        /// The range it must lie in.
        expected: &'static str,
    },
}

impl GroomError {
    /// [`GroomError::Argument`].
    pub(crate) fn argument(what: &'static str, found: impl ToString, expected: &'static str) -> Self {
        GroomError::Argument { what, found: found.to_string(), expected }
    }
}
