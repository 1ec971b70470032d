//! What a run tells: words and a bar for people, lines for farms.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use command_line::{Meter, ProgressStyle};
use turntable::{Event, Reporter};

/// Passes on what a run tells.
pub struct Teller {
    pub meter: Meter,
    /// Warnings are told once, however many frames and variants they hold for.
    warned: Mutex<BTreeSet<String>>,
}

impl Teller {
    pub fn new(style: ProgressStyle, label: &str) -> Teller {
        Teller { meter: Meter::new(style, label), warned: Mutex::new(BTreeSet::new()) }
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
}
