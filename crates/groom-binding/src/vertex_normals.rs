//! Normals of a mesh at any pose, by one rule.

use std::cmp::Ordering;

use glam::DVec3;

use crate::Surface;
use crate::surface::corners;

/// How the triangles of a surface share their vertices' normals.
///
/// A vertex's normal is the sum of the area vectors of its triangles, made a unit: triangles without an area
/// count for nothing, and no file's normals are needed, so the rest pose and every later one are told alike.
/// Vertices that a file repeats at one place, for a seam of texture coordinates say, share one normal; those that
/// lie on each other back to back, as the two sides of a leaf do, keep their own.
#[derive(Clone, Debug)]
pub(crate) struct VertexNormals {
    /// For every vertex the one that it shares its normal with, itself for most.
    shared: Vec<u32>,
}

impl VertexNormals {
    pub(crate) fn of(surface: &Surface<'_>) -> Self {
        let positions = &surface.rest.positions;
        let mut shared: Vec<u32> = (0..positions.len() as u32).collect();
        let mut order = shared.clone();
        let place = |&vertex: &u32| positions[vertex as usize].to_array();
        let compare = |a: &u32, b: &u32| {
            let ordering = place(a).into_iter().zip(place(b)).map(|(x, y)| x.partial_cmp(&y));
            ordering.flatten().find(|o| o.is_ne()).unwrap_or(Ordering::Equal).then(a.cmp(b))
        };
        order.sort_unstable_by(compare);
        let mut own = None;
        for group in order.chunk_by(|a, b| place(a) == place(b)).filter(|group| group.len() > 1) {
            let own = own.get_or_insert_with(|| area_sums(surface.triangles, positions, &shared));
            let mut openers: Vec<u32> = Vec::new();
            for &vertex in group {
                let agrees = |&&other: &&u32| own[vertex as usize].dot(own[other as usize]) > 0.0;
                match openers.iter().find(agrees) {
                    Some(&opener) => shared[vertex as usize] = opener,
                    None => openers.push(vertex),
                }
            }
        }
        VertexNormals { shared }
    }

    /// The unit normals at `positions`, to be read by [`VertexNormals::at`]; zero where the triangles round a
    /// vertex have no area or face away from each other evenly.
    pub(crate) fn at_pose(&self, triangles: &[[u32; 3]], positions: &[DVec3]) -> PoseNormals<'_> {
        let mut sums = area_sums(triangles, positions, &self.shared);
        for sum in &mut sums {
            *sum = unit(*sum);
        }
        PoseNormals { shared: &self.shared, normals: sums }
    }
}

/// The normals of one pose.
pub(crate) struct PoseNormals<'a> {
    shared: &'a [u32],
    normals: Vec<DVec3>,
}

impl PoseNormals<'_> {
    /// The normal of a vertex.
    #[inline]
    fn at(&self, vertex: u32) -> DVec3 {
        self.normals[self.shared[vertex as usize] as usize]
    }

    /// The normals of a triangle's vertices.
    #[inline]
    pub(crate) fn at_corners(&self, [a, b, c]: [u32; 3]) -> [DVec3; 3] {
        [self.at(a), self.at(b), self.at(c)]
    }
}

/// Sums of area vectors at the vertices that share; zero at the others.
fn area_sums(triangles: &[[u32; 3]], positions: &[DVec3], shared: &[u32]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = corners(positions, *triangle);
        let area = (b - a).cross(c - a);
        for &vertex in triangle {
            sums[shared[vertex as usize] as usize] += area;
        }
    }
    sums
}

/// A vector made a unit whatever its length; zero stays zero.
#[inline]
pub(crate) fn unit(v: DVec3) -> DVec3 {
    let length_squared = v.length_squared();
    if length_squared > 1e-200 && length_squared < 1e200 {
        return v * length_squared.sqrt().recip();
    }
    // The square of a tiny or huge length is no number: scaled first.
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { (v / largest).normalize_or_zero() } else { DVec3::ZERO }
}
