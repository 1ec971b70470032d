//! Curves that move, frame by frame.

use glam::Vec3;

use super::curves::Curves;
use super::stage::Stage;
use super::{attribute, load, open};
use crate::polylines::Polylines;
use crate::room::Room;
use crate::{Format, FormatError, Frame, Loaded, ReadOptions};

/// The groom at its first time, and its frames.
pub(crate) fn read(
    bytes: Vec<u8>,
    format: Format,
    name: &str,
    options: &ReadOptions,
) -> Result<(Loaded, Frames), FormatError> {
    let stage = open(bytes, format, name, options)?;
    let first = stage.times.first().copied();
    let (loaded, cuts) = load(&stage, options.time.or(first), options)?;
    let Stage { layer, context, curves, times, composed } = stage;
    let file = name.to_owned();
    let parts =
        Parts { layer, curves, times, composed, format: context.format, curve_error: context.curve_error };
    Ok((loaded, Frames { file, stage: Some(parts), cuts, next: 0 }))
}

/// A stage without the name of its file.
struct Parts {
    layer: usd_layer::Layer<Vec<u8>>,
    curves: Vec<super::stage::Place>,
    times: Vec<f64>,
    composed: usize,
    format: Format,
    curve_error: Option<f32>,
}

/// The frames, one in memory at a time.
pub(crate) struct Frames {
    file: String,
    stage: Option<Parts>,
    cuts: Vec<Polylines>,
    next: usize,
}

impl Iterator for Frames {
    type Item = Result<Frame, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        let parts = self.stage.take()?;
        let time = *parts.times.get(self.next)?;
        self.next += 1;
        let Parts { layer, curves, times, composed, format, curve_error } = parts;
        let room = Room::of(layer.bytes().len());
        let context = super::Context { file: &self.file, format, curve_error, room };
        let stage = Stage { layer, context, curves, times, composed };
        let frame = frame(&stage, time, &self.cuts);
        let Stage { layer, curves, times, composed, .. } = stage;
        // After an error there is no other frame.
        self.stage = frame.is_ok().then_some(Parts { layer, curves, times, composed, format, curve_error });
        Some(frame)
    }
}

fn frame(stage: &Stage<'_, Vec<u8>>, time: f64, cuts: &[Polylines]) -> Result<Frame, FormatError> {
    let mut frame = Frame { time, ..Frame::default() };
    let mut velocities: Option<Vec<Vec3>> = None;
    let mut all = true;
    for (place, cut) in stage.curves.iter().zip(cuts) {
        let (curves, points) = Curves::read(stage, place, Some(time), Some(cut))?;
        match attribute::velocities(&curves)? {
            Some(more) => velocities.get_or_insert_default().extend(more),
            None => all = false,
        }
        if frame.positions.is_empty() { frame.positions = points } else { frame.positions.extend(points) }
    }
    frame.velocities = velocities.filter(|_| all);
    Ok(frame)
}
