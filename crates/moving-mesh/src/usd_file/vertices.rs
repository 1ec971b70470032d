//! Which corners of faces are one vertex.

use std::collections::HashMap;

use super::primvar::Corner;

/// A vertex is one point with one texture coordinate and one normal, by their bits.
pub(super) type Key = (u32, [u32; 2], [u32; 3]);

/// Every point a vertex, used or not (those who know the file know their numbers), and the triangles of them.
pub(super) fn points(
    count: usize,
    corners: &[Corner],
    triangles: &[[u32; 3]],
) -> (Vec<Corner>, Vec<[u32; 3]>) {
    let mut vertices: Vec<Corner> =
        (0..count as u32).map(|point| Corner { corner: 0, point, face: 0 }).collect();
    for corner in corners.iter().rev() {
        vertices[corner.point as usize] = *corner;
    }
    let point = |corner: u32| corners[corner as usize].point;
    (vertices, triangles.iter().map(|triangle| triangle.map(point)).collect())
}

/// A vertex for every key, and the triangles of vertices; vertices are in the order in which corners meet them.
pub(super) fn apart(
    corners: &[Corner],
    triangles: &[[u32; 3]],
    key: impl Fn(&Corner) -> Key,
) -> (Vec<Corner>, Vec<[u32; 3]>) {
    let mut known: HashMap<Key, u32> = HashMap::new();
    let mut vertices = Vec::new();
    let numbers: Vec<u32> = corners
        .iter()
        .map(|corner| {
            *known.entry(key(corner)).or_insert_with(|| {
                vertices.push(*corner);
                vertices.len() as u32 - 1
            })
        })
        .collect();
    let number = |corner: u32| numbers[corner as usize];
    (vertices, triangles.iter().map(|triangle| triangle.map(number)).collect())
}
