//! What can go wrong between bytes and grooms.

use std::io;

use groom::GroomError;

use crate::Format;

/// A file that could not be read or written.
///
/// `file` is the path, or what stands for it (`standard input`).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The system refused: no such file, disk full, closed pipe.
    #[error("{file}: {source}")]
    Io {
        /// Which file.
        file: String,
        /// What the system said.
        source: io::Error,
    },
    /// The finished file could not be put in its place; the old one is untouched.
    #[error("{source}")]
    WholeFile {
        /// Which file, what failed and what the system said.
        source: whole_file::WholeFileError,
    },
    /// The ending stands for no format of groomkit.
    #[error("{file}: no groom format has this ending; expected one of {expected}")]
    UnknownFormat {
        /// Which file.
        file: String,
        /// The endings that would do.
        expected: String,
    },
    /// The format is known, but this cannot be done with it.
    #[error("{file}: {format} {what}")]
    Unsupported {
        /// Which file.
        file: String,
        /// Its format.
        format: Format,
        /// What cannot be done and what can be done instead.
        what: &'static str,
    },
    /// A HAIR file is broken, or cannot be written.
    #[cfg(feature = "hair")]
    #[error("{file}: {source}")]
    Hair {
        /// Which file.
        file: String,
        /// Field, byte offset, found and expected.
        source: cyhair::HairError,
    },
    /// A text file is broken.
    #[error("{file}: line {line}, column {column}: found {found}, expected {expected}")]
    Text {
        /// Which file.
        file: String,
        /// Line, from 1.
        line: u64,
        /// Byte in the line, from 1.
        column: usize,
        /// What is there.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// A file of any other format is broken.
    #[error("{file}: {place}: found {found}, expected {expected}")]
    Invalid {
        /// Which file.
        file: String,
        /// Where: `byte 12`, `line 3, column 7`, `/Groom/Strands.points`, `strand 4`.
        place: String,
        /// What is there.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// The arrays of a file do not make a groom.
    #[error("{file}: {source}")]
    Groom {
        /// Which file.
        file: String,
        /// What is wrong with them.
        source: GroomError,
    },
    /// A groom holds a value that no format can hold.
    #[error("{file}: {what} of point {vertex} (strand {strand}) is {found}, expected {expected}")]
    Value {
        /// The file being written.
        file: String,
        /// `position` or the attribute's name.
        what: &'static str,
        /// Index of the strand.
        strand: usize,
        /// Index of the point among all points.
        vertex: usize,
        /// The value.
        found: f32,
        /// What would be right.
        expected: &'static str,
    },
    /// There is nothing to write: no strand, or none with a segment where the format draws lines.
    #[error("{file}: {format} needs at least one strand{}, and the groom has none", if *.points > 1 { " of two points" } else { "" })]
    Empty {
        /// The file being written.
        file: String,
        /// Its format.
        format: Format,
        /// How many points a strand must have.
        points: usize,
    },
    /// More than the format's integers can count.
    #[error(
        "{file}: {found} {what} are more than {format} can hold ({limit}); thin the groom out or split it"
    )]
    TooLarge {
        /// The file.
        file: String,
        /// Its format.
        format: Format,
        /// What there is too much of.
        what: &'static str,
        /// How much there is.
        found: u64,
        /// How much there may be.
        limit: u64,
    },
}

impl FormatError {
    pub(crate) fn io(file: &str, source: io::Error) -> Self {
        FormatError::Io { file: file.to_owned(), source }
    }

    pub(crate) fn invalid(
        file: &str,
        place: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        FormatError::Invalid {
            file: file.to_owned(),
            place: place.into(),
            found: found.into(),
            expected: expected.into(),
        }
    }

    pub(crate) fn groom(file: &str, source: GroomError) -> Self {
        FormatError::Groom { file: file.to_owned(), source }
    }
}
