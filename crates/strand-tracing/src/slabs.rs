//! A ray against four boxes at once.

use glam::{Vec3, Vec4};

use crate::Ray;

/// Rounding of slab distances, three operations' worth on both sides (Ize 2013): no box is missed for it.
const SLAB_ROUNDING: f32 = 1.0 + 4.0 * f32::EPSILON;

/// A distance no box entered at `t` or before can seem beyond, for [`walk`](crate::walk::walk)'s `far`.
pub(crate) fn reach(t: f64) -> f32 {
    (t as f32).next_up() * SLAB_ROUNDING
}

/// What the box test needs of a ray.
pub(crate) struct Slabs {
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    /// 1 where the ray goes down the axis: the high plane is then the near one.
    backwards: [usize; 3],
}

impl Slabs {
    pub(crate) fn new(ray: &Ray) -> Self {
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

    /// Near distances of four boxes and which of them are crossed before `far`; `plane` gives an axis's low
    /// (0) and high (1) planes.
    #[inline(always)]
    pub(crate) fn cross(&self, plane: impl Fn(usize, usize) -> Vec4, far: f32) -> (Vec4, u32) {
        let distance =
            |axis: usize, side: usize| (plane(axis, side & 1) - self.origin[axis]) * self.inverse[axis];
        let [bx, by, bz] = self.backwards;
        let near = distance(0, bx).max(distance(1, by)).max(distance(2, bz).max(Vec4::ZERO));
        let exit = distance(0, 1 - bx).min(distance(1, 1 - by)).min(distance(2, 1 - bz)) * SLAB_ROUNDING;
        (near, near.cmple(exit.min(Vec4::splat(far))).bitmask())
    }
}
