//! Boxes that hold a primitive for certain.

use glam::{Vec3, Vec4, Vec4Swizzles};
use obvhs::aabb::Aabb;

/// The next number down and up: single precision sums are at most half of that away.
pub(crate) fn widened(low: Vec3, high: Vec3) -> Aabb {
    let low = Vec3::new(low.x.next_down(), low.y.next_down(), low.z.next_down());
    let high = Vec3::new(high.x.next_up(), high.y.next_up(), high.z.next_up());
    Aabb::new(low.into(), high.into())
}

/// Round a segment between two stored points.
pub(crate) fn of_segment(a: Vec4, b: Vec4) -> Aabb {
    let (ra, rb) = (Vec3::splat(a.w.abs()), Vec3::splat(b.w.abs()));
    let low = (a.xyz() - ra).min(b.xyz() - rb);
    let high = (a.xyz() + ra).max(b.xyz() + rb);
    widened(low, high)
}

/// Round a triangle. Its vertices are exact, so only the slab test's own rounding is left to cover.
pub(crate) fn of_triangle(vertices: &[Vec3; 3]) -> Aabb {
    let [a, b, c] = *vertices;
    widened(a.min(b).min(c), a.max(b).max(c))
}
