//! What can be wrong with a layer.

use std::fmt;

/// A place in a file, what is there, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: found {found}, expected {expected}")]
pub struct ReadError {
    /// Where.
    pub place: Place,
    /// What is there.
    pub found: String,
    /// What would be right.
    pub expected: String,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a text: line and byte in the line, both from 1.
    Line {
        /// Which line.
        line: usize,
        /// Which byte of it.
        column: usize,
    },
    /// In a crate or package: the byte, from 0.
    Byte(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line { line, column } => write!(f, "line {line}, column {column}"),
            Place::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

impl ReadError {
    pub(crate) fn byte(byte: u64, found: impl Into<String>, expected: impl Into<String>) -> Self {
        ReadError { place: Place::Byte(byte), found: found.into(), expected: expected.into() }
    }

    /// At byte `at` of the text `bytes`.
    pub(crate) fn text(
        bytes: &[u8],
        at: usize,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let before = &bytes[..at.min(bytes.len())];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        let column = before.iter().rev().take_while(|&&byte| byte != b'\n').count() + 1;
        ReadError { place: Place::Line { line, column }, found: found.into(), expected: expected.into() }
    }
}

/// A few bytes for a message; what cannot be seen is spelt out.
pub(crate) fn quoted(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|&byte| byte == b'\n').unwrap_or(bytes.len()).min(24);
    match bytes.first() {
        None => "the end".into(),
        Some(b'\n') => "the end of the line".into(),
        Some(_) => {
            let cut = String::from_utf8_lossy(&bytes[..end]);
            format!("`{}`{}", cut.escape_debug(), if end == 24 { "..." } else { "" })
        }
    }
}
