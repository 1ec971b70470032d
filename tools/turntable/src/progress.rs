//! What a run tells: words and a bar for people, lines for farms.

use std::collections::BTreeSet;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use command_line::Meter;
use frame_view::Show;
use hair_render::Frame;
use turntable::{Event, Picture, Reporter};

use crate::args::Tell;

/// Passes on what a run tells.
pub struct Teller {
    pub meter: Meter,
    /// Warnings are told once, however many frames and variants they hold for.
    warned: Mutex<BTreeSet<String>>,
    show: Mutex<Show>,
}

impl Teller {
    pub fn new(tell: &Tell, label: &str) -> Teller {
        Teller {
            meter: Meter::new(tell.progress, label),
            warned: Mutex::new(BTreeSet::new()),
            show: Mutex::new(Show::new(tell.display_server.as_deref(), label, tell.preview, 0.0)),
        }
    }

    fn show(&self) -> MutexGuard<'_, Show> {
        self.show.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// `smooth/sky 0001`, or `0001` where there is only one variant.
fn name(variant: &str, number: u32) -> String {
    let gap = if variant.is_empty() { "" } else { " " };
    format!("{variant}{gap}{number:04}")
}

impl Reporter for Teller {
    fn event(&self, event: &Event) {
        match event {
            Event::Stage(words) => self.meter.status(words),
            Event::Warning(words) => {
                let mut warned = self.warned.lock().unwrap_or_else(PoisonError::into_inner);
                if warned.insert((*words).to_owned()) {
                    self.meter.say(&format!("warning: {words}"));
                }
            }
            Event::FrameBegins { variant, number, index, of } => {
                self.meter.status(&format!("frame {} ({}/{of})", name(variant, *number), index + 1));
            }
            Event::FrameDone { variant, number, seconds, relative_error, .. } => {
                let error = relative_error.map_or_else(
                    || "relative error unknown below 2 samples a pixel".to_owned(),
                    |error| format!("relative error {:.1} %", 100.0 * error),
                );
                self.meter.say(&format!("frame {}: {error}, {seconds:.1} s", name(variant, *number)));
            }
            Event::Resumed { spp, of } => {
                self.meter.say(&format!("goes on from {spp} of {of} samples a pixel"));
            }
            Event::Snapshot { file, spp } => {
                self.meter.say(&format!("{}: {spp} samples a pixel so far", file.display()));
            }
            Event::Failed(failure) => self.meter.say(&format!("error: {failure}; going on with the rest")),
            Event::FoundDone(output) => self.meter.say(&format!("{}: made by another run", output.display())),
            Event::Left(seconds) => {
                self.meter.left(Duration::try_from_secs_f64(*seconds).unwrap_or(Duration::MAX));
            }
            _ => {}
        }
    }

    fn advance(&self, share: f64) {
        self.meter.advance(share);
    }

    fn cancelled(&self) -> bool {
        command_line::interrupted()
    }

    fn snapshot_asked(&self) -> bool {
        command_line::snapshot_asked()
    }

    fn wants_picture(&self) -> bool {
        self.show().is_due()
    }

    fn picture(&self, stage: Picture, frame: &Frame) {
        let mut show = self.show();
        if stage != Picture::Snapshot {
            show.send(frame);
        }
        if stage != Picture::SoFar {
            show.draw(frame);
        }
    }
}
