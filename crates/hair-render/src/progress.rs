//! How a long render talks to whoever waits for it.

use crate::{Checkpoint, Frame};

/// Told of progress and asked whether to stop.
pub trait Progress: Sync {
    /// `done` of `total` parts (a tile in a pass) are finished, those of an earlier run included; called from any of
    /// the rendering threads, also out of order.
    fn advance(&self, done: u64, total: u64);

    /// Whether to stop, in the middle of a pass too; asked from any of the rendering threads, for every pixel. Tiles
    /// that are finished are kept.
    fn cancelled(&self) -> bool {
        false
    }

    /// Every pixel has another pass of samples, and there is more to come: the time to write a checkpoint or a
    /// snapshot. Called from the thread that called [`crate::render_from`], while nothing is rendered.
    fn pass_done(&self, so_far: &SoFar<'_>) -> Next {
        let _ = so_far;
        Next::GoOn
    }
}

/// What to do after a pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Next {
    /// Render the next one.
    #[default]
    GoOn,
    /// Stop here.
    Stop,
}

/// A render that is not finished.
#[derive(Clone, Copy, Debug)]
pub struct SoFar<'a> {
    pub(crate) checkpoint: &'a Checkpoint,
}

impl<'a> SoFar<'a> {
    /// What is needed to go on from here, in this process or another.
    #[must_use]
    pub fn checkpoint(&self) -> &'a Checkpoint {
        self.checkpoint
    }

    /// The picture of the samples so far.
    #[must_use]
    pub fn frame(&self) -> Frame {
        self.checkpoint.frame()
    }

    /// Samples a pixel so far.
    #[must_use]
    pub fn spp(&self) -> u32 {
        self.checkpoint.spp()
    }

    /// Samples a pixel that are asked for.
    #[must_use]
    pub fn spp_asked(&self) -> u32 {
        self.checkpoint.spp_asked()
    }

    /// Seconds spent rendering so far, those of earlier runs included.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.checkpoint.seconds()
    }
}

/// Tells nobody and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _done: u64, _total: u64) {}
}
