//! Binary nodes gathered by fours, with small subtrees of segments made into leaves.

use obvhs::bvh2::Bvh2;

use crate::pack::PACKED;

pub(crate) const WIDTH: usize = 4;
/// Child references: the top bit marks a leaf, the rest numbers it.
pub(crate) const LEAF: u32 = 1 << 31;
/// Where there is no child.
pub(crate) const EMPTY: u32 = u32::MAX;

/// One child of a wide node.
pub(crate) struct Placed {
    pub(crate) node: usize,
    pub(crate) lane: usize,
    /// The binary node that it stands for.
    pub(crate) member: u32,
    /// Another node, or a leaf.
    pub(crate) child: u32,
}

/// Gathers the binary nodes by fours, the largest box opened first, and tells of every child; a node is
/// told of before its children's own. A box is told by its place among those the binary tree was built
/// over: `packs` says whether it may share a leaf, which up to `PACKED` boxes do, and `leaf` gives the number
/// kept for the boxes of one leaf. Returns how many nodes lie on top of each other.
pub(crate) fn arrange(
    binary: &Bvh2,
    packs: impl Fn(u32) -> bool,
    mut leaf: impl FnMut(&[u32]) -> u32,
    mut place: impl FnMut(Placed),
) -> usize {
    if binary.nodes.is_empty() {
        return 0;
    }
    let sizes = sizes(binary, packs);
    let mut places = Vec::with_capacity(PACKED);
    let mut count = 1;
    let mut open = vec![(0_u32, 0_usize, 1_usize)];
    let mut depth = 1;
    while let Some((source, node, level)) = open.pop() {
        depth = depth.max(level);
        for (lane, &member) in gather(binary, &sizes, source).iter().enumerate() {
            let child = if is_leaf(&sizes, member) {
                places.clear();
                collect(binary, member, &mut places);
                LEAF | leaf(&places)
            } else {
                open.push((member, count, level + 1));
                count += 1;
                (count - 1) as u32
            };
            place(Placed { node, lane, member, child });
        }
    }
    depth
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
