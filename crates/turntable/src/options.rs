//! What the caller asks for beside the pipeline file.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, Instant};

use hair_render::CheckpointEvery;

use crate::FrameRange;

/// What the caller asks for beside the file.
#[derive(Clone, Debug)]
pub struct Options {
    /// Settings laid over the file's, each as `render.spp=4`.
    pub settings: Vec<String>,
    /// Values of the file's variables, each as `name=value`.
    pub variables: Vec<String>,
    /// Variants to look after, each as `axis=name` or `axis=name,name`; all when empty.
    pub only: Vec<String>,
    /// Output folder instead of the file's.
    pub output: Option<PathBuf>,
    /// Frames to look after; all when `None`.
    pub frames: Option<FrameRange>,
    /// Kinds of work to look after; all when empty.
    pub phases: BTreeSet<Phase>,
    /// Rendering threads; one a core when `None`. Changes no pixel.
    pub threads: Option<usize>,
    /// Whether frames that were stopped half way are gone on with.
    pub resume: bool,
    /// How often the work on a frame is kept beside it while it is rendered; always when it has to stop.
    pub checkpoint_every: CheckpointEvery,
    /// How often the frame being rendered is written to the folder `snapshots`, as far as it is; only when
    /// [`crate::Reporter::snapshot_asked`] when `None`.
    pub snapshot_every: Option<Duration>,
    /// When to stop, keeping the work.
    pub deadline: Option<Instant>,
    /// Whether the first frame that cannot be made ends the run.
    pub fail_fast: bool,
    /// Whether to read every output for whether its bytes are those that were written, where otherwise its size and
    /// times are trusted.
    pub verify: bool,
    /// The command line, to be written into every frame.
    pub command: String,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            settings: Vec::new(),
            variables: Vec::new(),
            only: Vec::new(),
            output: None,
            frames: None,
            phases: BTreeSet::new(),
            threads: None,
            resume: true,
            checkpoint_every: CheckpointEvery::default(),
            snapshot_every: None,
            deadline: None,
            fail_fast: false,
            verify: false,
            command: String::new(),
        }
    }
}

impl Options {
    /// Whether this kind of work is to be looked after.
    #[must_use]
    pub fn wants(&self, phase: Phase) -> bool {
        self.phases.is_empty() || self.phases.contains(&phase)
    }
}

/// A kind of work, as a farm's tasks divide it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// What comes before frames: converted files.
    Prepare,
    /// Frames.
    Frames,
    /// What is made of frames, and the report.
    Outputs,
}

impl FromStr for Phase {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        match word {
            "prepare" => Ok(Phase::Prepare),
            "frames" => Ok(Phase::Frames),
            "outputs" => Ok(Phase::Outputs),
            _ => Err(format!("`{word}` is none of `prepare`, `frames` and `outputs`")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_phases_are_all() {
        let mut options = Options::default();
        assert!(options.wants(Phase::Frames) && options.wants(Phase::Prepare));
        options.phases.insert("outputs".parse().unwrap());
        assert!(options.wants(Phase::Outputs) && !options.wants(Phase::Frames));
        assert!("frame".parse::<Phase>().unwrap_err().contains("`frame`"));
    }
}
