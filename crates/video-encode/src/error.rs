//! What can keep a film from being made.

use std::path::PathBuf;

/// Why there is no film. The old file, if any, is untouched.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VideoError {
    /// A setting that no film can have.
    #[error("{name} is {found}; expected {expected}")]
    Setting {
        /// Which one.
        name: &'static str,
        /// What was found.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// A picture that does not fit the film.
    #[error("picture {index}: {found} values; a film of {width} x {height} pixels wants {expected}, {depth}")]
    Picture {
        /// Which one, from 0.
        index: u64,
        /// How many values it has.
        found: usize,
        /// Width of the film.
        width: u32,
        /// Height of the film.
        height: u32,
        /// How many it should have.
        expected: usize,
        /// Which bits: those of the codec.
        depth: &'static str,
    },
    /// No picture was given.
    #[error("{}: a film needs a picture", path.display())]
    Empty {
        /// The film.
        path: PathBuf,
    },
    /// The program could not be started or spoken to.
    #[error("{}: could not {action}: {source}", program.display())]
    Io {
        /// The program.
        program: PathBuf,
        /// What was tried.
        action: &'static str,
        /// What the system said.
        source: std::io::Error,
    },
    /// ffmpeg gave up.
    #[error("{}: ffmpeg ended with {status}: {words}", path.display())]
    Ffmpeg {
        /// The film.
        path: PathBuf,
        /// Its exit status.
        status: String,
        /// What it said, the last lines of it.
        words: String,
    },
    /// The film could not be put in its place.
    #[error(transparent)]
    WholeFile(#[from] whole_file::WholeFileError),
}
