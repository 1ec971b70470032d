//! The document's nodes, skin and animation.

use gltf::json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target};
use gltf::json::scene::UnitQuaternion;
use gltf::json::skin::Skin as JsonSkin;
use gltf::json::validation::Checked::Valid;
use gltf::json::{Accessor, Index, Node, Root};

use super::moving::Morphs;
use super::skin::{JointKeys, Skin};

/// Adds a node a joint and the skin; the skin and the nodes that belong into the scene.
pub(super) fn skin(
    root: &mut Root,
    skin: &Skin<'_>,
    accessors: &[Index<Accessor>],
) -> (Index<JsonSkin>, Vec<Index<Node>>) {
    let first = root.nodes.len();
    let node = |joint: usize| Index::new((first + joint) as u32);
    let mut keys = Keys::new(accessors, skin.times);
    let mut tops = Vec::new();
    let mut children = vec![Vec::new(); skin.rig.joints.len()];
    for (index, joint) in skin.rig.joints.iter().enumerate() {
        joint.parent.and_then(|parent| children.get_mut(parent)).unwrap_or(&mut tops).push(node(index));
    }
    let joints = skin.rig.joints.iter().zip(&skin.joints).zip(children);
    for (index, ((joint, moves), children)) in joints.enumerate() {
        root.push(joint_node(&joint.name, moves, children));
        keys.add(node(index), Property::Translation, moves.translation.1);
        keys.add(node(index), Property::Rotation, moves.rotation.1);
        keys.add(node(index), Property::Scale, moves.scale.1);
    }
    let placed = skin.origin.as_vec3();
    let is_placed = placed != glam::Vec3::ZERO;
    // Joints of a skin must have one root, which need not be a joint.
    if is_placed || tops.len() > 1 {
        let name = Some("Origin".to_owned());
        let translation = is_placed.then_some(placed.to_array());
        tops = vec![root.push(Node { name, translation, children: Some(tops), ..Node::default() })];
    }
    let joints = (0..skin.rig.joints.len()).map(node).collect();
    let inverse_bind_matrices = accessors.get(skin.inverse_binds).copied();
    let name = Some("Rig".to_owned());
    let skin = root.push(JsonSkin {
        extensions: None,
        extras: None,
        inverse_bind_matrices,
        joints,
        name,
        skeleton: None,
    });
    keys.finish(root);
    (skin, tops)
}

fn joint_node(name: &str, moves: &JointKeys, children: Vec<Index<Node>>) -> Node {
    let (translation, rotation, scale) = (moves.translation.0, moves.rotation.0, moves.scale.0);
    Node {
        name: Some(name.to_owned()),
        children: (!children.is_empty()).then_some(children),
        translation: (translation != [0.0; 3]).then_some(translation),
        rotation: (rotation != [0.0, 0.0, 0.0, 1.0]).then_some(UnitQuaternion(rotation)),
        scale: (scale != [1.0; 3]).then_some(scale),
        ..Node::default()
    }
}

/// Adds the keys of the weights of the mesh at `node`.
pub(super) fn morphs(root: &mut Root, node: Index<Node>, morphs: &Morphs, accessors: &[Index<Accessor>]) {
    let Some((times, weights)) = morphs.keys else { return };
    let mut keys = Keys::new(accessors, Some(times));
    keys.add(node, Property::MorphTargetWeights, Some(weights));
    keys.finish(root);
}

/// An animation being put together.
struct Keys<'a> {
    accessors: &'a [Index<Accessor>],
    times: Option<usize>,
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

impl<'a> Keys<'a> {
    fn new(accessors: &'a [Index<Accessor>], times: Option<usize>) -> Self {
        Keys { accessors, times, channels: Vec::new(), samplers: Vec::new() }
    }

    /// Keys of a node's property, if there are any.
    fn add(&mut self, node: Index<Node>, path: Property, values: Option<usize>) {
        let values = values.and_then(|values| self.accessors.get(values));
        let times = self.times.and_then(|times| self.accessors.get(times));
        let (Some(&input), Some(&output)) = (times, values) else { return };
        let sampler = Index::new(self.samplers.len() as u32);
        let interpolation = Valid(Interpolation::Linear);
        self.samplers.push(Sampler { extensions: None, extras: None, input, interpolation, output });
        let target = Target { extensions: None, extras: None, node, path: Valid(path) };
        self.channels.push(Channel { sampler, target, extensions: None, extras: None });
    }

    fn finish(self, root: &mut Root) {
        let Keys { channels, samplers, .. } = self;
        if !channels.is_empty() {
            let name = Some("Motion".to_owned());
            root.push(Animation { extensions: None, extras: None, channels, name, samplers });
        }
    }
}
