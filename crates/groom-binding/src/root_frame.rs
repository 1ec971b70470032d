//! The frame of a surface at a root, and the motion from one to another.

use glam::{DMat3, DQuat, DVec3};

use crate::vertex_normals::unit;

/// Where a root is on the surface, and which way the surface is turned there.
///
/// The rotation takes x to the tangent, y to the normal and z to tangent x normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootFrame {
    /// The root's place on the surface, in the mesh's units.
    pub origin: DVec3,
    /// A unit quaternion.
    pub rotation: DQuat,
}

impl RootFrame {
    /// The motion that takes this frame to `to`: what is carried rigidly makes it. `mirrored`: the surface is
    /// mirrored at `to`, and the motion is a rotation after a mirror, which takes a mesh to its mirror image exactly.
    #[inline]
    #[must_use]
    pub fn motion_to(&self, to: &RootFrame, mirrored: bool) -> RigidMotion {
        let turn = if mirrored {
            let mirror = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
            DMat3::from_quat(to.rotation) * mirror * DMat3::from_quat(self.rotation.conjugate())
        } else {
            DMat3::from_quat(to.rotation * self.rotation.conjugate())
        };
        RigidMotion { from: self.origin, turn, to: to.origin }
    }
}

/// A motion that keeps all lengths: `point` goes to `to + turn * (point - from)`.
///
/// Differences are taken before and sums after the turn, all in f64: where the place is far from the origin, a
/// strand loses no digits of its shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    /// A place before.
    pub from: DVec3,
    /// A rotation, or one after a mirror.
    pub turn: DMat3,
    /// The same place after.
    pub to: DVec3,
}

impl RigidMotion {
    /// Where a point goes.
    #[inline]
    #[must_use]
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.turn * (point - self.from) + self.to
    }
}

/// A triangle whose area is less than this share of its longest edge's square has none.
const COLLAPSED: f64 = 1e-9;

/// Weighted normals that cancel to less than this say nothing; the triangle's own is taken.
const CANCELLED: f64 = 1e-3;

/// A tangent whose part across the normal is less than this share of it has no direction.
const STEEP: f64 = 1e-6;

/// The surface's turn at a place of a triangle, and which way the triangle faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    pub(crate) rotation: DQuat,
    /// Whether the triangle faces as its vertices' normals do.
    pub(crate) faces_out: bool,
}

/// Whether a triangle has an area to speak of.
pub(crate) fn has_area([a, b, c]: [DVec3; 3]) -> bool {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let longest = ab.length_squared().max(ac.length_squared()).max(bc.length_squared());
    // Written so that nothing, whose square vanishes too, has none.
    ab.cross(ac).length() > COLLAPSED * longest
}

/// The turn of the surface at a place: the normal is the vertices' normals weighted, the tangent the triangle's
/// first edge without its part along the normal. `None` where the triangle has no area or either no direction.
///
/// The first edge of a triangle is the same edge at every pose, so the tangent turns with the skin; a gradient of
/// texture coordinates would do the same where there are any, and nothing where there are none.
#[inline]
pub(crate) fn turn_at(
    corners: [DVec3; 3],
    normals: [DVec3; 3],
    weights: DVec3,
    mirrored: bool,
) -> Option<Turn> {
    if !has_area(corners) {
        return None;
    }
    let edge = unit(corners[1] - corners[0]);
    let own = unit(edge.cross(unit(corners[2] - corners[0])));
    let sum = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
    let length = sum.length();
    let normal = if length > CANCELLED { sum / length } else { own };
    // A mirror turns the triangles' sides round: outside is where it was.
    let outside = if mirrored { -normal } else { normal };
    let rotation = axes(edge, outside)?;
    Some(Turn { rotation, faces_out: own.dot(normal) >= 0.0 })
}

/// Gram and Schmidt: the rotation to a unit normal and the tangent nearest to a unit edge.
fn axes(edge: DVec3, normal: DVec3) -> Option<DQuat> {
    let across = edge - edge.dot(normal) * normal;
    let length = across.length();
    if length.is_nan() || length <= STEEP {
        return None;
    }
    let tangent = across / length;
    let rotation = DMat3::from_cols(tangent, normal, tangent.cross(normal));
    Some(DQuat::from_mat3(&rotation).normalize())
}
