//! A four-wide tree over what moves: one set of nodes, with boxes at every key.
//!
//! Between two keys every box goes in a straight line, as what it holds does: Woop, Afra and Benthin 2017,
//! "STBVH: A Spatial-Temporal BVH for Efficient Multi-Segment Motion Blur" (doi:10.1145/3105762.3105777),
//! without their splits in time.

use glam::Vec4;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;

use crate::arrange::{EMPTY, Placed, WIDTH, arrange};
use crate::shares::Shares;
use crate::slabs::Slabs;
use crate::walk::Nodes;

/// Per axis: the four low planes, the four high planes.
type Planes = [[Vec4; 2]; 3];

/// Where no box is. Finite: times nothing it must still be nothing.
const NOWHERE: Planes = [[Vec4::MAX, Vec4::MIN]; 3];

/// The tree.
#[derive(Clone, Debug)]
pub(crate) struct MovingTree {
    keys: usize,
    children: Vec<[u32; WIDTH]>,
    /// At every key, node after node.
    planes: Vec<Planes>,
    depth: usize,
}

/// The tree at one time.
pub(crate) struct AtTime<'a> {
    tree: &'a MovingTree,
    shares: &'a Shares,
}

impl MovingTree {
    /// `around` gives the boxes at a key, in the order of those the binary tree was built over, which only
    /// tells what lies near what; for the rest see [`arrange`].
    pub(crate) fn from_binary(
        binary: &Bvh2,
        keys: usize,
        around: impl Fn(usize) -> Vec<Aabb>,
        packs: impl Fn(u32) -> bool,
        leaf: impl FnMut(&[u32]) -> u32,
    ) -> Self {
        let mut children: Vec<[u32; WIDTH]> = Vec::new();
        let mut members: Vec<[u32; WIDTH]> = Vec::new();
        let depth = arrange(binary, packs, leaf, |Placed { node, lane, member, child }| {
            if children.len() <= node {
                children.resize(node + 1, [EMPTY; WIDTH]);
                members.resize(node + 1, [EMPTY; WIDTH]);
            }
            children[node][lane] = child;
            members[node][lane] = member;
        });
        children.shrink_to_fit();
        let mut planes = vec![NOWHERE; members.len() * keys];
        let order = children_first(binary);
        for key in 0..keys {
            let boxes = refitted(binary, &order, &around(key));
            for (node, members) in members.iter().enumerate() {
                for (lane, &member) in members.iter().enumerate() {
                    if let Some(around) = boxes.get(member as usize) {
                        set(&mut planes[node * keys + key], lane, around);
                    }
                }
            }
        }
        planes.chunks_mut(keys.max(1)).for_each(widen);
        Self { keys, children, planes, depth }
    }

    pub(crate) fn node_count(&self) -> usize {
        self.children.len()
    }

    pub(crate) fn bytes(&self) -> usize {
        self.children.capacity() * size_of::<[u32; WIDTH]>() + self.planes.capacity() * size_of::<Planes>()
    }

    pub(crate) fn at<'a>(&'a self, shares: &'a Shares) -> AtTime<'a> {
        AtTime { tree: self, shares }
    }
}

impl Nodes for AtTime<'_> {
    #[inline(always)]
    fn cross(&self, number: u32, slabs: &Slabs, far: f32) -> Option<(&[u32; WIDTH], Vec4, u32)> {
        let children = self.tree.children.get(number as usize)?;
        let start = number as usize * self.tree.keys + self.shares.before;
        let [before, after] = self.tree.planes.get(start..start + 2)? else { return None };
        let plane = |axis: usize, side: usize| self.shares.mix(before[axis][side], after[axis][side]);
        let (near, mask) = slabs.cross(plane, far);
        Some((children, near, mask))
    }

    fn depth(&self) -> usize {
        self.tree.depth
    }
}

fn set(planes: &mut Planes, lane: usize, around: &Aabb) {
    for (axis, planes) in planes.iter_mut().enumerate() {
        planes[0][lane] = around.min[axis];
        planes[1][lane] = around.max[axis];
    }
}

/// Moves the planes of one node apart, or mixing them would lose hits.
///
/// With `e = 2^-24` and `m` the greatest magnitude of an axis's planes at any key: a mixed plane is off by
/// `3e m` (see [`Shares::mix`]), and a point inside is rounded to within `e m`. `6e m` covers both.
fn widen(keys: &mut [Planes]) {
    for axis in 0..3 {
        let far = |planes: &Planes| planes[axis][0].abs().max(planes[axis][1].abs());
        let largest = keys.iter().map(far).fold(Vec4::ZERO, Vec4::max);
        let by = largest * (3.0 * f32::EPSILON) + Vec4::splat(f32::MIN_POSITIVE);
        for planes in keys.iter_mut() {
            let [low, high] = planes[axis];
            planes[axis] = [(low - by).max(Vec4::MIN), (high + by).min(Vec4::MAX)];
        }
    }
}

/// All binary nodes, every one after those below it.
fn children_first(binary: &Bvh2) -> Vec<u32> {
    let mut order = Vec::with_capacity(binary.nodes.len());
    let mut open = vec![0_u32];
    while let Some(number) = open.pop() {
        let Some(node) = binary.nodes.get(number as usize) else { continue };
        order.push(number);
        if !node.is_leaf() {
            open.extend([node.first_index, node.first_index + 1]);
        }
    }
    order.reverse();
    order
}

/// The binary nodes' boxes over other boxes than it was built over.
fn refitted(binary: &Bvh2, order: &[u32], around: &[Aabb]) -> Vec<Aabb> {
    let mut boxes = vec![Aabb::empty(); binary.nodes.len()];
    for &number in order {
        let Some(node) = binary.nodes.get(number as usize) else { continue };
        let first = node.first_index as usize;
        boxes[number as usize] = if node.is_leaf() {
            around[binary.primitive_indices[first] as usize]
        } else {
            boxes[first].union(&boxes[first + 1])
        };
    }
    boxes
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use proptest::prelude::*;

    use super::*;
    use crate::tracks::Between;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// A point on a face at both keys is rounded, the face is mixed: the point stays within.
        #[test]
        fn mixed_planes_hold_what_is_on_them(
            (low, high) in (-1.0_f32..1.0, -1.0_f32..1.0),
            (scale, other) in (-20.0_f32..20.0, -20.0_f32..20.0),
            time in 0.0_f32..=1.0,
        ) {
            let (a, b) = (low * 10.0_f32.powf(scale), high * 10.0_f32.powf(other));
            let plane = |x: f32| [[Vec4::splat(x); 2]; 3];
            let mut keys = [plane(a), plane(b)];
            widen(&mut keys);
            let shares = Shares::of(f64::from(time), 1);
            let x = Between::of(f64::from(time), 1).mix(Vec3::splat(a), Vec3::splat(b)).x;
            let mixed = |side: usize| shares.mix(keys[0][0][side], keys[1][0][side]).x;
            prop_assert!(mixed(0) <= x && x <= mixed(1), "{} {x} {}", mixed(0), mixed(1));
        }
    }
}
