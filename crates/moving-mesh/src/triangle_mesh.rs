//! The mesh itself.

use std::path::Path;

use glam::{Affine3A, Vec3};

use crate::error::Fault;
use crate::{MeshError, gltf_file, obj_file};

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
    /// Reads `.obj`, `.gltf` or `.glb`, told apart by the ending; all meshes of the file become one.
    ///
    /// # Errors
    /// [`MeshError`]: the file cannot be read, breaks its format's rules or uses what is not supported.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let read: fn(&Path) -> Result<TriangleMesh, Fault> = match ending.as_str() {
            "obj" => obj_file::read,
            "gltf" | "glb" => gltf_file::read,
            _ => {
                return Err(MeshError::Unsupported {
                    path: path.to_owned(),
                    what: format!("the ending `.{ending}`"),
                    remedy: "use .obj, .gltf or .glb",
                });
            }
        };
        read(path).and_then(TriangleMesh::checked).map_err(|fault| fault.in_file(path))
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

    /// Adds another mesh; normals stay only when both have them.
    pub(crate) fn append(&mut self, mut other: TriangleMesh) -> Result<(), Fault> {
        let too_many = || Fault::Unsupported {
            what: "a mesh of more than 4,294,967,295 vertices".into(),
            remedy: "split it",
        };
        let total = self.positions.len() + other.positions.len();
        u32::try_from(total).map_err(|_| too_many())?;
        let base = self.positions.len() as u32;
        let had_none = self.positions.is_empty();
        self.normals = match (self.normals.take(), other.normals.take()) {
            (None, normals) if had_none => normals,
            (Some(mut mine), Some(theirs)) => {
                mine.extend(theirs);
                Some(mine)
            }
            _ => None,
        };
        self.positions.append(&mut other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + base)));
        Ok(())
    }

    fn checked(self) -> Result<Self, Fault> {
        if let Some(i) = self.positions.iter().position(|p| !p.is_finite()) {
            return Err(Fault::invalid(
                format!("vertex {i}"),
                format!("position {} is not finite, expected numbers", self.positions[i]),
            ));
        }
        let count = self.positions.len();
        if let Some(i) = self.triangles.iter().position(|t| t.iter().any(|&v| v as usize >= count)) {
            return Err(Fault::invalid(
                format!("triangle {i}"),
                format!("vertex indices {:?}, expected below the vertex count {count}", self.triangles[i]),
            ));
        }
        if self.triangles.is_empty() {
            return Err(Fault::invalid("mesh", "no triangles, expected at least one"));
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(normals: bool) -> TriangleMesh {
        TriangleMesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            normals: normals.then(|| vec![Vec3::Z; 3]),
        }
    }

    #[test]
    fn normals_survive_only_where_all_have_them() {
        for (first, second) in [(true, true), (true, false), (false, true), (false, false)] {
            let mut mesh = TriangleMesh::default();
            mesh.append(triangle(first)).unwrap();
            mesh.append(triangle(second)).unwrap();
            assert_eq!(mesh.normals.map(|n| n.len()), (first && second).then_some(6));
            assert_eq!(mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
        }
    }

    #[test]
    fn normals_stay_perpendicular_under_a_stretch() {
        let mut mesh = triangle(true);
        mesh.positions[2] = Vec3::new(0.0, 1.0, 1.0);
        let n = (mesh.positions[1]).cross(mesh.positions[2]).normalize();
        mesh.normals = Some(vec![n; 3]);
        mesh.transform(&Affine3A::from_scale(Vec3::new(3.0, 0.5, 2.0)));
        let edge = mesh.positions[2] - mesh.positions[0];
        assert!(mesh.normals.unwrap()[0].dot(edge).abs() < 1e-6);
    }
}
