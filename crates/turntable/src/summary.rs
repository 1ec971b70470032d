//! What a run made.

use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

/// What a run made and how exact its frames are.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// The output folder.
    pub output: PathBuf,
    /// Files made by this run, inside the output folder.
    pub made: Vec<PathBuf>,
    /// How many outputs were up to date.
    pub up_to_date: usize,
    /// What could not be made.
    pub failed: Vec<Failure>,
    /// The frames that were asked for, made now or before.
    pub frames: Vec<FrameLine>,
    /// Seconds this run took.
    pub seconds: f64,
}

/// A frame in figures.
#[derive(Clone, Debug, Serialize)]
pub struct FrameLine {
    /// The variant it shows, by its id; empty where the pipeline has no `matrix`.
    pub variant: String,
    /// Number, from 1.
    pub number: u32,
    /// The EXR, inside the output folder.
    pub file: PathBuf,
    /// Azimuth of the camera, degrees.
    pub azimuth: f64,
    /// Whether this run rendered it.
    pub rendered: bool,
    /// Samples a pixel.
    pub spp: u32,
    /// Threads that rendered it.
    pub threads: usize,
    /// Seconds it took to render, now or then.
    pub seconds: f64,
    /// Estimated relative error; none below 2 samples a pixel.
    pub relative_error: Option<f64>,
}

/// Outputs that could not be made, and why; the run went on with others.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// What was not made, inside the output folder; never empty.
    pub outputs: Vec<PathBuf>,
    /// Why.
    pub error: String,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(first) = self.outputs.first() {
            write!(f, "{}", first.display())?;
        }
        match self.outputs.len() {
            0 | 1 => {}
            count => write!(f, " and {} more", count - 1)?,
        }
        write!(f, ": {}", self.error)
    }
}
