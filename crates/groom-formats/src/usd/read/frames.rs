//! Curves that move, at any time.

use glam::Vec3;

use super::curves::Curves;
use super::stage::Stage;
use super::{attribute, load, open};
use crate::frames::AtTime;
use crate::polylines::Polylines;
use crate::{Format, FormatError, Frame, Loaded, ReadOptions};

/// The groom at its first time, and its motion.
pub(crate) fn read(
    bytes: Vec<u8>,
    format: Format,
    name: &str,
    options: &ReadOptions,
) -> Result<(Loaded, Motion), FormatError> {
    let stage = open(bytes, format, name, options)?;
    let (loaded, cuts) = load(&stage, stage.start(options.time), options)?;
    Ok((loaded, Motion { stage, cuts }))
}

/// A stage, and how its curves were cut.
pub(crate) struct Motion {
    stage: Stage<Vec<u8>>,
    cuts: Vec<Polylines>,
}

impl AtTime for Motion {
    fn at(&self, time: f64) -> Result<Frame, FormatError> {
        let stage = &self.stage;
        // Every frame may take as much as the first.
        stage.context.room.refill();
        let mut frame = Frame { time, ..Frame::default() };
        let mut rates = [const { Rate { values: None, all: true } }; 2];
        for (place, cut) in stage.curves.iter().zip(&self.cuts) {
            let (curves, points) = Curves::read(stage, place, Some(time), Some(cut))?;
            for (rate, name) in rates.iter_mut().zip(["velocities", "accelerations"]) {
                rate.add(attribute::rate(&curves, name)?);
            }
            if frame.positions.is_empty() {
                frame.positions = points;
            } else {
                frame.positions.extend(points);
            }
        }
        [frame.velocities, frame.accelerations] = rates.map(|rate| rate.values.filter(|_| rate.all));
        Ok(frame)
    }
}

/// Velocities or accelerations of all prims, if all have them.
struct Rate {
    values: Option<Vec<Vec3>>,
    all: bool,
}

impl Rate {
    fn add(&mut self, more: Option<Vec<Vec3>>) {
        match (more, &mut self.values) {
            (Some(more), Some(values)) => values.extend(more),
            (Some(more), none) => *none = Some(more),
            (None, _) => self.all = false,
        }
    }
}
