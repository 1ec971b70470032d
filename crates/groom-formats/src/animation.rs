//! Grooms that move: the same strands at several times.

use std::io::BufWriter;
use std::path::Path;

use glam::{DVec3, Vec3};
use groom::Groom;

use crate::read::endings;
use crate::{Format, FormatError, Output, Warning, WriteOptions, check, frame_check};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 20;

/// Where the points of a groom are at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// The time, in frames (a USD time code); need not be whole.
    pub time: f64,
    /// One position a point of the groom, in its units and order.
    pub positions: Vec<Vec3>,
    /// One velocity a point, in units per second; all frames have them or none.
    pub velocities: Option<Vec<Vec3>>,
    /// One acceleration a point, in units per second squared; all frames have them or none, and they come with
    /// velocities.
    pub accelerations: Option<Vec<Vec3>>,
}

/// What is said of a motion as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionOptions {
    /// Frames in a second; over 0.
    pub frame_rate: f64,
    /// Where the positions of all frames are measured from, in the groom's units. A character far away keeps the
    /// shape of its strands: formats write the place as a transform in 64 bits and the positions as they are.
    pub origin: DVec3,
}

impl MotionOptions {
    /// Positions as they are, at so many frames a second.
    #[must_use]
    pub fn at_rate(frame_rate: f64) -> Self {
        MotionOptions { frame_rate, origin: DVec3::ZERO }
    }
}

/// Writes a groom that moves to `path`: everything but the positions is `groom`'s, `frames` come in the order
/// of their times. One frame is in memory at a time.
///
/// `.usda`, `.usdc`, `.usdz` and `.abc` hold positions a frame; `.glb` and `.gltf` hold them as morph targets, for a
/// few dozen frames ([`Warning::ManyMorphTargets`]) of lines: 12 bytes a point and frame, no velocities, times from 0 on.
/// [`write_rigged`](crate::write_rigged) is smaller where joints move the strands.
///
/// # Errors
/// [`FormatError`], an error that `frames` brings included; the old file at `path`, if any, is then untouched.
#[allow(unused_variables, unused_mut, unreachable_code)] // with features off
pub fn write_animation(
    groom: &Groom,
    frames: &mut dyn Iterator<Item = Result<Frame, FormatError>>,
    motion: &MotionOptions,
    path: &Path,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let name = path.display().to_string();
    let format = Format::from_path(path).filter(|&format| holds_motion(format) && format.can_write());
    let format = format
        .ok_or_else(|| FormatError::UnknownFormat { file: name.clone(), expected: endings(holds_motion) })?;
    check::values(groom, &name)?;
    frame_check::options(motion, &name)?;
    let motion = Motion { groom, frames, options: motion };
    #[cfg(feature = "gltf")]
    if matches!(format, Format::Gltf | Format::Glb) {
        return crate::gltf::write_animation(motion, format, path, &name, options);
    }
    let mut stream = BufWriter::with_capacity(BUFFER, Output::create(path)?);
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
    pub(crate) options: &'a MotionOptions,
}

fn holds_motion(format: Format) -> bool {
    let usd = matches!(format, Format::Usda | Format::Usdc | Format::Usdz);
    usd || matches!(format, Format::Alembic | Format::Gltf | Format::Glb)
}
