//! What is made of finished frames: previews, the contact sheet, films, the page.

mod preview;
mod sheet;

use std::path::{Path, PathBuf};

pub(crate) use sheet::layout as sheet_layout;

use crate::digest::Digest;
use crate::expand::Variant;
use crate::{Reporter, Step, StepKind, TurntableError};

/// An output that is wanted of frames.
pub(crate) struct Wanted {
    /// The variant it shows; none for what shows several.
    pub variant: Option<usize>,
    pub kind: StepKind,
    /// Its path inside the output folder.
    pub output: PathBuf,
    pub digest: Digest,
    /// The frames it is made of, as places among all frames.
    pub needs: Vec<usize>,
}

/// Everything that is wanted of `frames`, the frames of all variants in order.
pub(crate) fn wanted(variants: &[Variant], frames: &[Step]) -> Vec<Wanted> {
    let mut wanted = preview::wanted(variants, frames);
    wanted.extend(sheet::wanted(variants, frames));
    wanted
}

/// Frames that are there, and where to put what is made of them.
pub(crate) struct Finished<'a> {
    /// The output folder.
    pub output: &'a Path,
    pub variants: &'a [Variant],
    /// The frames of all variants, in order.
    pub frames: &'a [&'a Step],
    pub reporter: &'a dyn Reporter,
}

/// Makes one output and puts it in its place; false when it had to be left out, which was then said.
pub(crate) fn make(step: &Step, finished: &Finished) -> Result<bool, TurntableError> {
    match step.kind {
        StepKind::Preview { .. } => preview::make(step, finished),
        StepKind::Sheet => sheet::make(step, finished),
        // Not wanted yet; see `wanted`.
        _ => Ok(false),
    }
}
