//! The nodes of a scene, and the channels that move them.

use glam::{DMat4, DVec3};
use gltf::Document;
use gltf::accessor::Dimensions;
use gltf::animation::Property;
use gltf_bytes::{Buffers, Local};

use super::curve::Curve;
use crate::budget::Budget;
use crate::error::Fault;

/// The nodes of a scene, parents first. A node's place in this order is its slot.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    slots: Vec<Option<usize>>,
    parents: Vec<Option<usize>>,
    locals: Vec<Local>,
    channels: Vec<Channel>,
}

/// A curve that moves a node.
#[derive(Clone, Debug)]
struct Channel {
    slot: usize,
    property: Property,
    curve: Curve,
}

impl Nodes {
    /// The nodes of the scene that is shown, still.
    pub(super) fn read(document: &Document) -> Result<Self, Fault> {
        let order = gltf_bytes::parents_first(document)?;
        let mut slots = vec![None; document.nodes().len()];
        for (slot, (node, _)) in order.iter().enumerate() {
            slots[*node] = Some(slot);
        }
        let all: Vec<Local> = document.nodes().map(|node| Local::of(&node)).collect();
        Ok(Nodes {
            parents: order.iter().map(|(_, parent)| parent.and_then(|node| slots[node])).collect(),
            locals: order.iter().map(|(node, _)| all[*node]).collect(),
            slots,
            channels: Vec::new(),
        })
    }

    /// The slot of a node; `None` outside the scene.
    pub(super) fn slot(&self, node: usize) -> Option<usize> {
        self.slots.get(node).copied().flatten()
    }

    pub(super) fn parent(&self, slot: usize) -> Option<usize> {
        self.parents.get(slot).copied().flatten()
    }

    pub(super) fn len(&self) -> usize {
        self.locals.len()
    }

    /// Lets `animation` move the nodes. Returns the curves of morph weights, by node.
    pub(super) fn animate(
        &mut self,
        animation: &gltf::Animation<'_>,
        buffers: &Buffers<'_>,
        budget: &mut Budget,
    ) -> Result<Vec<(usize, Curve)>, Fault> {
        let mut weights = Vec::new();
        for channel in animation.channels() {
            let (target, sampler) = (channel.target(), channel.sampler());
            let node = target.node();
            let Some(slot) = self.slot(node.index()) else { continue };
            let place = format!("animations[{}].samplers[{}]", animation.index(), sampler.index());
            budget.take(sampler.input().count().saturating_add(sampler.output().count()), &place)?;
            let property = target.property();
            let (element, width) = match property {
                Property::Translation | Property::Scale => (Dimensions::Vec3, 3),
                Property::Rotation => (Dimensions::Vec4, 4),
                Property::MorphTargetWeights => {
                    let Some(mesh) = node.mesh() else { continue };
                    let targets =
                        mesh.primitives().map(|p| p.morph_targets().count()).max().unwrap_or_default();
                    let curve = Curve::read(&sampler, Dimensions::Scalar, targets, buffers, &place)?;
                    weights.push((node.index(), curve));
                    continue;
                }
            };
            let curve = Curve::read(&sampler, element, width, buffers, &place)?;
            self.locals[slot] = in_parts(self.locals[slot]);
            self.channels.push(Channel { slot, property, curve });
        }
        Ok(weights)
    }

    /// `world_from_node` of every slot, into `worlds`; without a time, before any animation. `locals` is room
    /// to work in.
    pub(super) fn worlds(&self, time: Option<f64>, locals: &mut Vec<Local>, worlds: &mut Vec<DMat4>) {
        locals.clone_from(&self.locals);
        for channel in self.channels.iter().filter(|_| time.is_some()) {
            channel.apply(time.unwrap_or_default(), &mut locals[channel.slot]);
        }
        worlds.clear();
        for (local, parent) in locals.iter().zip(&self.parents) {
            let parent = parent.and_then(|slot| worlds.get(slot)).copied().unwrap_or(DMat4::IDENTITY);
            worlds.push(parent * local.matrix());
        }
    }
}

impl Channel {
    fn apply(&self, time: f64, local: &mut Local) {
        let Local::Parts { translation, rotation, scale } = local else { return };
        match self.property {
            Property::Translation => *translation = self.curve.vector(time),
            Property::Rotation => *rotation = self.curve.rotation(time),
            Property::Scale => *scale = self.curve.vector(time),
            Property::MorphTargetWeights => {}
        }
    }
}

/// glTF wants nodes that are animated in parts (section 3.5.3); a matrix is taken apart as well as it can be.
fn in_parts(local: Local) -> Local {
    let Local::Matrix(matrix) = local else { return local };
    let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
    if scale.is_finite() && rotation.is_finite() {
        Local::Parts { translation, rotation: rotation.normalize(), scale }
    } else {
        Local::Parts { translation, rotation: glam::DQuat::IDENTITY, scale: DVec3::ZERO }
    }
}
