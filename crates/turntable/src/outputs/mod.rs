//! What is made of finished frames: previews, the contact sheet, films, the page.

mod facts;
mod look;
mod page;
mod parameters;
mod preview;
mod sheet;
mod video;

use std::path::{Path, PathBuf};

pub(crate) use sheet::layout as sheet_layout;

use crate::digest::Digest;
use crate::expand::Variant;
use crate::{Reporter, Step, StepKind, TurntableError};

/// What outputs are wanted of.
pub(crate) struct Asked<'a> {
    /// The folder that paths in the pipeline count from.
    pub base: &'a Path,
    pub variants: &'a [Variant],
    /// The frames of all variants, in order.
    pub frames: &'a [Step],
}

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

/// Everything that is wanted of frames.
pub(crate) fn wanted(asked: &Asked) -> Result<Vec<Wanted>, TurntableError> {
    let mut wanted = preview::wanted(asked)?;
    wanted.extend(sheet::wanted(asked)?);
    wanted.extend(video::wanted(asked)?);
    wanted.extend(page::wanted(asked)?);
    Ok(wanted)
}

/// Frames that are there, and where to put what is made of them.
pub(crate) struct Finished<'a> {
    /// What the pipeline is called.
    pub name: &'a str,
    /// The folder that paths in the pipeline count from.
    pub base: &'a Path,
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
        StepKind::Video { index } => video::make(step, index, finished),
        StepKind::Page => page::make(step, finished),
        StepKind::Convert | StepKind::Frame { .. } => Ok(false),
    }
}
