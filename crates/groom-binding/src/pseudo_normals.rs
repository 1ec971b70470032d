//! Which side of a mesh a place is on.
//!
//! The nearest point may lie inside a triangle, on an edge or on a vertex, and only in the first case does the
//! triangle's own normal tell inside from outside. On an edge the sum of the two triangles' normals does, on a vertex
//! the sum of all around it, each weighted by its angle there (Baerentzen, Aanaes: Signed Distance Computation Using the
//! Angle Weighted Pseudonormal, IEEE TVCG 11, 2005). Where the mesh ends no normal does: what is nearest to a border is
//! beside the mesh, not in it.

use std::collections::HashMap;

use glam::DVec3;

use crate::Surface;
use crate::root_frame::has_area;
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
    /// Whether an edge is the border of an open mesh: one triangle has it.
    edge_on_border: Vec<bool>,
    /// Whether such an edge ends at a vertex.
    vertex_on_border: Vec<bool>,
}

/// What of a mesh a place lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    Face(usize),
    Edge(usize),
    Vertex(usize),
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
        let edges: Vec<[u32; 3]> =
            corners.iter().map(|&[a, b, c]| [number(b, c), number(c, a), number(a, b)]).collect();
        let (edge_on_border, vertex_on_border) = borders(surface, &corners, &edges, numbers.len());
        Features { corners, edges, edge_on_border, vertex_on_border }
    }

    /// What the place of a triangle that has these weights lies on: the triangle, an edge where one weight is nothing, a
    /// vertex where two are.
    pub(crate) fn at(&self, triangle: u32, weights: DVec3) -> Feature {
        let triangle = triangle as usize;
        let weights = weights.to_array();
        let mut nothing = (0..3).filter(|&k| weights[k] == 0.0);
        match (nothing.next(), nothing.next()) {
            (None, _) => Feature::Face(triangle),
            (Some(opposite), None) => Feature::Edge(self.edges[triangle][opposite] as usize),
            (Some(first), Some(second)) => {
                Feature::Vertex(self.corners[triangle][(3 - first - second) % 3] as usize)
            }
        }
    }

    /// Whether the mesh ends there.
    pub(crate) fn is_border(&self, feature: Feature) -> bool {
        match feature {
            Feature::Face(_) => false,
            Feature::Edge(edge) => self.edge_on_border[edge],
            Feature::Vertex(vertex) => self.vertex_on_border[vertex],
        }
    }

    /// The normals of all features when the vertices are at `positions`.
    pub(crate) fn normals(&self, triangles: &[[u32; 3]], positions: &[DVec3]) -> PseudoNormals {
        let mut normals = PseudoNormals {
            faces: Vec::with_capacity(triangles.len()),
            edges: vec![DVec3::ZERO; self.edge_on_border.len()],
            vertices: vec![DVec3::ZERO; self.vertex_on_border.len()],
        };
        for ((triangle, corners), edges) in triangles.iter().zip(&self.corners).zip(&self.edges) {
            let places = triangle.map(|vertex| positions[vertex as usize]);
            let [a, b, c] = places;
            // A triangle without an area does not count: what is left of its normal is rounding.
            let face = if has_area(places) { unit((b - a).cross(c - a)) } else { DVec3::ZERO };
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

/// Which edges and vertices the mesh ends at. Triangles without an area end nothing: they may lie anywhere.
fn borders(
    surface: &Surface<'_>,
    corners: &[[u32; 3]],
    edges: &[[u32; 3]],
    edge_count: usize,
) -> (Vec<bool>, Vec<bool>) {
    let mut uses = vec![0_u32; edge_count];
    edges.as_flattened().iter().for_each(|&edge| uses[edge as usize] += 1);
    let mut edge_on_border = vec![false; edge_count];
    let mut vertex_on_border = vec![false; surface.rest.positions.len()];
    for ((number, corners), edges) in (0..).zip(corners).zip(edges) {
        for k in 0..3 {
            let edge = edges[k] as usize;
            if uses[edge] == 1 && has_area(surface.corners(&surface.rest.positions, number)) {
                edge_on_border[edge] = true;
                vertex_on_border[corners[(k + 1) % 3] as usize] = true;
                vertex_on_border[corners[(k + 2) % 3] as usize] = true;
            }
        }
    }
    (edge_on_border, vertex_on_border)
}

/// The normals of all features at one pose, of any length.
pub(crate) struct PseudoNormals {
    faces: Vec<DVec3>,
    edges: Vec<DVec3>,
    vertices: Vec<DVec3>,
}

impl PseudoNormals {
    /// The normal of a triangle, an edge or a vertex.
    pub(crate) fn of(&self, feature: Feature) -> DVec3 {
        match feature {
            Feature::Face(triangle) => self.faces[triangle],
            Feature::Edge(edge) => self.edges[edge],
            Feature::Vertex(vertex) => self.vertices[vertex],
        }
    }
}

/// The angle between two edges; nothing where one has no length.
fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
