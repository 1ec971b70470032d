//! A four-wide tree made from `obvhs`'s binary one.
//!
//! Four boxes fill one SSE register per plane and a node two cache lines. A leaf is a single triangle or a
//! pack of segments, which are tested together: their own boxes are never looked at.

use glam::Vec4;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;

use crate::arrange::{EMPTY, Placed, WIDTH, arrange};
use crate::slabs::Slabs;
use crate::walk::Nodes;

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Node {
    /// Per axis: the four low planes, the four high planes.
    planes: [[Vec4; 2]; 3],
    children: [u32; WIDTH],
}

impl Node {
    const NONE: Self = Self { planes: [[Vec4::INFINITY, Vec4::NEG_INFINITY]; 3], children: [EMPTY; WIDTH] };

    fn set(&mut self, lane: usize, child: u32, around: &Aabb) {
        self.children[lane] = child;
        for (axis, planes) in self.planes.iter_mut().enumerate() {
            planes[0][lane] = around.min[axis];
            planes[1][lane] = around.max[axis];
        }
    }
}

/// The tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct WideTree {
    nodes: Vec<Node>,
    depth: usize,
}

impl WideTree {
    /// See [`arrange`] for what is told of the leaves.
    pub(crate) fn from_binary(
        binary: &Bvh2,
        packs: impl Fn(u32) -> bool,
        leaf: impl FnMut(&[u32]) -> u32,
    ) -> Self {
        let mut nodes: Vec<Node> = Vec::new();
        let depth = arrange(binary, packs, leaf, |Placed { node, lane, member, child }| {
            if nodes.len() <= node {
                nodes.resize(node + 1, Node::NONE);
            }
            nodes[node].set(lane, child, binary.nodes[member as usize].aabb());
        });
        nodes.shrink_to_fit();
        Self { nodes, depth }
    }

    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub(crate) fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }
}

impl Nodes for WideTree {
    #[inline(always)]
    fn cross(&self, number: u32, slabs: &Slabs, far: f32) -> Option<(&[u32; WIDTH], Vec4, u32)> {
        let node = self.nodes.get(number as usize)?;
        let (near, mask) = slabs.cross(|axis, side| node.planes[axis][side], far);
        Some((&node.children, near, mask))
    }

    fn depth(&self) -> usize {
        self.depth
    }
}
