//! What happened while strands were carried.

use std::cell::RefCell;

use groom_binding::CarryReport;
use serde_json::{Value, json};

/// What happened in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FrameEvents {
    pub(crate) frame: f64,
    /// Points that were pushed out of the mesh.
    pub(crate) pushed: usize,
    /// Points that are inside the mesh all the same, where points are pushed out of it.
    pub(crate) inside: usize,
    /// Strands that jumped, and have no velocity.
    pub(crate) teleported: usize,
    /// Strands on triangles that collapsed or turned over, which kept the turn of an earlier pose.
    pub(crate) held: usize,
    /// How much farther or nearer than at rest a root was from its place, at most.
    pub(crate) root_error: Option<f64>,
}

impl FrameEvents {
    pub(crate) fn json(&self) -> Value {
        json!({
            "frame": self.frame,
            "pushed": self.pushed,
            "inside": self.inside,
            "teleported": self.teleported,
            "held": self.held,
            "root_error": self.root_error,
        })
    }
}

/// The frames so far. A few numbers a frame; not the points.
#[derive(Debug, Default)]
pub(crate) struct Events {
    frames: RefCell<Vec<FrameEvents>>,
}

impl Events {
    /// Adds what happened at one time of a frame; samples of one shutter count together.
    pub(crate) fn add(&self, frame: f64, report: &CarryReport, root_error: Option<f64>) {
        let mut frames = self.frames.borrow_mut();
        if frames.last().is_none_or(|last| last.frame != frame) {
            frames.push(FrameEvents { frame, ..FrameEvents::default() });
        }
        if let Some(last) = frames.last_mut() {
            last.pushed = last.pushed.max(report.pushed);
            last.inside = last.inside.max(report.inside);
            last.teleported = last.teleported.max(report.teleported);
            last.held = last.held.max(report.held);
            last.root_error = root_error.into_iter().chain(last.root_error).reduce(f64::max);
        }
    }

    pub(crate) fn into_frames(self) -> Vec<FrameEvents> {
        self.frames.into_inner()
    }
}

/// All frames in one line.
pub(crate) fn total(frames: &[FrameEvents]) -> FrameEvents {
    let errors = frames.iter().filter_map(|frame| frame.root_error);
    FrameEvents {
        frame: frames.len() as f64,
        pushed: frames.iter().map(|frame| frame.pushed).sum(),
        inside: frames.iter().map(|frame| frame.inside).max().unwrap_or(0),
        teleported: frames.iter().map(|frame| frame.teleported).sum(),
        held: frames.iter().map(|frame| frame.held).max().unwrap_or(0),
        root_error: errors.reduce(f64::max),
    }
}
