//! A ray's way through nodes of four.

use glam::Vec4;

use crate::Ray;
use crate::arrange::{LEAF, WIDTH};
use crate::slabs::Slabs;

/// Deep enough for any tree seen; deeper ones take a stack from the heap.
const USUAL_STACK: usize = 96;

/// A tree a ray can walk through; the first node is the root.
pub(crate) trait Nodes {
    /// A node's children, their near distances, and which of them are crossed before `far`; none where there
    /// is no such node.
    fn cross(&self, number: u32, slabs: &Slabs, far: f32) -> Option<(&[u32; WIDTH], Vec4, u32)>;

    /// How many nodes lie on top of each other.
    fn depth(&self) -> usize;

    /// The most that is ever left for later.
    fn stack_needed(&self) -> usize {
        self.depth() * (WIDTH - 1) + 1
    }
}

/// Calls `visit(leaf, far)` for every leaf whose box is crossed at `far` or before, nearest boxes first
/// where `ORDERED`, otherwise leaves as soon as they are found. `visit` may bring `far` nearer; it ends the
/// walk by returning true.
#[inline(always)]
pub(crate) fn walk<const ORDERED: bool>(
    nodes: &impl Nodes,
    ray: &Ray,
    far: &mut f32,
    visit: impl FnMut(u32, &mut f32) -> bool,
) {
    if nodes.stack_needed() <= USUAL_STACK {
        walk_with::<ORDERED>(nodes, &mut [(0, 0.0); USUAL_STACK], ray, far, visit);
    } else {
        walk_with::<ORDERED>(nodes, &mut vec![(0, 0.0); nodes.stack_needed()], ray, far, visit);
    }
}

#[inline(always)]
fn walk_with<const ORDERED: bool>(
    nodes: &impl Nodes,
    stack: &mut [(u32, f32)],
    ray: &Ray,
    far: &mut f32,
    mut visit: impl FnMut(u32, &mut f32) -> bool,
) {
    let slabs = Slabs::new(ray);
    let mut top = 0;
    let mut current = 0;
    loop {
        if let Some((children, near, mut mask)) = nodes.cross(current, &slabs, *far) {
            let near = near.to_array();
            let bottom = top;
            if mask.is_power_of_two() {
                // The only way on needs no stack.
                let child = children[mask.trailing_zeros() as usize & 3];
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
                let child = children[lane];
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
