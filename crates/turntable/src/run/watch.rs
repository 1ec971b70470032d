//! What happens to a frame while it is rendered: it is told of, kept, shown.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use hair_render::{CheckpointTimer, Metadata, Next, Progress, SoFar};

use super::estimate::Estimate;
use crate::{Event, Options, Picture, Reporter};

/// Passes the renderer's progress on, and keeps what is rendered when it is time to.
pub(super) struct Watch<'a> {
    pub reporter: &'a dyn Reporter,
    pub options: &'a Options,
    /// How many frames came before.
    pub index: u32,
    pub of: u32,
    pub checkpoint: PathBuf,
    pub snapshot: PathBuf,
    pub metadata: &'a Metadata,
    pub left: Left<'a>,
    kept: Mutex<Kept>,
}

/// What is to be rendered, this frame included.
pub(super) struct Left<'a> {
    pub estimate: &'a Estimate,
    pub variant: usize,
    /// Frames by variant.
    pub frames: &'a [(usize, usize)],
}

/// When this frame was last kept.
struct Kept {
    checkpoint: CheckpointTimer,
    snapshot: Instant,
}

impl<'a> Watch<'a> {
    pub fn new(
        reporter: &'a dyn Reporter,
        options: &'a Options,
        (index, of): (u32, u32),
        (checkpoint, snapshot): (PathBuf, PathBuf),
        metadata: &'a Metadata,
        left: Left<'a>,
    ) -> Self {
        let checkpoint_timer = CheckpointTimer::new(options.checkpoint_every, 0);
        let kept = Mutex::new(Kept { checkpoint: checkpoint_timer, snapshot: Instant::now() });
        Watch { reporter, options, index, of, checkpoint, snapshot, metadata, left, kept }
    }

    fn keep_when_due(&self, so_far: &SoFar, kept: &mut Kept) {
        if kept.checkpoint.is_due(so_far.spp())
            && let Err(error) = so_far.checkpoint().write(&self.checkpoint)
        {
            self.warn(&format!("a checkpoint could not be written: {error}"));
        }
    }

    fn show_when_asked(&self, so_far: &SoFar, kept: &mut Kept) {
        let is_due = self.options.snapshot_every.is_some_and(|every| kept.snapshot.elapsed() >= every);
        let is_asked = self.reporter.snapshot_asked() || is_due;
        let is_watched = self.reporter.wants_picture();
        if !is_asked && !is_watched {
            return;
        }
        let frame = so_far.frame();
        if is_watched {
            self.reporter.picture(Picture::SoFar, &frame);
        }
        if is_asked {
            kept.snapshot = Instant::now();
            self.reporter.picture(Picture::Snapshot, &frame);
            let folder = self.snapshot.parent().unwrap_or(Path::new("."));
            let made = std::fs::create_dir_all(folder).map_err(|error| error.to_string());
            let written =
                || frame.write_exr(&self.snapshot, self.metadata).map_err(|error| error.to_string());
            match made.and_then(|()| written()) {
                Ok(()) => self.reporter.event(&Event::Snapshot { file: &self.snapshot, spp: so_far.spp() }),
                Err(error) => self.warn(&format!("a snapshot could not be written: {error}")),
            }
        }
    }

    fn warn(&self, words: &str) {
        self.reporter.event(&Event::Warning(words));
    }

    fn is_late(&self) -> bool {
        self.options.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }
}

impl Progress for Watch<'_> {
    fn advance(&self, done: u64, total: u64) {
        let share = done as f64 / total.max(1) as f64;
        self.reporter.advance((f64::from(self.index) + share) / f64::from(self.of));
    }

    fn cancelled(&self) -> bool {
        self.reporter.cancelled() || self.is_late()
    }

    fn pass_done(&self, so_far: &SoFar<'_>) -> Next {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        self.keep_when_due(so_far, &mut kept);
        self.show_when_asked(so_far, &mut kept);
        let whole = so_far.seconds() * f64::from(so_far.spp_asked()) / f64::from(so_far.spp().max(1));
        let Left { estimate, variant, frames } = &self.left;
        let rest = estimate.left_while(*variant, whole, frames.iter().copied());
        self.reporter.event(&Event::Left((rest - so_far.seconds()).max(0.0)));
        if self.cancelled() { Next::Stop } else { Next::GoOn }
    }
}
