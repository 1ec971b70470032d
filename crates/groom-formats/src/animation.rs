//! Grooms that move: the same strands at several times.

use std::io::BufWriter;
use std::path::Path;

use glam::Vec3;
use groom::Groom;

use crate::read::endings;
use crate::{Format, FormatError, Output, Warning, WriteOptions, check};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 20;

/// Where the points of a groom are at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// The time, in frames (a USD time code).
    pub time: f64,
    /// One position a point of the groom, in its units and order.
    pub positions: Vec<Vec3>,
    /// One velocity a point, in units per second; all frames have them or none.
    pub velocities: Option<Vec<Vec3>>,
}

/// Writes a groom that moves to `path`: everything but the positions is `groom`'s, `frames` come in the order
/// of their times, and `frame_rate` of them make a second. One frame is in memory at a time.
///
/// `.usda`, `.usdc`, `.usdz` and `.abc` can hold motion.
///
/// # Errors
/// [`FormatError`], an error that `frames` brings included; the old file at `path`, if any, is then untouched.
#[allow(unused_variables, unused_mut, unreachable_code)] // with features off
pub fn write_animation(
    groom: &Groom,
    frames: &mut dyn Iterator<Item = Result<Frame, FormatError>>,
    frame_rate: f64,
    path: &Path,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let name = path.display().to_string();
    let format = Format::from_path(path).filter(|&format| holds_motion(format) && format.can_write());
    let format = format
        .ok_or_else(|| FormatError::UnknownFormat { file: name.clone(), expected: endings(holds_motion) })?;
    check::values(groom, &name)?;
    let mut stream = BufWriter::with_capacity(BUFFER, Output::create(path)?);
    let motion = Motion { groom, frames, frame_rate };
    let warnings = match format {
        #[cfg(feature = "alembic")]
        Format::Alembic => crate::alembic::write_animation(motion, &mut stream, &name, options)?,
        #[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
        _ => crate::usd::write::write_animation(motion, format, &mut stream, &name, options)?,
        #[cfg(not(any(feature = "usda", feature = "usdc", feature = "usdz")))]
        _ => return Err(FormatError::UnknownFormat { file: name, expected: endings(holds_motion) }),
    };
    stream.into_inner().map_err(|e| FormatError::io(&name, e.into_error()))?.commit()?;
    Ok(warnings)
}

/// What a writer of motion is given.
pub(crate) struct Motion<'a> {
    pub(crate) groom: &'a Groom,
    pub(crate) frames: &'a mut dyn Iterator<Item = Result<Frame, FormatError>>,
    pub(crate) frame_rate: f64,
}

fn holds_motion(format: Format) -> bool {
    matches!(format, Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic)
}
