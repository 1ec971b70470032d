//! Joints as a skin: the mesh's vertices follow nodes, whose translations, rotations and scales have keys.

use std::path::Path;

use glam::{DMat4, DVec3};
use gltf::json::accessor::Type;
use groom::{Groom, UpAxis};

use super::moving::{Moving, seconds};
use super::{Plan, files};
use crate::rig::{Influences, Rig, RigMotion, Space, Track, Tracks};
use crate::{Format, FormatError, Warning, WriteOptions};

/// Joints whose number fits a byte; more take two.
const BYTE: usize = 256;
const MOST: usize = 1 << 16;

/// A skin and what its joints do.
pub(super) struct Skin<'a> {
    pub(super) rig: &'a Rig,
    /// Where the joints are measured from, y-up and in metres.
    pub(super) origin: DVec3,
    pub(super) joints: Vec<JointKeys>,
    /// Places among the arrays of the tail; where nothing moves there are no times.
    pub(super) times: Option<usize>,
    pub(super) inverse_binds: usize,
}

/// A joint: its first place, and arrays of the tail with keys of what changes.
pub(super) struct JointKeys {
    pub(super) translation: ([f32; 3], Option<usize>),
    /// x, y, z, w.
    pub(super) rotation: ([f32; 4], Option<usize>),
    pub(super) scale: ([f32; 3], Option<usize>),
}

impl JointKeys {
    fn moves(&self) -> bool {
        self.translation.1.is_some() || self.rotation.1.is_some() || self.scale.1.is_some()
    }
}

impl Skin<'_> {
    /// Whether a joint's number takes two bytes.
    pub(super) fn is_wide(&self) -> bool {
        self.rig.joints.len() > BYTE
    }

    pub(super) fn influences(&self, strand: usize) -> Influences {
        self.rig.influences.get(strand).copied().unwrap_or_default().normalized()
    }
}

/// From the groom's axes and unit to glTF's.
pub(super) fn change(groom: &Groom) -> DMat4 {
    let turn = match groom.up_axis {
        UpAxis::Y => DMat4::IDENTITY,
        UpAxis::Z => DMat4::from_cols_array(&[
            1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
        ]),
    };
    DMat4::from_scale(DVec3::splat(groom.meters_per_unit)) * turn
}

/// Writes a groom and the joints that move it.
pub(crate) fn write_rigged(
    motion: RigMotion<'_>,
    format: Format,
    path: &Path,
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let (rig, motion_options) = (motion.rig, motion.options);
    if rig.joints.len() > MOST {
        let (file, what, found) = (file.to_owned(), "joints", rig.joints.len() as u64);
        return Err(FormatError::TooLarge { file, format, what, found, limit: MOST as u64 });
    }
    let mut plan = Plan::new(motion.groom, format, file, options)?;
    let change = change(motion.groom);
    let space = Space { change, origin: motion_options.origin, scale: |scale| scale };
    let tracks = Tracks::gather(motion, space, format, file, &mut plan.warnings)?;
    let times = seconds(&tracks.times, motion_options.frame_rate, file)?;
    // Integer positions are placed by the node of a mesh that has no skin, and by the skin of one that has.
    let placed = plan.grid.filter(|grid| grid.is_stored()).map_or(DMat4::IDENTITY, |grid| {
        let scale = DVec3::splat(grid.scale().into());
        DMat4::from_translation(grid.translation().as_dvec3()) * DMat4::from_scale(scale)
    });
    let mut inverse_binds = Vec::with_capacity(rig.joints.len() * 16);
    for (index, joint) in rig.joints.iter().enumerate() {
        let matrix = (space.inverse_bind(&joint.inverse_bind) * placed).as_mat4();
        if !matrix.is_finite() {
            let place = format!("inverse bind matrix of joint {index} (`{}`)", joint.name);
            let found = joint.inverse_bind.to_string();
            return Err(FormatError::invalid(file, place, found, "numbers that 32-bit floats hold"));
        }
        inverse_binds.extend(matrix.to_cols_array());
    }
    let inverse_binds = plan.tail.push(Type::Mat4, inverse_binds);
    let joints: Vec<JointKeys> = tracks.joints.iter().map(|track| keys(track, &mut plan)).collect();
    let times = joints.iter().any(JointKeys::moves).then(|| plan.tail.push_times(times));
    let origin = change.transform_point3(motion_options.origin);
    plan.follow(Moving::Skin(Skin { rig, origin, joints, times, inverse_binds }), format, file)?;
    files::write(plan, format, path, file)
}

fn keys(track: &Track, plan: &mut Plan<'_>) -> JointKeys {
    JointKeys {
        translation: changing(&track.translations, Type::Vec3, plan),
        rotation: changing(&track.rotations, Type::Vec4, plan),
        scale: changing(&track.scales, Type::Vec3, plan),
    }
}

/// The first value, and the array of all where they differ.
fn changing<const N: usize>(
    values: &[[f32; N]],
    kind: Type,
    plan: &mut Plan<'_>,
) -> ([f32; N], Option<usize>) {
    let first = values.first().copied().unwrap_or([0.0; N]);
    let changes = values.iter().any(|value| *value != first);
    (first, changes.then(|| plan.tail.push(kind, values.as_flattened().to_vec())))
}
