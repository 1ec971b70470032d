//! Writing the frames.

use std::cell::Cell;
use std::path::Path;

use anyhow::{Context, Result, bail};
use command_line::{Bar, progress_bar};
use glam::DVec3;
use groom::Groom;
use groom_formats::{
    Format, FormatError, Frame, MotionOptions, Warning, WriteOptions, write, write_animation,
};
use whole_file::clear_stale;

use crate::numbered::Numbered;

/// What every frame shares.
pub(crate) struct Strands<'a> {
    pub(crate) groom: &'a Groom,
    /// Where the frames' points are measured from.
    pub(crate) origin: DVec3,
    pub(crate) options: &'a WriteOptions,
}

/// Writes the frames into one file that moves; returns what it could not hold.
pub(crate) fn animated(
    strands: &Strands<'_>,
    frames: impl Iterator<Item = Result<Frame>>,
    count: usize,
    rate: f64,
    output: &Path,
    format: Format,
) -> Result<Vec<Warning>> {
    clear(output, format);
    let bar = progress_bar(count as u64, "frames");
    // An error of ours travels around the writer, which knows only its own.
    let fault = Cell::new(None);
    let written = {
        let mut frames = frames.map(|frame| {
            bar.inc(1);
            frame.map_err(|error| {
                let stopped = std::io::Error::other("a frame could not be carried");
                fault.set(Some(error));
                FormatError::Io { file: output.display().to_string(), source: stopped }
            })
        });
        let motion = MotionOptions { frame_rate: rate, origin: strands.origin };
        write_animation(strands.groom, &mut frames, &motion, output, strands.options)
    };
    bar.finish();
    match (fault.take(), written) {
        (Some(error), _) => Err(error),
        (None, written) => Ok(written?),
    }
}

/// Writes a file a frame; returns what the format could not hold, told once.
pub(crate) fn files(
    strands: &Strands<'_>,
    frames: impl Iterator<Item = Result<Frame>>,
    count: usize,
    output: &Numbered,
    format: Format,
) -> Result<Vec<Warning>> {
    let bar = progress_bar(count as u64, "frames");
    let written = files_with(strands, frames, output, format, &bar);
    bar.finish();
    written
}

fn files_with(
    strands: &Strands<'_>,
    frames: impl Iterator<Item = Result<Frame>>,
    output: &Numbered,
    format: Format,
    bar: &Bar,
) -> Result<Vec<Warning>> {
    let mut groom = strands.groom.clone();
    let mut warnings = None;
    for frame in frames {
        let frame = frame?;
        let path = output.at(frame.time as i64);
        let told = still(strands, &mut groom, frame, &path, format)?;
        // What holds of one frame holds of all but for figures.
        warnings.get_or_insert(told);
        bar.inc(1);
    }
    Ok(warnings.unwrap_or_default())
}

/// Writes the one frame there is.
pub(crate) fn one(
    strands: &Strands<'_>,
    mut frames: impl Iterator<Item = Result<Frame>>,
    output: &Path,
    format: Format,
) -> Result<Vec<Warning>> {
    let Some(frame) = frames.next() else { bail!("no frame was asked for") };
    still(strands, &mut strands.groom.clone(), frame?, output, format)
}

fn still(
    strands: &Strands<'_>,
    groom: &mut Groom,
    frame: Frame,
    output: &Path,
    format: Format,
) -> Result<Vec<Warning>> {
    let origin = strands.origin;
    let place = |p: glam::Vec3| (p.as_dvec3() + origin).as_vec3();
    groom.positions_mut().iter_mut().zip(frame.positions).for_each(|(to, from)| *to = place(from));
    clear(output, format);
    write(groom, output, strands.options).with_context(|| output.display().to_string())
}

/// Clears away what killed runs left beside the output.
fn clear(output: &Path, format: Format) {
    clear_stale(output);
    if !format.streams() {
        clear_stale(output.with_extension("bin"));
    }
}
