//! A groom at one frame, and how it moves while the shutter is open.

use std::path::Path;

use anyhow::{Result, bail};
use glam::Vec3;
use groom::{Domain, Groom, Values, names};
use groom_formats::{Format, Loaded, MovingGroom, ReadOptions};
use hair_render::{Blur, Motion, Movement, Shutter};

use crate::motion_args::MotionArgs;

/// Frames a second where nobody says.
const USUAL_RATE: f64 = 24.0;

/// A groom as it was read.
pub struct Read {
    pub loaded: Loaded,
    /// Of a format that holds motion.
    motion: Option<MovingGroom>,
    /// The frame that is shown; none of a still groom when nobody named one.
    pub frame: Option<f64>,
    /// What it can be blurred by.
    has: Has,
}

/// What moves, as a file tells it at one frame.
#[derive(Default)]
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

/// Reads the groom at the frame that the arguments name.
pub fn read(path: &Path, options: ReadOptions, args: &MotionArgs) -> Result<Read> {
    if let Some(frame) = args.frame.filter(|frame| !frame.is_finite()) {
        bail!("--frame is {frame}, expected a finite number");
    }
    let options = ReadOptions { time: args.frame, keep_origin: true, ..options };
    if !holds_motion(path) {
        let loaded = groom_formats::read(path, &options)?;
        let has = Has { velocities: velocities(&loaded.groom), ..Has::default() };
        return Ok(Read { loaded, motion: None, frame: args.frame, has });
    }
    let motion = groom_formats::read_moving(path, &options)?;
    let loaded = motion.still().clone();
    let frame = args.frame.or_else(|| loaded.times.first().copied());
    let mut has =
        Has { times: loaded.times.len(), velocities: velocities(&loaded.groom), accelerations: None };
    if let Some(frame) = frame.filter(|_| has.times > 0) {
        let at = motion.at(frame)?;
        has.velocities = at.velocities.or(has.velocities);
        has.accelerations = at.accelerations;
        // Out there the strands stand, as their positions do.
        if outside(path, frame, ends(&loaded)).is_some() {
            has.stand();
        }
    }
    Ok(Read { loaded, motion: Some(motion), frame, has })
}

impl Read {
    fn movement(&self) -> Movement<'_> {
        Movement {
            positions: self.loaded.groom.positions(),
            velocities: self.has.velocities.as_deref(),
            accelerations: self.has.accelerations.as_deref(),
            other_times: self.has.times > 1,
        }
    }

    fn blur(&self, args: &MotionArgs) -> Blur {
        args.blur.map_or_else(|| self.movement().best(), Blur::from)
    }

    /// At how many times through the shutter things are looked at: the groom and what stands beside it alike, or
    /// they would come apart between them.
    pub fn keys(&self, args: &MotionArgs) -> usize {
        args.motion_samples.map_or(self.blur(args).usual_keys(), usize::from)
    }

    /// How the strands move while the shutter is open.
    pub fn motion(&self, path: &Path, args: &MotionArgs, shutter: &Shutter, rate: f64) -> Result<Motion> {
        let (movement, blur) = (self.movement(), self.blur(args));
        if !movement.allows(blur) {
            return self.refuse(path, blur);
        }
        let at = |time: f64| match &self.motion {
            Some(motion) => Ok(motion.at(time)?.positions),
            None => bail!("{}: nothing in it moves", path.display()),
        };
        // The frames of a file are at its own rate, whatever the picture's: so are its velocities.
        let rate = self.frame_rate().filter(|_| self.has.times > 1).unwrap_or(rate);
        movement.motion(blur, shutter, (self.frame.unwrap_or(0.0), rate), self.keys(args), at)
    }

    /// What there is to say where the picture is of a frame that the groom does not have.
    pub fn outside(&self, path: &Path) -> Option<String> {
        outside(path, self.frame?, ends(&self.loaded))
    }

    /// Frames a second, as the groom says.
    pub fn frame_rate(&self) -> Option<f64> {
        self.loaded.frame_rate
    }

    fn refuse(&self, path: &Path, blur: Blur) -> Result<Motion> {
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
        bail!("--blur {asked}: {} has no {missing}; expected {expected}", path.display())
    }
}

/// First and last of several frames; without end where there are not several.
fn ends(loaded: &Loaded) -> (f64, f64) {
    match loaded.times.as_slice() {
        [first, .., last] => (*first, *last),
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// What there is to say of a frame before the first or after the last that a file has.
pub fn outside(path: &Path, frame: f64, (first, last): (f64, f64)) -> Option<String> {
    /// Frames that rounding of seconds may be off.
    const NEAR: f64 = 1e-3;
    let beyond = frame < first - NEAR || frame > last + NEAR;
    let name = path.display();
    beyond.then(|| format!("{name}: frame {frame} is outside {first} to {last}; it stands as at the nearest"))
}

/// The rate that holds for the picture.
pub fn rate(args: &MotionArgs, groom: &Read, meshes: Option<f64>) -> f64 {
    args.fps.or(groom.frame_rate()).or(meshes).unwrap_or(USUAL_RATE)
}

fn holds_motion(path: &Path) -> bool {
    matches!(Format::from_path(path), Some(Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic))
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
