//! Who watches over a render: tells how far it is, keeps it, shows it, and stops it.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use command_line::Meter;
use frame_view::Show;
use hair_render::{CheckpointTimer, Frame, Metadata, Next, Progress, SoFar};

use crate::farm_args::FarmArgs;
use crate::keeping;
use crate::picture::say;

/// The eyes on one render.
pub struct Watch<'a> {
    args: &'a FarmArgs,
    output: &'a Path,
    metadata: Metadata,
    meter: &'a Meter,
    /// When the time is up.
    end: Option<Instant>,
    last: Mutex<Last>,
}

/// When things were done last, and who sees them.
struct Last {
    checkpoint: CheckpointTimer,
    shown: Instant,
    /// A snapshot that was written.
    snapshot: Option<PathBuf>,
    show: Show,
}

impl<'a> Watch<'a> {
    /// Over the render of `output`, which goes on at `spp` samples a pixel; the program began at `start`.
    pub fn new(
        args: &'a FarmArgs,
        output: &'a Path,
        metadata: Metadata,
        meter: &'a Meter,
        show: Show,
        (start, spp): (Instant, u32),
    ) -> Self {
        let now = Instant::now();
        let checkpoint = CheckpointTimer::new(args.checkpoint_every, spp);
        let last = Last { checkpoint, shown: now, snapshot: None, show };
        let end = args.time_limit.and_then(|limit| start.checked_add(limit));
        Watch { args, output, metadata, meter, end, last: Mutex::new(last) }
    }

    /// Removes the snapshot and shows the picture, once that is there.
    pub fn done(&self, frame: &Frame) {
        let Ok(mut last) = self.last.lock() else { return };
        if let Some(path) = &last.snapshot {
            // What is gone already is as good as removed.
            let _ = std::fs::remove_file(path);
        }
        last.show.send(frame);
        last.show.draw(frame);
    }

    fn keep_if_due(&self, last: &mut Last, so_far: &SoFar<'_>) {
        if last.checkpoint.is_due(so_far.spp()) {
            keeping::keep(so_far.checkpoint(), self.output);
        }
    }

    fn show_if_due(&self, last: &mut Last, so_far: &SoFar<'_>) {
        let waited = |time: Duration| last.shown.elapsed() >= time;
        // Asked first: a request is taken once.
        if command_line::snapshot_asked() || self.args.snapshot.is_some_and(waited) {
            let path = keeping::snapshot_of(self.output);
            let frame = so_far.frame();
            last.show.draw(&frame);
            match frame.write_exr(&path, &self.metadata) {
                Ok(()) => self.meter.say(&format!("{}: {} samples a pixel", path.display(), so_far.spp())),
                Err(fault) => say(&format!("warning: {fault}")),
            }
            last.snapshot = Some(path);
            last.shown = Instant::now();
        }
        if last.show.is_due() {
            last.show.send(&so_far.frame());
        }
    }
}

impl Progress for Watch<'_> {
    fn advance(&self, done: u64, total: u64) {
        self.meter.advance(done as f64 / total.max(1) as f64);
    }

    fn cancelled(&self) -> bool {
        command_line::interrupted() || self.end.is_some_and(|end| Instant::now() >= end)
    }

    fn pass_done(&self, so_far: &SoFar<'_>) -> Next {
        let Ok(mut last) = self.last.lock() else { return Next::GoOn };
        self.keep_if_due(&mut last, so_far);
        self.show_if_due(&mut last, so_far);
        Next::GoOn
    }
}
