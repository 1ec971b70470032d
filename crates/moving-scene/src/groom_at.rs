//! A groom of a file at one frame, and how it moves while the shutter is open.

use std::path::{Path, PathBuf};

use glam::Vec3;
use groom::{Domain, Groom, Values, names};
use groom_formats::{Format, Loaded, MovingGroom, ReadOptions};
use hair_render::{Blur, Motion, Movement};

use crate::{Exposure, MovingSceneError, outside};

/// A groom as it was read.
#[derive(Debug)]
pub struct GroomAt {
    /// The strands at the frame, relative to [`Loaded::origin`].
    pub loaded: Loaded,
    path: PathBuf,
    /// Of a format that holds motion.
    motion: Option<MovingGroom>,
    frame: Option<f64>,
    /// What it can be blurred by.
    has: Has,
}

/// What moves, as a file tells it at one frame.
#[derive(Debug, Default)]
struct Has {
    times: usize,
    velocities: Option<Vec<Vec3>>,
    accelerations: Option<Vec<Vec3>>,
}

impl Has {
    fn stand(&mut self) {
        let speeds = self.velocities.iter_mut().chain(&mut self.accelerations);
        speeds.flatten().for_each(|speed| *speed = Vec3::ZERO);
    }
}

impl GroomAt {
    /// Reads the groom at `frame`; at its first where none is named.
    ///
    /// # Errors
    /// [`MovingSceneError::Frame`], and [`MovingSceneError::Format`] for what the file is to blame for.
    pub fn read(path: &Path, options: &ReadOptions, frame: Option<f64>) -> Result<Self, MovingSceneError> {
        if let Some(frame) = frame.filter(|frame| !frame.is_finite()) {
            return Err(MovingSceneError::Frame(frame));
        }
        let options = ReadOptions { time: frame, keep_origin: true, ..options.clone() };
        let path = path.to_owned();
        if !GroomAt::may_move(&path) {
            let loaded = groom_formats::read(&path, &options)?;
            let has = Has { velocities: velocities(&loaded.groom), ..Has::default() };
            return Ok(GroomAt { loaded, path, motion: None, frame, has });
        }
        let motion = groom_formats::read_moving(&path, &options)?;
        let loaded = motion.still().clone();
        let frame = frame.or_else(|| loaded.times.first().copied());
        let times = loaded.times.len();
        let mut has = Has { times, velocities: velocities(&loaded.groom), accelerations: None };
        if let Some(frame) = frame.filter(|_| has.times > 0) {
            let at = motion.at(frame)?;
            has.velocities = at.velocities.or(has.velocities);
            has.accelerations = at.accelerations;
            // Out there the strands stand, as their positions do.
            if outside(&path, frame, ends(&loaded)).is_some() {
                has.stand();
            }
        }
        Ok(GroomAt { loaded, path, motion: Some(motion), frame, has })
    }

    /// Whether a file with this ending can hold motion.
    #[must_use]
    pub fn may_move(path: &Path) -> bool {
        matches!(Format::from_path(path), Some(Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic))
    }

    /// The frame that is shown; none of a still groom when nobody named one.
    #[must_use]
    pub fn frame(&self) -> Option<f64> {
        self.frame
    }

    /// Frames a second, as the groom says.
    #[must_use]
    pub fn frame_rate(&self) -> Option<f64> {
        self.loaded.frame_rate
    }

    /// What the strands are blurred by.
    #[must_use]
    pub fn blur(&self, exposure: &Exposure) -> Blur {
        exposure.blur.unwrap_or_else(|| self.movement().best())
    }

    /// At how many times through the shutter things are looked at: the groom and what stands beside it alike, or
    /// they would come apart between them.
    #[must_use]
    pub fn keys(&self, exposure: &Exposure) -> usize {
        exposure.keys(self.blur(exposure))
    }

    /// The points at another frame, as those of [`GroomAt::loaded`]; the same where the file has one frame.
    ///
    /// # Errors
    /// [`MovingSceneError::Format`] for what the file is to blame for.
    pub fn positions_at(&self, frame: f64) -> Result<Vec<Vec3>, MovingSceneError> {
        match self.motion.as_ref().filter(|_| self.has.times > 1) {
            Some(motion) => Ok(motion.at(frame)?.positions),
            None => Ok(self.loaded.groom.positions().to_vec()),
        }
    }

    /// How the strands move while the shutter is open, at `rate` frames a second where the file knows no better.
    ///
    /// # Errors
    /// [`MovingSceneError::NoMotion`] for a file without what is asked for; those of the file and of [`Motion::keys`].
    pub fn motion(&self, exposure: &Exposure, rate: f64) -> Result<Motion, MovingSceneError> {
        let (movement, blur) = (self.movement(), self.blur(exposure));
        if !movement.allows(blur) {
            return Err(self.refusal(blur));
        }
        let at = |time: f64| match &self.motion {
            Some(motion) => Ok(motion.at(time)?.positions),
            None => Err(self.refusal(Blur::Positions)),
        };
        // The frames of a file are at its own rate, whatever the picture's: so are its velocities.
        let rate = self.frame_rate().filter(|_| self.has.times > 1).unwrap_or(rate);
        movement.motion(blur, &exposure.shutter, (self.frame.unwrap_or(0.0), rate), self.keys(exposure), at)
    }

    /// What there is to say where the picture is of a frame that the groom does not have.
    #[must_use]
    pub fn outside(&self) -> Option<String> {
        outside(&self.path, self.frame?, ends(&self.loaded))
    }

    fn movement(&self) -> Movement<'_> {
        Movement {
            positions: self.loaded.groom.positions(),
            velocities: self.has.velocities.as_deref(),
            accelerations: self.has.accelerations.as_deref(),
            other_times: self.has.times > 1,
        }
    }

    fn refusal(&self, blur: Blur) -> MovingSceneError {
        let (asked, missing) = match blur {
            Blur::Off => ("off", "motion"),
            Blur::Positions => ("positions", "positions at different times"),
            Blur::Velocities => ("velocities", "velocities"),
            Blur::Accelerations => ("accelerations", "velocities and accelerations"),
        };
        let expected = match self.movement().best() {
            Blur::Off => "off: nothing in it moves (.usda, .usdc, .usdz and .abc hold motion)",
            Blur::Positions => "positions",
            Blur::Velocities if self.has.times > 1 => "velocities or positions",
            Blur::Velocities => "velocities",
            Blur::Accelerations => "accelerations, velocities or positions",
        };
        MovingSceneError::NoMotion { path: self.path.clone(), asked, missing, expected }
    }
}

/// First and last of several frames; without end where there are not several.
fn ends(loaded: &Loaded) -> (f64, f64) {
    match loaded.times.as_slice() {
        [first, .., last] => (*first, *last),
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// The velocities of a groom whose format has a place for them, one a point.
fn velocities(groom: &Groom) -> Option<Vec<Vec3>> {
    let attribute = groom.attribute(names::VELOCITY)?;
    let Values::Vec3(values) = &attribute.values else { return None };
    match attribute.domain {
        Domain::Vertex => Some(values.clone()),
        Domain::Groom => Some(vec![*values.first()?; groom.point_count()]),
        Domain::Strand => {
            let each = |strand: usize| std::iter::repeat_n(values[strand], groom.strand_range(strand).len());
            Some((0..groom.strand_count()).flat_map(each).collect())
        }
    }
}
