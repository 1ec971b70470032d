//! Joints of all skins in one list, and the weights of the vertices.

use glam::DMat4;
use gltf::accessor::Dimensions;
use gltf::{Document, Primitive, Semantic, Skin};
use gltf_bytes::{Buffers, Elements};

use super::nodes::Nodes;
use crate::error::Fault;
use crate::skeleton::Joint;

/// The joints of every skin that is used.
#[derive(Debug, Default)]
pub(super) struct Skins {
    pub(super) joints: Vec<Joint>,
    /// Slot of the node of each joint.
    pub(super) slots: Vec<usize>,
    /// For each skin of the file that is used: its joints in the file's order, as numbers of `joints`.
    numbers: Vec<Option<Vec<u32>>>,
}

impl Skins {
    pub(super) fn of(document: &Document) -> Self {
        Skins { numbers: vec![None; document.skins().len()], ..Skins::default() }
    }

    /// Takes in a skin that a mesh uses.
    pub(super) fn add(&mut self, skin: &Skin<'_>, nodes: &Nodes, buffers: &Buffers<'_>) -> Result<(), Fault> {
        if self.numbers.get(skin.index()).is_some_and(Option::is_some) {
            return Ok(());
        }
        let inverse_bind = match skin.inverse_bind_matrices() {
            Some(accessor) => Some(
                Elements::of(&accessor, &[Dimensions::Mat4], buffers)?
                    .all(|columns: [f64; 16]| DMat4::from_cols_array(&columns)),
            ),
            None => None,
        };
        let mut found = Vec::new();
        for (i, node) in skin.joints().enumerate() {
            let invalid =
                |fault: String| Fault::invalid(format!("skins[{}].joints[{i}]", skin.index()), fault);
            let slot = nodes.slot(node.index());
            let slot = slot.ok_or_else(|| {
                invalid(format!("node {} is outside the scene, expected one inside", node.index()))
            })?;
            let bind = match &inverse_bind {
                Some(matrices) => matrices.get(i).copied(),
                None => Some(DMat4::IDENTITY),
            };
            let bind =
                bind.ok_or_else(|| invalid("no inverse bind matrix, expected one for every joint".into()))?;
            if !bind.is_finite() {
                return Err(invalid("an inverse bind matrix that is not finite, expected numbers".into()));
            }
            let name = node.name().map_or_else(|| format!("joint{}", node.index()), str::to_owned);
            found.push((slot, i, Joint { name, parent: None, inverse_bind: bind }));
        }
        // Slots have parents first.
        found.sort_by_key(|&(slot, ..)| slot);
        if let Some([(_, a, joint), (_, b, _)]) = found.array_windows().find(|[a, b]| a.0 == b.0) {
            let fault = format!("{:?} is joint {a} already, expected every joint once", joint.name);
            return Err(Fault::invalid(format!("skins[{}].joints[{b}]", skin.index()), fault));
        }
        let base = self.joints.len();
        let mut numbers = vec![0; found.len()];
        for (number, (slot, in_file, mut joint)) in found.into_iter().enumerate() {
            joint.parent = self.ancestor(slot, base, nodes);
            numbers[in_file] = (base + number) as u32;
            self.joints.push(joint);
            self.slots.push(slot);
        }
        if let Some(place) = self.numbers.get_mut(skin.index()) {
            *place = Some(numbers);
        }
        Ok(())
    }

    /// The nearest joint above `slot` among those from `base` on.
    fn ancestor(&self, slot: usize, base: usize, nodes: &Nodes) -> Option<usize> {
        let slots = self.slots.get(base..).unwrap_or_default();
        let mut above = nodes.parent(slot);
        while let Some(slot) = above {
            if let Ok(found) = slots.binary_search(&slot) {
                return Some(base + found);
            }
            above = nodes.parent(slot);
        }
        None
    }

    /// Joints and weights of each vertex over all `JOINTS_n` / `WEIGHTS_n` sets; `push` is told them vertex by
    /// vertex and is to leave the list empty.
    pub(super) fn influences(
        &self,
        skin: &Skin<'_>,
        primitive: &Primitive<'_>,
        vertices: usize,
        buffers: &Buffers<'_>,
        place: &str,
        mut push: impl FnMut(&mut Vec<(u32, f64)>),
    ) -> Result<(), Fault> {
        let numbers = self.numbers.get(skin.index()).and_then(Option::as_deref).unwrap_or_default();
        let mut sets = Vec::new();
        for set in 0.. {
            let pair = (primitive.get(&Semantic::Joints(set)), primitive.get(&Semantic::Weights(set)));
            let (Some(joints), Some(weights)) = pair else { break };
            let read = |accessor| -> Result<Vec<[f64; 4]>, Fault> {
                Ok(Elements::of(accessor, &[Dimensions::Vec4], buffers)?.all(|v| v))
            };
            let (joints, weights) = (read(&joints)?, read(&weights)?);
            if joints.len() != vertices || weights.len() != vertices {
                let fault = format!("JOINTS_{set} and WEIGHTS_{set} do not have one entry a vertex");
                return Err(Fault::invalid(place, fault));
            }
            sets.push((joints, weights));
        }
        let mut influences = Vec::new();
        for vertex in 0..vertices {
            for (set, (joints, weights)) in sets.iter().enumerate() {
                for (&joint, &weight) in
                    joints[vertex].iter().zip(&weights[vertex]).filter(|(_, w)| **w != 0.0)
                {
                    let Some(&number) = numbers.get(joint as usize) else {
                        let fault =
                            format!("joint {joint} of vertex {vertex}, expected below {}", numbers.len());
                        return Err(Fault::invalid(format!("{place}.JOINTS_{set}"), fault));
                    };
                    if !(weight.is_finite() && weight > 0.0) {
                        let fault = format!("weight {weight} of vertex {vertex}, expected 0 or more");
                        return Err(Fault::invalid(format!("{place}.WEIGHTS_{set}"), fault));
                    }
                    influences.push((number, weight));
                }
            }
            if influences.is_empty() {
                return Err(Fault::invalid(
                    place,
                    format!("vertex {vertex} has no skin weight, expected one above 0"),
                ));
            }
            push(&mut influences);
        }
        Ok(())
    }
}
