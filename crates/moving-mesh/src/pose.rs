//! A mesh at one time.

use glam::{DVec3, Vec3};

use crate::TriangleMesh;

/// Where the vertices of a mesh are at one time, in the mesh's units. Which triangles they make never changes.
///
/// Positions are f64, so that a character far from the origin keeps its shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Unit normals, one a vertex, where the file has them.
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
