//! `--as-skinned`: strands at rest, and the joints that move them.

use std::cell::Cell;
use std::path::Path;

use anyhow::{Context, Result, bail};
use command_line::progress_bar;
use glam::{DMat4, DVec3, Vec3};
use groom::Groom;
use groom_binding::{Binding, Carrier};
use groom_formats::{
    FormatError, Influences, MotionOptions, Rig, RigFrame, RigJoint, Warning, WriteOptions, write_rigged,
};
use moving_mesh::{Pose, Skeleton};

use crate::character::Character;

/// Strands as they were modelled with the skin, and the joints they follow.
pub(crate) struct Skinned {
    pub(crate) groom: Groom,
    pub(crate) rig: Rig,
}

impl Skinned {
    /// Strands follow the joints that carry the triangle at their root, each vertex as much as it counts there.
    ///
    /// `rest` is when the mesh is at rest, in seconds; `None` when that is as its skin was modelled.
    pub(crate) fn new(
        groom: &Groom,
        binding: &Binding,
        character: &Character,
        rest: Option<f64>,
    ) -> Result<Skinned> {
        let Some(skeleton) = character.mesh.skeleton() else {
            bail!(
                "--as-skinned needs joints, and {} has no skin; without it points are written",
                character.name
            );
        };
        let triangles = character.mesh.triangles();
        let of = |root: &groom_binding::Root| {
            let corners = triangles.get(root.triangle as usize).copied().unwrap_or_default();
            influences(skeleton, corners, root.barycentrics)
        };
        let influences: Vec<Option<Influences>> = binding.roots().iter().map(of).collect();
        let loose = influences.iter().filter(|influences| influences.is_none()).count();
        let Some(influences) = influences.into_iter().collect::<Option<Vec<_>>>() else {
            bail!(
                "--as-skinned: {loose} of {} strands stand where no joint carries {}; without it points are written",
                groom.strand_count(),
                character.name
            );
        };
        let joints = skeleton.joints.iter().map(|joint| RigJoint {
            name: joint.name.clone(),
            parent: joint.parent,
            inverse_bind: joint.inverse_bind,
        });
        let rig = Rig { joints: joints.collect(), influences };
        let mut groom = groom.clone();
        if let Some(seconds) = rest {
            let joints = character.mesh.joint_worlds(seconds)?;
            for strand in 0..groom.strand_count() {
                let back = strand_matrix(&rig, &joints, strand).inverse();
                if !back.is_finite() {
                    bail!("--as-skinned: the joints of strand {strand} have no extent at rest");
                }
                let range = groom.strand_range(strand);
                for point in &mut groom.positions_mut()[range] {
                    *point = back.transform_point3(point.as_dvec3()).as_vec3();
                }
            }
        }
        Ok(Skinned { groom, rig })
    }

    /// How far points are, at most, from where they are carried to with their roots on the mesh.
    fn error(&self, joints: &[DMat4], carried: &[Vec3], origin: DVec3) -> f64 {
        let mut worst = 0.0_f64;
        for strand in 0..self.groom.strand_count() {
            let matrix = strand_matrix(&self.rig, joints, strand);
            let range = self.groom.strand_range(strand);
            for (point, carried) in self.groom.strand(strand).iter().zip(&carried[range]) {
                let skinned = matrix.transform_point3(point.as_dvec3());
                worst = worst.max(skinned.distance_squared(carried.as_dvec3() + origin));
            }
        }
        worst.sqrt()
    }
}

/// The joints of a place in a triangle.
fn influences(skeleton: &Skeleton, corners: [u32; 3], weights: DVec3) -> Option<Influences> {
    let each = corners.into_iter().zip(weights.to_array());
    let all = each.flat_map(|(vertex, weight)| {
        let joints = skeleton.influences(vertex as usize).iter();
        joints.map(move |&(joint, part)| (joint, f64::from(part) * weight))
    });
    Influences::strongest(&all.collect::<Vec<_>>())
}

/// What the joints do to a strand: all of its points go with the same blend.
fn strand_matrix(rig: &Rig, joints: &[DMat4], strand: usize) -> DMat4 {
    let mut blended = DMat4::ZERO;
    for (joint, weight) in rig.influences[strand].iter() {
        if let (Some(world), Some(joint)) = (joints.get(joint), rig.joints.get(joint)) {
            blended += *world * joint.inverse_bind * f64::from(weight);
        }
    }
    blended
}

/// Writes it; returns what the format could not hold, and how far strands are from where they would be carried.
pub(crate) fn write(
    skinned: &Skinned,
    character: &Character,
    carrier: &mut Carrier<'_>,
    origin: DVec3,
    output: &Path,
    options: &WriteOptions,
) -> Result<(Vec<Warning>, f64)> {
    let Character { mesh, timeline, .. } = character;
    let bar = progress_bar(timeline.frames().len() as u64, "frames");
    let (fault, worst) = (Cell::new(None), Cell::new(0.0_f64));
    let (mut pose, mut carried) = (Pose::default(), Vec::new());
    let mut at = |frame: f64| -> Result<RigFrame> {
        let seconds = timeline.seconds(frame);
        let joints = mesh.joint_worlds(seconds)?;
        mesh.pose_into(seconds, &mut pose)?;
        carrier.positions(&pose, &mut carried)?;
        worst.set(worst.get().max(skinned.error(&joints, &carried, origin)));
        Ok(RigFrame { time: frame, joints })
    };
    let written = {
        let mut frames = timeline.frames().map(|frame| {
            bar.inc(1);
            at(frame).with_context(|| format!("frame {frame}")).map_err(|error| {
                let stopped = std::io::Error::other("a frame could not be posed");
                fault.set(Some(error));
                FormatError::Io { file: output.display().to_string(), source: stopped }
            })
        });
        let motion = MotionOptions { frame_rate: timeline.rate, origin: DVec3::ZERO };
        write_rigged(&skinned.groom, &skinned.rig, &mut frames, &motion, output, options)
    };
    bar.finish();
    match fault.take() {
        Some(error) => Err(error),
        None => Ok((written?, worst.get())),
    }
}
