//! What a plan consists of: an output, and whether it has to be made.

use std::path::PathBuf;

use crate::digest::Digest;

/// Whether an output has to be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// It is there, whole, and made from what the pipeline says now.
    UpToDate,
    /// It is not there.
    Missing,
    /// It was made from something else, or its bytes are not those that were written.
    Stale,
    /// The same picture is there under another number or of another variant, in this file.
    Elsewhere(PathBuf),
    /// Nobody asked for it.
    NotAsked,
    /// It is asked for, and so many frames it is made of are neither there nor asked for.
    Waiting(usize),
}

/// What kind of output a step makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepKind {
    /// The groom in another format.
    Convert,
    /// A rendered frame: its number, from 1, and its azimuth in degrees.
    Frame {
        /// Number, from 1.
        number: u32,
        /// Azimuth of the camera, degrees in 0..360.
        azimuth: f64,
    },
    /// A frame as a PNG.
    Preview {
        /// Number of the frame, from 1.
        number: u32,
    },
    /// The contact sheet.
    Sheet,
    /// A film: its place in `video`.
    Video {
        /// Which of the pipeline's films, from 0.
        index: usize,
    },
    /// The page that shows the result.
    Page,
}

/// One output.
#[derive(Clone, Debug)]
pub struct Step {
    /// Which variant it shows, as a place among [`crate::Plan::variants`]; none for what shows several.
    pub variant: Option<usize>,
    /// What it is.
    pub kind: StepKind,
    /// Its path inside the output folder.
    pub output: PathBuf,
    /// Whether it has to be made.
    pub state: State,
    pub(crate) digest: Digest,
    /// The frames it is made of, as places among the frames of all variants.
    pub(crate) needs: Vec<usize>,
}
