//! The mesh itself.

use std::path::Path;

use glam::{Affine3A, Vec3};

use crate::{AnimationChoice, MeshError, MeshOptions, MovingMesh, RestPose};

/// Triangles in one coordinate system, Y up and in metres where the file follows its format's custom
/// (glTF always does; an OBJ file says neither and keeps its numbers).
///
/// After [`TriangleMesh::open`] every index is in range and every position finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Vertex indices, three a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals, one a vertex, when the file has them for every vertex.
    pub normals: Option<Vec<Vec3>>,
}

impl TriangleMesh {
    /// Reads what [`MovingMesh`] reads, as the file stands without any animation.
    ///
    /// # Errors
    /// [`MeshError`]: the file cannot be read, breaks its format's rules or uses what is not supported.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, MeshError> {
        let options =
            MeshOptions { animation: AnimationChoice::None, rest: RestPose::Nodes, ..MeshOptions::default() };
        let mesh = MovingMesh::open(path, &options)?;
        Ok(mesh.to_triangle_mesh(mesh.rest()))
    }

    /// Moves the mesh: positions by `placement`, normals by its inverse transpose.
    pub fn transform(&mut self, placement: &Affine3A) {
        let normal_matrix = placement.matrix3.inverse().transpose();
        for p in &mut self.positions {
            *p = placement.transform_point3(*p);
        }
        for n in self.normals.iter_mut().flatten() {
            *n = Vec3::from(normal_matrix * glam::Vec3A::from(*n)).normalize_or_zero();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> TriangleMesh {
        TriangleMesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            normals: Some(vec![Vec3::Z; 3]),
        }
    }

    #[test]
    fn normals_stay_perpendicular_under_a_stretch() {
        let mut mesh = triangle();
        mesh.positions[2] = Vec3::new(0.0, 1.0, 1.0);
        let n = (mesh.positions[1]).cross(mesh.positions[2]).normalize();
        mesh.normals = Some(vec![n; 3]);
        mesh.transform(&Affine3A::from_scale(Vec3::new(3.0, 0.5, 2.0)));
        let edge = mesh.positions[2] - mesh.positions[0];
        assert!(mesh.normals.unwrap()[0].dot(edge).abs() < 1e-6);
    }
}
