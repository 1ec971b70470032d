//! The triangles of all objects, their vertices side by side.

use glam::Vec3;

use crate::{Primitive, TracingError, Triangles};

/// All triangles of all objects.
#[derive(Clone, Debug, Default)]
pub(crate) struct Meshes {
    vertices: Vec<[Vec3; 3]>,
    /// First triangle of every object, then the number of triangles.
    objects: Vec<u32>,
}

impl Meshes {
    pub(crate) fn gather(triangles: &[Triangles]) -> Result<Self, TracingError> {
        let mut meshes = Self::default();
        if triangles.iter().all(|t| t.indices.is_empty()) {
            return Ok(meshes);
        }
        meshes.vertices.reserve_exact(triangles.iter().map(|t| t.indices.len()).sum());
        for (object, triangles) in triangles.iter().enumerate() {
            meshes.objects.push(meshes.vertices.len() as u32);
            for (triangle, &corners) in triangles.indices.iter().enumerate() {
                meshes.vertices.push(resolve(object, triangle, triangles.positions, corners)?);
            }
        }
        meshes.objects.push(meshes.vertices.len() as u32);
        Ok(meshes)
    }

    pub(crate) fn all(&self) -> &[[Vec3; 3]] {
        &self.vertices
    }

    pub(crate) fn bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<[Vec3; 3]>() + self.objects.capacity() * size_of::<u32>()
    }

    pub(crate) fn primitive(&self, number: u32) -> Primitive {
        let object = self.objects.partition_point(|&first| first <= number).saturating_sub(1);
        let first = self.objects.get(object).copied().unwrap_or(0);
        Primitive::Triangle { object: object as u32, triangle: number - first }
    }

    /// The number of a triangle; none if there is no such triangle.
    pub(crate) fn number(&self, object: u32, triangle: u32) -> Option<u32> {
        let number = self.objects.get(object as usize)?.checked_add(triangle)?;
        (number < *self.objects.get(object as usize + 1)?).then_some(number)
    }
}

fn resolve(
    object: usize,
    triangle: usize,
    positions: &[Vec3],
    corners: [u32; 3],
) -> Result<[Vec3; 3], TracingError> {
    let mut vertices = [Vec3::ZERO; 3];
    for (vertex, found) in vertices.iter_mut().zip(corners) {
        let Some(&position) = positions.get(found as usize) else {
            return Err(TracingError::Index { object, triangle, found, vertices: positions.len() });
        };
        if !position.is_finite() {
            return Err(TracingError::Vertex { object, vertex: found as usize, found: position });
        }
        *vertex = position;
    }
    Ok(vertices)
}
