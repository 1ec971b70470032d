//! Where one strand is bound.

use glam::DVec3;

use crate::RootFrame;
use crate::root_frame::Facing;

/// Where one strand is bound, and how the surface was there when it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// The triangle's number.
    pub triangle: u32,
    /// The weights of the triangle's vertices: the root's place in it. None is negative, and they sum to 1.
    pub barycentrics: DVec3,
    /// The root's distance from its place, in the mesh's units: positive on the side that the surface's normal
    /// points to.
    ///
    /// It is kept at every pose, and more: the root's offset from its place, seen in the frame there, is. For a
    /// nearest point inside a triangle that offset is along the triangle's perpendicular; on edges and borders,
    /// and for places given otherwise, it has a part along the surface, which is kept as well.
    pub height: f64,
    /// The frame of the surface at the place, at rest. What is carried goes with the motion from this frame to
    /// that of a pose. The origin of a snapped strand's is its root, so that the root lands on the surface.
    pub rest: RootFrame,
    /// What tells the triangle's turn at other poses; `None`: it had no frame, and `rest` is turned anyhow.
    pub(crate) facing: Option<Facing>,
}

/// The point of a triangle that has these weights.
#[inline]
pub(crate) fn place([a, b, c]: [DVec3; 3], barycentrics: DVec3) -> DVec3 {
    // By differences, which stay exact far from the origin.
    a + barycentrics.y * (b - a) + barycentrics.z * (c - a)
}
