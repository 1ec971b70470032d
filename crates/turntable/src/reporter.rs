//! How a run talks to whoever waits for it.

use std::path::Path;

use crate::Failure;

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
    /// About so many seconds are left, by the frames rendered so far.
    Left(f64),
    /// Something could not be made; the run goes on with the rest.
    Failed(&'a Failure),
    /// A frame that was to be rendered was put in its place by another process.
    FoundDone(&'a Path),
    /// The rendering of a frame begins.
    FrameBegins {
        /// Its variant, by its id; empty where the pipeline has no `matrix`.
        variant: &'a str,
        /// Its number in the turntable, from 1.
        number: u32,
        /// How many this run rendered before.
        index: u32,
        /// How many this run renders.
        of: u32,
    },
    /// A frame that was stopped half way is gone on with.
    Resumed {
        /// Samples a pixel it has.
        spp: u32,
        /// Samples a pixel it is to have.
        of: u32,
    },
    /// The frame being rendered was written down as far as it is.
    Snapshot {
        /// Where to.
        file: &'a Path,
        /// Samples a pixel it has.
        spp: u32,
    },
    /// A frame is on disk.
    FrameDone {
        /// Its variant, by its id.
        variant: &'a str,
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

    /// Whether to stop. What is finished stays, and of the frame being rendered the work so far is kept.
    fn cancelled(&self) -> bool {
        false
    }

    /// Whether somebody asked, since this was last called, for the frame being rendered as far as it is.
    fn snapshot_asked(&self) -> bool {
        false
    }

    /// Whether [`Picture::SoFar`] is waited for; asked after every pass of samples.
    fn wants_picture(&self) -> bool {
        false
    }

    /// The frame being rendered: as far as it is, as it was written to a snapshot, or finished.
    fn picture(&self, stage: Picture, frame: &hair_render::Frame) {
        let _ = (stage, frame);
    }
}

/// What a picture is that a [`Reporter`] is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// A frame as far as it is, because [`Reporter::wants_picture`].
    SoFar,
    /// A snapshot that was asked for.
    Snapshot,
    /// A finished frame.
    Finished,
}

/// Tells nobody and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Reporter for Silent {
    fn event(&self, _event: &Event) {}

    fn advance(&self, _share: f64) {}
}
