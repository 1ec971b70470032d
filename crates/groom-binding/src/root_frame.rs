//! The frame of a surface at a root, and the motion from one to another.

use glam::{DMat3, DQuat, DVec2, DVec3};

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

/// What a triangle is like at rest: enough to tell how it is turned later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Facing {
    /// Whether the triangle faces as its vertices' normals do.
    outwards: bool,
    /// What takes the two edges from the first vertex, as complex numbers in the tangent plane, to the mean turn.
    first: DVec2,
    second: DVec2,
}

/// Whether a triangle has an area to speak of, and its area vector, twice as long as the area.
#[inline]
fn area([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let longest = ab.length_squared().max(ac.length_squared()).max(bc.length_squared());
    let area = ab.cross(ac);
    // Written so that nothing, whose square vanishes too, has none.
    (area.length_squared() > (COLLAPSED * longest).powi(2)).then_some(area)
}

/// Whether a triangle has an area to speak of.
pub(crate) fn has_area(corners: [DVec3; 3]) -> bool {
    area(corners).is_some()
}

/// The normal at a place of a triangle: the vertices' normals weighted, the triangle's own where those cancel.
#[inline]
fn normal_at(area: DVec3, normals: [DVec3; 3], weights: DVec3) -> DVec3 {
    let sum = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
    let length = sum.length();
    if length > CANCELLED { sum * length.recip() } else { unit(area) }
}

/// The rotation of the surface at a place of the rest pose, and what tells it at others: y is the normal, x the
/// triangle's first edge without its part along it (Gram and Schmidt). `None` where the triangle has no area or the
/// edge stands on it.
pub(crate) fn rest_turn(corners: [DVec3; 3], normals: [DVec3; 3], weights: DVec3) -> Option<(DQuat, Facing)> {
    let area = area(corners)?;
    let normal = normal_at(area, normals, weights);
    let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
    let edge = unit(ab);
    let across = edge - edge.dot(normal) * normal;
    let length = across.length();
    if length.is_nan() || length <= STEEP {
        return None;
    }
    let tangent = across / length;
    let side = tangent.cross(normal);
    let flat = |edge: DVec3| DVec2::new(edge.dot(tangent), edge.dot(side));
    let (ab, ac) = (flat(ab), flat(ac));
    // A map z -> p z + q conj(z) that takes the edges there to those of a pose has
    // p = (later ab conj(ac) - later ac conj(ab)) / (ab conj(ac) - ac conj(ab)), and that denominator is imaginary.
    let denominator = 2.0 * (ab.y * ac.x - ab.x * ac.y);
    let over_imaginary = |z: DVec2| DVec2::new(z.y, -z.x) / denominator;
    let conjugate = |z: DVec2| DVec2::new(z.x, -z.y);
    let (first, second) = (over_imaginary(conjugate(ac)), -over_imaginary(conjugate(ab)));
    if !(first.is_finite() && second.is_finite()) {
        return None;
    }
    let rotation = DQuat::from_mat3(&DMat3::from_cols(tangent, normal, side));
    Some((rotation, Facing { outwards: area.dot(normal) >= 0.0, first, second }))
}

/// The rotation of the surface at the same place of another pose. `None` where the triangle has no area, or is turned
/// over against its vertices' normals as it was not at rest.
///
/// The tangent is where the triangle's mean turn takes that of the rest pose: the rotation in the tangent plane
/// nearest to what the triangle does there (the polar decomposition, which for two dimensions is the `p` of
/// z -> p z + q conj(z)). It is there for every triangle that is not turned over, however thin; a single edge would
/// turn further than the skin where the skin shears.
#[inline]
pub(crate) fn pose_turn(
    corners: [DVec3; 3],
    normals: [DVec3; 3],
    weights: DVec3,
    facing: &Facing,
    mirrored: bool,
) -> Option<DQuat> {
    let area = area(corners)?;
    let normal = normal_at(area, normals, weights);
    if (area.dot(normal) >= 0.0) != facing.outwards {
        return None;
    }
    // A mirror turns the triangles' sides round, and the sense of turns: outside is where it was.
    let (normal, sense) = if mirrored { (-normal, -1.0) } else { (normal, 1.0) };
    let x = normal.any_orthonormal_vector();
    let y = sense * x.cross(normal);
    let flat = |edge: DVec3| DVec2::new(edge.dot(x), edge.dot(y));
    let (ab, ac) = (flat(corners[1] - corners[0]), flat(corners[2] - corners[0]));
    let turn = facing.first.rotate(ab) + facing.second.rotate(ac);
    let length = turn.length();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let tangent = (turn.x * x + turn.y * y) * length.recip();
    Some(DQuat::from_mat3(&DMat3::from_cols(tangent, normal, tangent.cross(normal))))
}
