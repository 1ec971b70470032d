//! A four-wide tree made from `obvhs`'s binary one, and the walk through it.
//!
//! Four boxes fill one SSE register per plane and a node two cache lines. A leaf is a single triangle or a
//! pack of segments, which are tested together: their own boxes are never looked at.

use glam::{Vec3, Vec4};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;

use crate::Ray;
use crate::pack::PACKED;

const WIDTH: usize = 4;
/// Child references: the top bit marks a leaf, the rest numbers it.
const LEAF: u32 = 1 << 31;
const EMPTY: u32 = u32::MAX;
/// Deep enough for any tree seen; deeper ones take a stack from the heap.
const USUAL_STACK: usize = 96;
/// Rounding of slab distances, three operations' worth on both sides (Ize 2013): no box is missed for it.
const SLAB_ROUNDING: f32 = 1.0 + 4.0 * f32::EPSILON;

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

/// A distance no box entered at `t` or before can seem beyond, for [`WideTree::walk`]'s `far`.
pub(crate) fn reach(t: f64) -> f32 {
    (t as f32).next_up() * SLAB_ROUNDING
}

/// The tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct WideTree {
    nodes: Vec<Node>,
    stack_needed: usize,
}

/// What the box test needs of a ray.
struct Slabs {
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    /// 1 where the ray goes down the axis: the high plane is then the near one.
    backwards: [usize; 3],
}

impl Slabs {
    fn new(ray: &Ray) -> Self {
        // A component of 0 becomes a tiny one, so no 0 * infinity comes up: a ray in a face of a box is
        // inside it, and a ray beside it still misses.
        let tame = |d: f32| if d.abs() < 1e-30 { 1e-30_f32.copysign(d) } else { d };
        let inverse = Vec3::new(tame(ray.direction.x), tame(ray.direction.y), tame(ray.direction.z)).recip();
        Self {
            origin: ray.origin.to_array().map(Vec4::splat),
            inverse: inverse.to_array().map(Vec4::splat),
            backwards: inverse.to_array().map(|d| usize::from(d < 0.0)),
        }
    }

    /// Near distances of the four boxes and which of them are crossed before `far`.
    #[inline(always)]
    fn cross(&self, node: &Node, far: f32) -> (Vec4, u32) {
        let [bx, by, bz] = self.backwards;
        let [x, y, z] = &node.planes;
        let near_x = (x[bx & 1] - self.origin[0]) * self.inverse[0];
        let near_y = (y[by & 1] - self.origin[1]) * self.inverse[1];
        let near_z = (z[bz & 1] - self.origin[2]) * self.inverse[2];
        let far_x = (x[1 - (bx & 1)] - self.origin[0]) * self.inverse[0];
        let far_y = (y[1 - (by & 1)] - self.origin[1]) * self.inverse[1];
        let far_z = (z[1 - (bz & 1)] - self.origin[2]) * self.inverse[2];
        let near = near_x.max(near_y).max(near_z.max(Vec4::ZERO));
        let exit = far_x.min(far_y).min(far_z) * SLAB_ROUNDING;
        (near, near.cmple(exit.min(Vec4::splat(far))).bitmask())
    }
}

impl WideTree {
    /// Gathers the binary nodes by fours, the largest box opened first. A box is told by its place among
    /// those the binary tree was built over: `packs` says whether it may share a leaf, which up to `PACKED`
    /// boxes do, and `leaf` gives the number kept for the boxes of one leaf.
    pub(crate) fn from_binary(
        binary: &Bvh2,
        packs: impl Fn(u32) -> bool,
        mut leaf: impl FnMut(&[u32]) -> u32,
    ) -> Self {
        let mut tree = Self::default();
        if binary.nodes.is_empty() {
            return tree;
        }
        let sizes = sizes(binary, packs);
        let mut places = Vec::with_capacity(PACKED);
        tree.nodes.push(Node::NONE);
        let mut open = vec![(0_u32, 0_usize, 1_usize)];
        let mut depth = 1;
        while let Some((source, target, level)) = open.pop() {
            depth = depth.max(level);
            for (lane, &member) in gather(binary, &sizes, source).iter().enumerate() {
                let Some(from) = binary.nodes.get(member as usize) else { continue };
                let child = if is_leaf(&sizes, member) {
                    places.clear();
                    collect(binary, member, &mut places);
                    LEAF | leaf(&places)
                } else {
                    open.push((member, tree.nodes.len(), level + 1));
                    tree.nodes.push(Node::NONE);
                    (tree.nodes.len() - 1) as u32
                };
                tree.nodes[target].set(lane, child, from.aabb());
            }
        }
        tree.nodes.shrink_to_fit();
        tree.stack_needed = depth * (WIDTH - 1) + 1;
        tree
    }

    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub(crate) fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }

    /// Calls `visit(leaf, far)` for every leaf whose box is crossed at `far` or before, nearest boxes first
    /// where `ORDERED`, otherwise leaves as soon as they are found. `visit` may bring `far` nearer; it ends the walk by returning true.
    #[inline(always)]
    pub(crate) fn walk<const ORDERED: bool>(
        &self,
        ray: &Ray,
        far: &mut f32,
        visit: impl FnMut(u32, &mut f32) -> bool,
    ) {
        if self.stack_needed <= USUAL_STACK {
            self.walk_with::<ORDERED>(&mut [(0, 0.0); USUAL_STACK], ray, far, visit);
        } else {
            self.walk_with::<ORDERED>(&mut vec![(0, 0.0); self.stack_needed], ray, far, visit);
        }
    }

    #[inline(always)]
    fn walk_with<const ORDERED: bool>(
        &self,
        stack: &mut [(u32, f32)],
        ray: &Ray,
        far: &mut f32,
        mut visit: impl FnMut(u32, &mut f32) -> bool,
    ) {
        let slabs = Slabs::new(ray);
        let mut top = 0;
        let mut current = 0;
        loop {
            if let Some(node) = self.nodes.get(current as usize) {
                let (near, mut mask) = slabs.cross(node, *far);
                let near = near.to_array();
                let bottom = top;
                if mask.is_power_of_two() {
                    // The only way on needs no stack.
                    let child = node.children[mask.trailing_zeros() as usize & 3];
                    if child & LEAF == 0 {
                        current = child;
                        continue;
                    }
                    if visit(child & !LEAF, far) {
                        return;
                    }
                    mask = 0;
                }
                while mask != 0 {
                    let lane = mask.trailing_zeros() as usize & 3;
                    mask &= mask - 1;
                    let child = node.children[lane];
                    if !ORDERED && child & LEAF != 0 {
                        if visit(child & !LEAF, far) {
                            return;
                        }
                        continue;
                    }
                    let mut place = top;
                    if ORDERED {
                        while place > bottom && stack[place - 1].1 < near[lane] {
                            stack[place] = stack[place - 1];
                            place -= 1;
                        }
                    }
                    stack[place] = (child, near[lane]);
                    top += 1;
                }
            }
            loop {
                if top == 0 {
                    return;
                }
                top -= 1;
                let (child, near) = stack[top];
                if ORDERED && near > *far {
                    continue;
                }
                if child & LEAF == 0 {
                    current = child;
                    break;
                }
                if visit(child & !LEAF, far) {
                    return;
                }
            }
        }
    }
}

/// How many boxes every binary node holds if they fit one leaf, more than `PACKED` where they do not.
fn sizes(binary: &Bvh2, packs: impl Fn(u32) -> bool) -> Vec<u8> {
    const MORE: u8 = PACKED as u8 + 1;
    let mut sizes = vec![MORE; binary.nodes.len()];
    let mut open = vec![(0_u32, false)];
    while let Some((number, below_known)) = open.pop() {
        let Some(node) = binary.nodes.get(number as usize) else { continue };
        let first = node.first_index;
        sizes[number as usize] = if node.is_leaf() {
            let alone = !packs(binary.primitive_indices[first as usize]);
            if alone { 0 } else { 1 }
        } else if below_known {
            match [sizes[first as usize], sizes[first as usize + 1]] {
                [0, _] | [_, 0] => MORE,
                [a, b] => (a + b).min(MORE),
            }
        } else {
            open.extend([(number, true), (first, false), (first + 1, false)]);
            MORE
        };
    }
    sizes
}

/// Whether a binary node is one leaf here.
fn is_leaf(sizes: &[u8], number: u32) -> bool {
    sizes.get(number as usize).is_none_or(|&size| usize::from(size) <= PACKED)
}

/// The places of all boxes below a binary node.
fn collect(binary: &Bvh2, number: u32, places: &mut Vec<u32>) {
    let Some(node) = binary.nodes.get(number as usize) else { return };
    if node.is_leaf() {
        places.push(binary.primitive_indices[node.first_index as usize]);
    } else {
        collect(binary, node.first_index, places);
        collect(binary, node.first_index + 1, places);
    }
}

/// Up to four descendants of a binary node that together hold all it holds.
fn gather(binary: &Bvh2, sizes: &[u8], source: u32) -> Vec<u32> {
    let mut members = vec![source];
    while members.len() < WIDTH {
        let largest = members
            .iter()
            .enumerate()
            .filter(|&(_, &m)| !is_leaf(sizes, m))
            .filter_map(|(place, &m)| binary.nodes.get(m as usize).map(|n| (place, n)))
            .max_by(|(_, a), (_, b)| a.aabb().half_area().total_cmp(&b.aabb().half_area()));
        let Some((place, node)) = largest else { break };
        members[place] = node.first_index;
        members.push(node.first_index + 1);
    }
    members
}
