//! How a run talks to whoever waits for it.

use std::path::Path;

/// Something that happened during a run.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Event<'a> {
    /// A longer piece of work begins.
    Stage(&'a str),
    /// Something odd that stops nothing.
    Warning(&'a str),
    /// A file was put in its place, inside the output folder.
    Made(&'a Path),
    /// The rendering of a frame begins.
    FrameBegins {
        /// Its number in the turntable, from 1.
        number: u32,
        /// How many this run rendered before.
        index: u32,
        /// How many this run renders.
        of: u32,
    },
    /// A frame is on disk.
    FrameDone {
        /// Its number in the turntable, from 1.
        number: u32,
        /// How many this run rendered before.
        index: u32,
        /// How many this run renders.
        of: u32,
        /// Seconds it took to render.
        seconds: f64,
        /// Estimated relative error.
        relative_error: Option<f64>,
    },
}

/// Told what happens during a run, and asked whether to stop; from any thread.
pub trait Reporter: Sync {
    /// Something happened.
    fn event(&self, event: &Event);

    /// `share` (0..1) of the rendering is done; may be called out of order.
    fn advance(&self, share: f64);

    /// Whether to stop; nothing half done is then left behind.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Tells nobody and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Reporter for Silent {
    fn event(&self, _event: &Event) {}

    fn advance(&self, _share: f64) {}
}
