//! What joints do, each in its parent's space, as files keep it.

use glam::{DMat4, DQuat, DVec3};
use groom::Groom;

use super::decompose::{Parts, parts};
use super::{Rig, RigCheck, RigMotion};
use crate::{Format, FormatError, Warning};

/// How far strands may be off, in sizes of the groom, before it is told.
const TOLERANCE: f64 = 1e-5;
const EXPECTED: &str =
    "numbers that 32-bit floats hold, and for USD's scales those that 16 bits do, up to 65504";

/// From the groom's numbers to the file's: C turns and scales, and points are measured from the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space {
    /// C.
    pub(crate) change: DMat4,
    pub(crate) origin: DVec3,
    /// How the file rounds a scale.
    pub(crate) scale: fn(f32) -> f32,
}

impl Space {
    /// A joint's world matrix in the file: C (W - origin) C^-1.
    fn world(&self, world: &DMat4) -> DMat4 {
        affine(self.change * (DMat4::from_translation(-self.origin) * *world) * self.change.inverse())
    }

    /// The inverse bind matrix in the file: C (I + origin) C^-1.
    pub(crate) fn inverse_bind(&self, inverse_bind: &DMat4) -> DMat4 {
        let moved = *inverse_bind * DMat4::from_translation(self.origin);
        affine(self.change * moved * self.change.inverse())
    }
}

/// The matrix with a last row of 0 0 0 1, which rounding leaves near that.
fn affine(mut matrix: DMat4) -> DMat4 {
    (matrix.x_axis.w, matrix.y_axis.w, matrix.z_axis.w, matrix.w_axis.w) = (0.0, 0.0, 0.0, 1.0);
    matrix
}

/// One joint over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Track {
    pub(crate) translations: Vec<[f32; 3]>,
    /// x, y, z, w.
    pub(crate) rotations: Vec<[f32; 4]>,
    pub(crate) scales: Vec<[f32; 3]>,
}

/// All joints over time.
#[derive(Debug)]
pub(crate) struct Tracks {
    /// In frames.
    pub(crate) times: Vec<f64>,
    pub(crate) joints: Vec<Track>,
    /// Corners of a box around all points at each time, in the file's space; widths not counted.
    pub(crate) extents: Vec<[[f32; 3]; 2]>,
}

impl Tracks {
    /// Takes all frames; warns where strands will not be where the matrices put them.
    pub(crate) fn gather(
        motion: RigMotion<'_>,
        space: Space,
        format: Format,
        file: &str,
        warnings: &mut Vec<Warning>,
    ) -> Result<Tracks, FormatError> {
        let RigMotion { groom, rig, frames, .. } = motion;
        let boxes = boxes(groom, rig, &space);
        let inverse_binds: Vec<DMat4> =
            rig.joints.iter().map(|joint| space.inverse_bind(&joint.inverse_bind)).collect();
        let count = rig.joints.len();
        let mut tracks =
            Tracks { times: Vec::new(), joints: vec![Track::default(); count], extents: Vec::new() };
        let mut last: Vec<Option<Parts>> = vec![None; count];
        let mut worlds = vec![DMat4::IDENTITY; count];
        let mut worst = Worst::default();
        let mut check = RigCheck::new(rig, file);
        for frame in frames {
            let frame = frame?;
            check.take(&frame)?;
            let mut extent = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            for (index, joint) in rig.joints.iter().enumerate() {
                let Some(world) = frame.joints.get(index).map(|world| space.world(world)) else { continue };
                let parent = joint.parent.map_or(DMat4::IDENTITY, |parent| worlds[parent]);
                let before = last[index];
                let side = before.map_or(DQuat::IDENTITY, |parts| parts.rotation);
                // The parent as it is written, so that what one joint is off does not add up. Below a parent that
                // is scaled to nothing, any place will do.
                let inverse = parent.inverse();
                let local = if inverse.is_finite() {
                    parts(&(inverse * world), side)
                } else {
                    before.unwrap_or_else(|| parts(&world, side))
                };
                let local = tracks.joints[index].push(local, &space);
                if !local.matrix().is_finite() {
                    let place = format!("joint {index} (`{}`) of frame {}", joint.name, tracks.times.len());
                    return Err(FormatError::invalid(file, place, local.to_string(), EXPECTED));
                }
                last[index] = Some(local);
                worlds[index] = parent * local.matrix();
                for corner in corners(&boxes[index]) {
                    let bound = inverse_binds[index].transform_point3(corner);
                    let (meant, written) =
                        (world.transform_point3(bound), worlds[index].transform_point3(bound));
                    worst.note(meant.distance(written), index, frame.time);
                    extent = [extent[0].min(written), extent[1].max(written)];
                }
            }
            if !extent.iter().all(|corner| corner.as_vec3().is_finite()) {
                let what = "holds bounds of the points, and joints move this groom's out of 32-bit floats";
                return Err(FormatError::Unsupported { file: file.to_owned(), format, what });
            }
            tracks.extents.push(extent.map(|corner| corner.as_vec3().to_array()));
            tracks.times.push(frame.time);
        }
        check.finish()?;
        let whole =
            boxes.iter().flatten().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |all, [low, high]| {
                [all[0].min(*low), all[1].max(*high)]
            });
        warnings.extend(worst.told(rig, format, whole[0].distance(whole[1])));
        Ok(tracks)
    }
}

impl Track {
    /// Adds the parts as floats; what the file will hold of them.
    fn push(&mut self, parts: Parts, space: &Space) -> Parts {
        let translation = parts.translation.as_vec3();
        let rotation = parts.rotation.as_quat();
        let scale = parts.scale.as_vec3().map(space.scale);
        self.translations.push(translation.to_array());
        self.rotations.push(rotation.to_array());
        self.scales.push(scale.to_array());
        Parts {
            translation: translation.as_dvec3(),
            rotation: rotation.as_dquat().normalize(),
            scale: scale.as_dvec3(),
        }
    }
}

/// Where strands are off most.
#[derive(Default)]
struct Worst {
    distance: f64,
    joint: usize,
    time: f64,
}

impl Worst {
    fn note(&mut self, distance: f64, joint: usize, time: f64) {
        if distance > self.distance {
            *self = Worst { distance, joint, time };
        }
    }

    fn told(&self, rig: &Rig, format: Format, size: f64) -> Option<Warning> {
        // A groom that is all in one place has no size that this could be a part of, and no shape to lose.
        let told = size > 0.0 && self.distance > TOLERANCE * size;
        let joint = rig.joints.get(self.joint).filter(|_| told)?.name.clone();
        let part = self.distance / size;
        Some(Warning::JointsApproximated { format, joint, time: self.time, part })
    }
}

/// The points of the strands that follow each joint, boxed, in the file's space.
fn boxes(groom: &Groom, rig: &Rig, space: &Space) -> Vec<Option<[DVec3; 2]>> {
    let mut boxes: Vec<Option<[DVec3; 2]>> = vec![None; rig.joints.len()];
    for (points, influences) in groom.strands().zip(&rig.influences) {
        let mut around = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for point in points {
            let point = space.change.transform_point3(point.as_dvec3());
            around = [around[0].min(point), around[1].max(point)];
        }
        for (joint, _) in influences.iter() {
            let known = boxes[joint].get_or_insert(around);
            *known = [known[0].min(around[0]), known[1].max(around[1])];
        }
    }
    boxes
}

fn corners(around: &Option<[DVec3; 2]>) -> impl Iterator<Item = DVec3> {
    around.iter().flat_map(|&[low, high]| {
        (0..8).map(move |corner| {
            let pick = |bit: u32, low: f64, high: f64| if corner & bit == 0 { low } else { high };
            DVec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
        })
    })
}
