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
pub fn read_frames(path: &Path, options: &ReadOptions) -> Result<(Loaded, Frames), FormatError> {
    let MovingGroom { still, motion, .. } = read_moving(path, options)?;
    let mut times = still.times.clone().into_iter();
    let frames = std::iter::from_fn(move || {
        let frame = motion.at(times.next()?);
        if frame.is_err() {
            // After an error there is no other frame.
            times = Vec::new().into_iter();
        }
        Some(frame)
    });
    Ok((still, Box::new(frames)))
}

/// Opens the groom at `path` for its positions at any time. The bytes of the file stay in memory; of its frames,
/// none does.
///
/// # Errors
/// As [`read_frames`].
#[allow(unused_variables)] // with features off
pub fn read_moving(path: &Path, options: &ReadOptions) -> Result<MovingGroom, FormatError> {
    let name = path.display().to_string();
    let unknown = || FormatError::UnknownFormat { file: name.clone(), expected: read::endings(holds_motion) };
    let format = Format::from_path(path).filter(|&format| holds_motion(format)).ok_or_else(unknown)?;
    let bytes = std::fs::read(path).map_err(|error| FormatError::io(&name, error))?;
    let format = format.sniff(&bytes);
    let (still, motion): (Loaded, Box<dyn AtTime + Send>) = match format {
        #[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
        Format::Usda | Format::Usdc | Format::Usdz => {
            let (still, motion) = crate::usd::read::read_moving(bytes, format, &name, options)?;
            (still, Box::new(motion))
        }
        #[cfg(feature = "alembic")]
        Format::Alembic => {
            let (still, motion) = crate::alembic::read_moving(bytes, &name, options)?;
            (still, Box::new(motion))
        }
        _ => return Err(unknown()),
    };
    Ok(MovingGroom { name, still: Loaded { format: Some(format), ..still }, motion })
}

/// A groom in a file, with its positions at any time.
pub struct MovingGroom {
    name: String,
    still: Loaded,
    motion: Box<dyn AtTime + Send>,
}

impl MovingGroom {
    /// The groom as it is at [`ReadOptions::time`], else at the first frame; [`Loaded::times`] are those of its
    /// frames and [`Loaded::frame_rate`] makes seconds of them.
    #[must_use]
    pub fn still(&self) -> &Loaded {
        &self.still
    }

    /// Where the points of the groom are at `time`, in frames: linear between two frames, and so are velocities
    /// and accelerations. Before the first and after the last frame those stay.
    ///
    /// # Errors
    /// [`FormatError`]: `time` is not finite, or the file is broken there, or has other strands there.
    pub fn at(&self, time: f64) -> Result<Frame, FormatError> {
        if !time.is_finite() {
            return Err(FormatError::invalid(&self.name, "time", time.to_string(), "a finite number"));
        }
        self.motion.at(time)
    }
}

impl std::fmt::Debug for MovingGroom {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MovingGroom").field("times", &self.still.times).finish_non_exhaustive()
    }
}

/// What a reader of motion can do.
pub(crate) trait AtTime {
    fn at(&self, time: f64) -> Result<Frame, FormatError>;
}

fn holds_motion(format: Format) -> bool {
    format.can_read() && matches!(format, Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic)
}
