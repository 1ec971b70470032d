//! From a path to a groom that moves.

use std::path::Path;

use crate::{Format, FormatError, Frame, Loaded, ReadOptions, read};

/// The frames of a groom, in the order of their times.
pub type Frames = Box<dyn Iterator<Item = Result<Frame, FormatError>>>;

/// Reads the groom at `path` and the frames it moves through: the counterpart of
/// [`write_animation`](crate::write_animation). The groom is as it is at [`ReadOptions::time`], else at the first
/// frame; frames are read when they are asked for, one in memory at a time. A still groom has none.
///
/// All frames have the strands and points of the groom: a frame that has not is an error that names its time.
///
/// # Errors
/// [`FormatError`], which names the file and the place in it; also for formats that hold no motion.
#[allow(unused_variables)] // with features off
pub fn read_frames(path: &Path, options: &ReadOptions) -> Result<(Loaded, Frames), FormatError> {
    let name = path.display().to_string();
    let unknown = || FormatError::UnknownFormat { file: name.clone(), expected: read::endings(holds_motion) };
    let format = Format::from_path(path).filter(|&format| holds_motion(format)).ok_or_else(unknown)?;
    let bytes = std::fs::read(path).map_err(|error| FormatError::io(&name, error))?;
    match format.sniff(&bytes) {
        #[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
        format @ (Format::Usda | Format::Usdc | Format::Usdz) => {
            let (loaded, frames) = crate::usd::read::read_frames(bytes, format, &name, options)?;
            Ok((loaded, Box::new(frames)))
        }
        #[cfg(feature = "alembic")]
        Format::Alembic => {
            let (loaded, frames) = crate::alembic::read_frames(bytes, &name, options)?;
            Ok((loaded, Box::new(frames)))
        }
        _ => Err(unknown()),
    }
}

fn holds_motion(format: Format) -> bool {
    format.can_read() && matches!(format, Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic)
}
