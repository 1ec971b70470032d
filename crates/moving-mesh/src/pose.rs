//! Where the vertices of a mesh are at one time.

use glam::{DVec3, Vec3};

use crate::TriangleMesh;

/// Positions, and normals when the mesh has them. Which triangles they make never changes.
///
/// Positions are `f64`: a character that stands far from the origin keeps its shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// One a vertex, in the mesh's own units, finite.
    pub positions: Vec<DVec3>,
    /// Of length 1 (zero where the surface has none), one a vertex, when the file has them for every vertex.
    pub normals: Option<Vec<Vec3>>,
}

impl From<&TriangleMesh> for Pose {
    fn from(mesh: &TriangleMesh) -> Self {
        Pose {
            positions: mesh.positions.iter().map(|p| p.as_dvec3()).collect(),
            normals: mesh.normals.clone(),
        }
    }
}
