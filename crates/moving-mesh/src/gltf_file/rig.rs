//! Everything that gives a glTF scene its pose at a time.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use glam::{DAffine3, DMat4, DVec3, Vec3};
use gltf_bytes::Local;

use super::curve::Curve;
use super::nodes::Nodes;
use super::primitive::MorphTarget;
use crate::normals::{cofactors, to_unit, turn};
use crate::{Pose, RestPose, Skeleton};

/// A scene, read; nothing of the file is looked at again.
#[derive(Debug)]
pub(crate) struct Rig {
    pub(super) nodes: Nodes,
    pub(super) pieces: Vec<Piece>,
    /// Weights of morph targets that change with time.
    pub(super) weights: Vec<Curve>,
    /// As modelled, one a vertex.
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Option<Vec<Vec3>>,
    pub(super) skeleton: Skeleton,
    /// Slot of the node of each joint.
    pub(super) joint_slots: Vec<usize>,
    /// Room to work in, one for each pose that is being made.
    pub(super) rooms: Mutex<Vec<Room>>,
}

/// A primitive of a node.
#[derive(Debug)]
pub(super) struct Piece {
    pub(super) vertices: Range<usize>,
    pub(super) slot: usize,
    pub(super) skinned: bool,
    pub(super) targets: Vec<MorphTarget>,
    /// Of the targets, without animation.
    pub(super) default_weights: Vec<f64>,
    /// Number of the curve they follow.
    pub(super) curve: Option<usize>,
}

/// What is used while a pose is made, kept for the next.
#[derive(Debug, Default)]
pub(super) struct Room {
    locals: Vec<Local>,
    worlds: Vec<DMat4>,
    joints: Vec<DAffine3>,
    weights: Vec<f64>,
}

impl Rig {
    pub(crate) fn skeleton(&self) -> Option<&Skeleton> {
        (!self.skeleton.joints.is_empty()).then_some(&self.skeleton)
    }

    /// `world_from_joint` of every joint of the skeleton.
    pub(crate) fn joint_worlds(&self, at: RestPose) -> Vec<DMat4> {
        self.with_room(|room| {
            self.nodes.worlds(at.time(), &mut room.locals, &mut room.worlds);
            self.joint_slots.iter().map(|&slot| room.worlds[slot]).collect()
        })
    }

    pub(crate) fn pose_into(&self, at: RestPose, pose: &mut Pose) {
        self.with_room(|room| self.make(at, room, pose));
    }

    fn make(&self, at: RestPose, room: &mut Room, pose: &mut Pose) {
        let Room { locals, worlds, joints, weights } = room;
        self.nodes.worlds(at.time(), locals, worlds);
        joints.clear();
        joints.extend(
            self.joint_slots
                .iter()
                .zip(&self.skeleton.joints)
                .map(|(&slot, joint)| DAffine3::from_mat4(worlds[slot] * joint.inverse_bind)),
        );
        pose.positions.clone_from(&self.positions);
        pose.normals.clone_from(&self.normals);
        for piece in &self.pieces {
            let positions = &mut pose.positions[piece.vertices.clone()];
            let mut normals = pose.normals.as_mut().map(|normals| &mut normals[piece.vertices.clone()]);
            self.weigh(piece, at, weights);
            piece.morph(weights, positions, normals.as_deref_mut());
            match piece.skinned {
                true if at == RestPose::Bind => normals.into_iter().flatten().for_each(to_unit),
                true => self.skin(piece.vertices.start, joints, positions, normals),
                false => carry(&DAffine3::from_mat4(worlds[piece.slot]), positions, normals),
            }
        }
    }

    fn weigh(&self, piece: &Piece, at: RestPose, weights: &mut Vec<f64>) {
        weights.clone_from(&piece.default_weights);
        let curve = piece.curve.and_then(|curve| self.weights.get(curve));
        if let (Some(curve), Some(time)) = (curve, at.time()) {
            curve.sample(time, weights);
        }
    }

    fn skin(
        &self,
        first: usize,
        joints: &[DAffine3],
        positions: &mut [DVec3],
        mut normals: Option<&mut [Vec3]>,
    ) {
        for (i, position) in positions.iter_mut().enumerate() {
            let matrix = match self.skeleton.influences(first + i) {
                [(joint, _)] => joints[*joint as usize],
                influences => blend(joints, influences),
            };
            *position = matrix.transform_point3(*position);
            if let Some(normals) = &mut normals {
                turn(&cofactors(&matrix.matrix3), &mut normals[i]);
            }
        }
    }

    fn with_room<T>(&self, work: impl FnOnce(&mut Room) -> T) -> T {
        let rooms = || self.rooms.lock().unwrap_or_else(PoisonError::into_inner);
        let mut room = rooms().pop().unwrap_or_default();
        let made = work(&mut room);
        rooms().push(room);
        made
    }
}

impl Piece {
    fn morph(&self, weights: &[f64], positions: &mut [DVec3], mut normals: Option<&mut [Vec3]>) {
        for (target, &weight) in self.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            for (vertex, delta) in &target.positions {
                positions[*vertex as usize] += delta.as_dvec3() * weight;
            }
            if let Some(normals) = &mut normals {
                for (vertex, delta) in &target.normals {
                    normals[*vertex as usize] += *delta * weight as f32;
                }
            }
        }
    }
}

fn carry(world: &DAffine3, positions: &mut [DVec3], normals: Option<&mut [Vec3]>) {
    for position in positions {
        *position = world.transform_point3(*position);
    }
    let cofactors = cofactors(&world.matrix3);
    for normal in normals.into_iter().flatten() {
        turn(&cofactors, normal);
    }
}

/// Weights are `f32`, whose sum misses 1 by a little: that little times a place far away would be seen, so it is
/// taken out in `f64`.
fn blend(joints: &[DAffine3], influences: &[(u32, f32)]) -> DAffine3 {
    let mut sum = 0.0;
    let mut columns = [DVec3::ZERO; 4];
    for &(joint, weight) in influences {
        let (matrix, weight) = (&joints[joint as usize], f64::from(weight));
        sum += weight;
        columns[0] += matrix.matrix3.x_axis * weight;
        columns[1] += matrix.matrix3.y_axis * weight;
        columns[2] += matrix.matrix3.z_axis * weight;
        columns[3] += matrix.translation * weight;
    }
    let [x, y, z, w] = columns.map(|column| column * (1.0 / sum));
    DAffine3::from_cols(x, y, z, w)
}
