//! The triangles of all objects, their vertices side by side.

use glam::Vec3;

use crate::keys;
use crate::tracks::Tracks;
use crate::{Primitive, TracingError, Triangles};

/// All triangles of all objects.
#[derive(Clone, Debug, Default)]
pub(crate) struct Meshes {
    vertices: Vec<[Vec3; 3]>,
    /// First triangle of every object, then the number of triangles.
    objects: Vec<u32>,
    /// The vertices at further keys.
    tracks: Tracks<[Vec3; 3]>,
}

impl Meshes {
    pub(crate) fn gather(triangles: &[Triangles]) -> Result<Self, TracingError> {
        let mut meshes = Self::default();
        for (object, triangles) in triangles.iter().enumerate() {
            keys::check_vertices(object, triangles)?;
        }
        if triangles.iter().all(|t| t.indices.is_empty()) {
            return Ok(meshes);
        }
        meshes.vertices.reserve_exact(triangles.iter().map(|t| t.indices.len()).sum());
        for (object, triangles) in triangles.iter().enumerate() {
            let first = meshes.vertices.len() as u32;
            meshes.objects.push(first);
            for (triangle, &corners) in triangles.indices.iter().enumerate() {
                meshes.vertices.push(resolve(object, triangle, triangles.positions, corners)?);
            }
            if !triangles.indices.is_empty() && keys::any_moves(triangles.positions, triangles.moved) {
                meshes.tracks.push(first, resolved_keys(object, triangles)?);
            }
        }
        meshes.objects.push(meshes.vertices.len() as u32);
        Ok(meshes)
    }

    pub(crate) fn all(&self) -> &[[Vec3; 3]] {
        &self.vertices
    }

    pub(crate) fn bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<[Vec3; 3]>()
            + self.objects.capacity() * size_of::<u32>()
            + self.tracks.bytes()
    }

    pub(crate) fn tracks(&self) -> &Tracks<[Vec3; 3]> {
        &self.tracks
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

/// The triangles' vertices at every key but the first.
fn resolved_keys(object: usize, triangles: &Triangles) -> Result<Vec<Vec<[Vec3; 3]>>, TracingError> {
    let at_key = |(key, positions): (usize, &&[Vec3])| {
        let corners = triangles.indices.iter().enumerate();
        let vertices = corners.map(|(triangle, &corners)| resolve(object, triangle, positions, corners));
        vertices.collect::<Result<Vec<_>, _>>().map_err(|error| match error {
            TracingError::Vertex { object, vertex, found } => {
                TracingError::MovedVertex { object, key, vertex, found }
            }
            other => other,
        })
    };
    (1..).zip(triangles.moved).map(at_key).collect()
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
