//! Which side of a mesh a place is on.
//!
//! The nearest point may lie inside a triangle, on an edge or on a vertex, and only in the first case does the
//! triangle's own normal tell inside from outside. On an edge the sum of the two triangles' normals does, on a vertex
//! the sum of all around it, each weighted by its angle there (Baerentzen, Aanaes: Signed Distance Computation Using the
//! Angle Weighted Pseudonormal, IEEE TVCG 11, 2005).

use std::collections::HashMap;

use glam::DVec3;

use crate::Surface;
use crate::vertex_normals::unit;

/// Edges and vertices of a mesh. Vertices at one place at rest are one, however sharp the corner is that they make: the
/// sums are over all that meets there. (The two sides of a leaf without thickness, which meet everywhere, have no inside
/// by this rule or any other.)
#[derive(Clone, Debug)]
pub(crate) struct Features {
    /// For every triangle the vertices that its own stand for.
    corners: Vec<[u32; 3]>,
    /// For every triangle its edges, each opposite to the vertex of that place.
    edges: Vec<[u32; 3]>,
    edge_count: usize,
    vertex_count: usize,
}

impl Features {
    pub(crate) fn of(surface: &Surface<'_>) -> Self {
        let mut first_at = HashMap::with_capacity(surface.rest.positions.len());
        // Adding nothing makes the two zeros one.
        let key = |place: &DVec3| place.to_array().map(|x| (x + 0.0).to_bits());
        let same: Vec<u32> =
            (0..).zip(&surface.rest.positions).map(|(i, p)| *first_at.entry(key(p)).or_insert(i)).collect();
        let corners: Vec<[u32; 3]> =
            surface.triangles.iter().map(|triangle| triangle.map(|vertex| same[vertex as usize])).collect();
        let mut numbers = HashMap::with_capacity(corners.len() * 3 / 2);
        let mut number = |a: u32, b: u32| {
            let next = numbers.len() as u32;
            *numbers.entry((a.min(b), a.max(b))).or_insert(next)
        };
        let edges = corners.iter().map(|&[a, b, c]| [number(b, c), number(c, a), number(a, b)]).collect();
        Features { corners, edges, edge_count: numbers.len(), vertex_count: surface.rest.positions.len() }
    }

    /// The normals of all features when the vertices are at `positions`.
    pub(crate) fn normals(&self, triangles: &[[u32; 3]], positions: &[DVec3]) -> PseudoNormals<'_> {
        let mut normals = PseudoNormals {
            features: self,
            faces: Vec::with_capacity(triangles.len()),
            edges: vec![DVec3::ZERO; self.edge_count],
            vertices: vec![DVec3::ZERO; self.vertex_count],
        };
        for ((triangle, corners), edges) in triangles.iter().zip(&self.corners).zip(&self.edges) {
            let places = triangle.map(|vertex| positions[vertex as usize]);
            let [a, b, c] = places;
            // Nothing, where the triangle has no area: it does not count.
            let face = unit((b - a).cross(c - a));
            normals.faces.push(face);
            for k in 0..3 {
                let (here, next, last) = (places[k], places[(k + 1) % 3], places[(k + 2) % 3]);
                normals.edges[edges[k] as usize] += face;
                normals.vertices[corners[k] as usize] += face * angle(next - here, last - here);
            }
        }
        normals
    }
}

/// The normals of all features at one pose, of any length.
pub(crate) struct PseudoNormals<'a> {
    features: &'a Features,
    faces: Vec<DVec3>,
    edges: Vec<DVec3>,
    vertices: Vec<DVec3>,
}

impl PseudoNormals<'_> {
    /// The normal at the place of a triangle that has these weights: that of the triangle, of the edge where one
    /// weight is nothing, of the vertex where two are.
    pub(crate) fn at(&self, triangle: u32, weights: DVec3) -> DVec3 {
        let triangle = triangle as usize;
        let weights = weights.to_array();
        let mut nothing = (0..3).filter(|&k| weights[k] == 0.0);
        match (nothing.next(), nothing.next()) {
            (None, _) => self.faces[triangle],
            (Some(opposite), None) => self.edges[self.features.edges[triangle][opposite] as usize],
            (Some(first), Some(second)) => {
                self.vertices[self.features.corners[triangle][(3 - first - second) % 3] as usize]
            }
        }
    }
}

/// The angle between two edges; nothing where one has no length.
fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
