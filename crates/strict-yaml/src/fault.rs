//! What is wrong with a text, and where.

use std::path::PathBuf;

/// More faults than this are not told at once.
pub(crate) const MOST_FAULTS: usize = 100;

/// A place in a text, both counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line.
    pub line: usize,
    /// The column, in characters.
    pub column: usize,
}

/// Why a text could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct YamlFault {
    /// Where; `None` for what came from elsewhere than the text.
    pub place: Option<Place>,
    /// What is wrong, in plain words.
    pub message: String,
}

impl std::fmt::Display for YamlFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(Place { line, column }) = self.place {
            write!(f, "{line}:{column}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for YamlFault {}

/// One thing wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file.
    pub file: PathBuf,
    /// Line and column, from 1; `None` for what stands on the command line or nowhere.
    pub place: Option<(usize, usize)>,
    /// The key, as `render.spp`; empty where the message names it.
    pub key: String,
    /// What is wrong and what would be right.
    pub message: String,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:", self.file.display())?;
        if let Some((line, column)) = self.place {
            write!(f, "{line}:{column}:")?;
        }
        if !self.key.is_empty() {
            write!(f, " {}:", self.key)?;
        }
        write!(f, " {}", self.message)
    }
}

/// Why a document could not be put together.
#[derive(Debug)]
pub enum DocumentError {
    /// The file itself could not be read.
    Io {
        /// The file.
        file: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Everything wrong with it and the files it includes.
    Faults(Vec<Fault>),
}

impl std::fmt::Display for DocumentError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            DocumentError::Io { file, source } => write!(f, "{}: could not read: {source}", file.display()),
            DocumentError::Faults(faults) => {
                let lines: Vec<String> = faults.iter().map(ToString::to_string).collect();
                f.write_str(&lines.join("\n"))
            }
        }
    }
}

impl std::error::Error for DocumentError {}

pub(crate) fn place_of(error: &serde_yaml::Error) -> Option<Place> {
    error.location().map(|l| Place { line: l.line(), column: l.column() })
}
