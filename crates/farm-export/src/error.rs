//! Why a job cannot be exported.

use std::path::PathBuf;

/// A job that the format cannot say, or that no farm could run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FarmError {
    /// Tasks start in other folders, and a relative path would name something else there.
    #[error("{what} `{}` is relative: tasks start in folders of their own, so give it from the root", path.display())]
    Relative {
        /// Which path.
        what: &'static str,
        /// The path.
        path: PathBuf,
    },

    /// A path whose bytes are no Unicode text.
    #[error("{what} `{}` is not Unicode, and the file could not hold it; rename it", path.display())]
    NotUnicode {
        /// Which path.
        what: &'static str,
        /// The path, as well as it can be shown.
        path: PathBuf,
    },

    /// A word with a line break or another control character.
    #[error(
        "{what} {text:?} holds the control character {character:?}, which {format} cannot say; rename it"
    )]
    Control {
        /// What the word is.
        what: &'static str,
        /// The word.
        text: String,
        /// The first of them.
        character: char,
        /// What was to be written.
        format: &'static str,
    },

    /// A number out of its range.
    #[error("{what} is {found}, and must be {right}")]
    Number {
        /// What the number is.
        what: &'static str,
        /// What was given.
        found: String,
        /// What would be right.
        right: String,
    },

    /// A text that is longer than the format allows.
    #[error("{what} has {found} characters, and {format} allows {most}: {remedy}")]
    TooLong {
        /// What the text is.
        what: String,
        /// Its length in characters.
        found: usize,
        /// The most that can be said.
        most: usize,
        /// What was to be written.
        format: &'static str,
        /// What to do.
        remedy: &'static str,
    },

    /// More of something than the format allows.
    #[error("{found} {what}, and {format} allows {most}: {remedy}")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// The most that can be said.
        most: usize,
        /// What was to be written.
        format: &'static str,
        /// What to do.
        remedy: &'static str,
    },

    /// Something that must be there is not, or contradicts itself.
    #[error("{0}")]
    Incomplete(String),
}
