//! Frames as morph targets: the mesh is the first, every other is what its points move by, and weights with keys
//! fade from one to the next. Linear keys make exactly the straight lines between frames.

use std::path::Path;

use glam::Vec3;
use gltf::json::accessor::Type;
use groom::names;

use super::moving::{Morphs, Moving, seconds};
use super::runs::runs;
use super::{Plan, files, skin};
use crate::animation::Motion;
use crate::frame_check::FrameCheck;
use crate::{Format, FormatError, Frame, Warning, WriteOptions};

/// Targets beyond which viewers become slow or refuse, and which are told.
const MANY: usize = 64;
/// Targets beyond which the weights alone, one a target and frame, are megabytes.
const MOST: usize = 1024;

/// Writes a groom that moves.
pub(crate) fn write_animation(
    motion: Motion<'_>,
    format: Format,
    path: &Path,
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    refuse(options, format, file)?;
    let Motion { groom, frames, options: motion } = motion;
    let mut check = FrameCheck::new(groom.point_count(), file);
    let Some(first) = frames.next().transpose()? else {
        return check.finish().map(|()| Vec::new());
    };
    check.take(&first)?;
    let mut base = groom.clone();
    base.positions_mut().copy_from_slice(&first.positions);
    // It would be that of one frame.
    base.remove_attribute(names::VELOCITY);
    let mut plan = Plan::new(&base, format, file, options)?;
    let mut times = vec![first.time];
    let mut targets = Vec::new();
    let mut moves: Vec<[f32; 3]> = Vec::with_capacity(plan.drawable.points);
    for frame in frames {
        let frame = frame?;
        check.take(&frame)?;
        if targets.len() >= MOST {
            let (file, what) = (file.to_owned(), "frames, as morph targets,");
            return Err(FormatError::TooLarge {
                file,
                format,
                what,
                found: MOST as u64 + 2,
                limit: MOST as u64 + 1,
            });
        }
        displacements(&plan, &frame, &mut moves);
        if let Some(point) = moves.iter().position(|by| by.iter().any(|v| !v.is_finite())) {
            let place = format!("position of frame {}", times.len());
            let found = format!("a move out of 32-bit floats at point {point}");
            return Err(FormatError::invalid(file, place, found, "positions nearer to the first frame's"));
        }
        targets.push(plan.tail.spool(&moves).map_err(|e| FormatError::io(file, e))?);
        times.push(frame.time);
    }
    let lost = [("velocity", first.velocities.is_some()), ("acceleration", first.accelerations.is_some())];
    for (name, _) in lost.into_iter().filter(|(_, lost)| *lost) {
        plan.warnings.push(Warning::AttributeLeftOut { format, name: name.to_owned() });
    }
    if targets.len() > MANY {
        let bytes = plan.tail.bytes();
        plan.warnings.push(Warning::ManyMorphTargets { format, targets: targets.len(), bytes });
    }
    let seconds = seconds(&times, motion.frame_rate, file)?;
    let keys = (!targets.is_empty()).then(|| {
        let weights = weights(targets.len());
        (plan.tail.push_times(seconds), plan.tail.push(Type::Scalar, weights))
    });
    let origin = skin::change(groom).transform_point3(motion.origin);
    plan.follow(Moving::Morphs(Morphs { origin, targets, keys }), format, file)?;
    files::write(plan, format, path, file)
}

fn refuse(options: &WriteOptions, format: Format, file: &str) -> Result<(), FormatError> {
    let what = if options.mesh.is_some() {
        "has no frames for tubes and ribbons: write lines, or joints"
    } else if options.quantize.is_some() {
        "has no frames of rounded positions: write them as they are, or joints"
    } else {
        return Ok(());
    };
    Err(FormatError::Unsupported { file: file.to_owned(), format, what })
}

/// What every drawn point moves by since the first frame, y-up and in metres.
fn displacements(plan: &Plan<'_>, frame: &Frame, moves: &mut Vec<[f32; 3]>) {
    moves.clear();
    let space = plan.space;
    for run in runs(plan.drawable) {
        let before = plan.drawable.groom.positions().get(run.vertices.clone()).unwrap_or_default();
        let after = frame.positions.get(run.vertices).unwrap_or_default();
        let by = |(a, b): (&Vec3, &Vec3)| (space.vector(*b) - space.vector(*a)).to_array();
        moves.extend(before.iter().zip(after).map(by));
    }
}

/// One weight a target and frame: at its own frame a target's is 1.
fn weights(targets: usize) -> Vec<f32> {
    let frames = 0..=targets;
    frames.flat_map(|frame| (1..=targets).map(move |target| f32::from(u8::from(target == frame)))).collect()
}
