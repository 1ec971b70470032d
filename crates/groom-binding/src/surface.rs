//! What strands are bound to.

use glam::{DVec3, Vec2};
use moving_mesh::{MovingMesh, Pose};

use crate::BindingError;

/// Triangles in the pose the strands were made for: what strands are bound to and carried by.
///
/// Borrowed: a program reads its mesh once and lends it to the binding and to whatever carries.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// Vertex numbers, three a triangle, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// The rest pose. Its normals are not used: frames take the normals of the triangles, so that rest and
    /// later poses are told by the same rule.
    pub rest: &'a Pose,
    /// Texture coordinates, one a vertex, V upwards.
    pub uvs: Option<&'a [Vec2]>,
}

impl<'a> Surface<'a> {
    /// The triangles of a mesh, and the pose that it calls its rest.
    #[must_use]
    pub fn of(mesh: &'a MovingMesh) -> Self {
        Surface { triangles: mesh.triangles(), rest: mesh.rest(), uvs: mesh.uvs() }
    }
}

impl Surface<'_> {
    /// Whether every triangle has its vertices, every position is finite and there is a coordinate a vertex.
    pub(crate) fn check(&self) -> Result<(), BindingError> {
        let count = self.rest.positions.len();
        let out_of_range = |t: &&[u32; 3]| t.iter().any(|&v| v as usize >= count);
        if let Some(triangle) = self.triangles.iter().position(|t| out_of_range(&t)) {
            let found = format!("vertices {:?}", self.triangles[triangle]);
            return Err(BindingError::invalid(
                format!("triangle {triangle}"),
                found,
                format!("less than {count}"),
            ));
        }
        check_finite(self.rest)?;
        match self.uvs {
            Some(uvs) if uvs.len() != count => Err(BindingError::invalid(
                "texture coordinates",
                format!("{} of them", uvs.len()),
                format!("one a vertex: {count}"),
            )),
            _ => Ok(()),
        }
    }

    /// Refuses a pose of another mesh, or one that holds no place.
    pub(crate) fn check_pose(&self, pose: &Pose) -> Result<(), BindingError> {
        let (found, expected) = (pose.positions.len(), self.rest.positions.len());
        if found != expected {
            let expected = format!("as many as at rest: {expected}");
            return Err(BindingError::invalid("pose", format!("{found} vertices"), expected));
        }
        check_finite(pose)
    }

    /// The vertices of triangle `triangle` at `positions`.
    #[inline]
    pub(crate) fn corners(&self, positions: &[DVec3], triangle: u32) -> [DVec3; 3] {
        corners(positions, self.triangles[triangle as usize])
    }

    /// The diagonal of the box round the rest pose, in its units: what "the size of the mesh" means. 0 without
    /// vertices.
    #[must_use]
    pub fn size(&self) -> f64 {
        let (low, high) = bounds(self.rest.positions.iter().copied());
        if low.x <= high.x { low.distance(high) } else { 0.0 }
    }
}

/// Where the vertices of a triangle are. (Written out, as `map` on an array is a call for each in hot loops.)
#[inline]
pub(crate) fn corners(positions: &[DVec3], [a, b, c]: [u32; 3]) -> [DVec3; 3] {
    [positions[a as usize], positions[b as usize], positions[c as usize]]
}

/// The box round points; an empty one is upside down.
pub(crate) fn bounds(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    let empty = (DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY));
    points.fold(empty, |(low, high), p| (low.min(p), high.max(p)))
}

fn check_finite(pose: &Pose) -> Result<(), BindingError> {
    match pose.positions.iter().position(|p| !p.is_finite()) {
        Some(vertex) => {
            let found = format!("{}", pose.positions[vertex]);
            Err(BindingError::invalid(format!("vertex {vertex}"), found, "finite numbers"))
        }
        None => Ok(()),
    }
}
