//! The places of a mesh by which the space around it is deformed.

use glam::DVec3;

/// A mesh flatter than this, in parts of its width, gets anchors over its skin as well.
const FLAT: f64 = 0.05;

/// Anchors closer than this, in parts of the mesh's size, would be one place seen twice.
const APART: f64 = 1e-3;

/// Some vertices of a mesh, far from each other, and where they are at rest.
///
/// Chosen by farthest-point sampling over the vertices that triangles use: each as far as can be from those before,
/// so that few cover all of the mesh, as Unreal Engine's groom binding does. A sheet without thickness does not say
/// how the space beside it turns; there each vertex is joined by a place over it, along its normal.
#[derive(Clone, Debug)]
pub(crate) struct Anchors {
    vertices: Vec<u32>,
    /// For places over the skin: the triangles around each vertex and how far over.
    over: Option<(Vec<Vec<[u32; 3]>>, f64)>,
    pub(crate) rest: Vec<DVec3>,
}

impl Anchors {
    /// Up to `count` anchors; indices beyond the positions are left out.
    pub(crate) fn new(rest: &[DVec3], triangles: &[[u32; 3]], count: usize) -> Self {
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        used.retain(|&v| rest.get(v as usize).is_some_and(|p| p.is_finite()));
        let place = |v: u32| rest[v as usize];
        let mut vertices = farthest(&used, place, count);
        let flatness = flatness(&vertices.iter().map(|&v| place(v)).collect::<Vec<_>>());
        if flatness >= FLAT {
            let rest = vertices.iter().map(|&v| place(v)).collect();
            return Anchors { vertices, over: None, rest };
        }
        vertices.truncate(count.div_ceil(2));
        let around: Vec<Vec<[u32; 3]>> = vertices
            .iter()
            .map(|v| triangles.iter().filter(|triangle| triangle.contains(v)).copied().collect())
            .collect();
        let spacing = vertices.last().map_or(0.0, |&last| {
            let others = vertices.iter().filter(|&&v| v != last);
            others.map(|&v| place(v).distance(place(last))).fold(f64::INFINITY, f64::min)
        });
        let mut anchors = Anchors { vertices, over: Some((around, spacing)), rest: Vec::new() };
        anchors.rest = anchors.at(rest);
        anchors
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.rest.len()
    }

    /// Where the anchors are when the vertices are at `positions`.
    pub(crate) fn at(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let place = |v: u32| positions.get(v as usize).copied().unwrap_or_default();
        let mut places: Vec<DVec3> = self.vertices.iter().map(|&v| place(v)).collect();
        if let Some((around, height)) = &self.over {
            for (&vertex, triangles) in self.vertices.iter().zip(around) {
                let normal: DVec3 = triangles
                    .iter()
                    .map(|triangle| triangle.map(place))
                    .map(|[a, b, c]| (b - a).cross(c - a))
                    .sum();
                // Where the skin has shrunk to nothing, so has what is over it.
                places.push(place(vertex) + normal.normalize_or_zero() * *height);
            }
        }
        places
    }
}

/// Up to `count` of `from`, each the farthest from those before; the first is the farthest from the middle.
fn farthest(from: &[u32], place: impl Fn(u32) -> DVec3, count: usize) -> Vec<u32> {
    if from.is_empty() {
        return Vec::new();
    }
    let middle = from.iter().map(|&v| place(v)).sum::<DVec3>() / from.len() as f64;
    let mut distances: Vec<f64> = from.iter().map(|&v| place(v).distance_squared(middle)).collect();
    let lonely = |distances: &[f64]| {
        let later = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]).then(b.cmp(a));
        (0..distances.len()).max_by(later).unwrap_or(0)
    };
    let mut next = lonely(&distances);
    let least = APART * APART * distances[next];
    distances.fill(f64::INFINITY);
    let mut chosen = Vec::new();
    while chosen.len() < count && distances[next] > least {
        chosen.push(from[next]);
        let new = place(from[next]);
        for (distance, &v) in distances.iter_mut().zip(from) {
            *distance = distance.min(place(v).distance_squared(new));
        }
        next = lonely(&distances);
    }
    chosen
}

/// How far places are from lying in a plane, as a part of how far apart they are.
fn flatness(places: &[DVec3]) -> f64 {
    let Some(&first) = places.first() else { return 0.0 };
    let far = |measure: &dyn Fn(DVec3) -> f64| {
        places
            .iter()
            .map(|&p| (measure(p - first), p - first))
            .fold((0.0, DVec3::ZERO), |most, next| if next.0 > most.0 { next } else { most })
    };
    let (width, along) = far(&|d| d.length());
    let along = along.normalize_or_zero();
    let (_, aside) = far(&|d| d.reject_from_normalized(along).length());
    let normal = along.cross(aside).normalize_or_zero();
    let (height, _) = far(&|d| d.dot(normal).abs());
    if width > 0.0 { height / width } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    fn sheet(side: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let place = |i: u32| dvec3(f64::from(i % side), 0.0, f64::from(i / side));
        let square = |i: u32| [[i, i + side, i + 1], [i + 1, i + side, i + side + 1]];
        let corners = (0..side * (side - 1)).filter(|i| i % side + 1 < side);
        ((0..side * side).map(place).collect(), corners.flat_map(square).collect())
    }

    #[test]
    fn a_sheet_gets_anchors_over_it() {
        let (positions, triangles) = sheet(12);
        let anchors = Anchors::new(&positions, &triangles, 40);
        assert_eq!(anchors.len(), 40);
        assert_eq!(anchors.rest.iter().filter(|p| p.y > 0.5).count(), 20);
        // Collapsed to a point, all are that point.
        assert!(anchors.at(&vec![DVec3::ONE; 144]).iter().all(|&p| p == DVec3::ONE));
    }

    #[test]
    fn anchors_are_vertices_in_use_and_far_apart() {
        let (mut positions, triangles) = sheet(12);
        for p in &mut positions {
            p.y = 0.3 * (p.x - 5.0).powi(2);
        }
        positions.push(dvec3(1e9, 0.0, 0.0)); // in no triangle
        let anchors = Anchors::new(&positions, &triangles, 30);
        assert_eq!(anchors.len(), 30);
        assert!(anchors.rest.iter().all(|p| p.x < 100.0));
        for (i, a) in anchors.rest.iter().enumerate() {
            assert!(anchors.rest[..i].iter().all(|b| a.distance(*b) > 1.0));
        }
    }

    #[test]
    fn doubles_are_seen_once() {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::Y, DVec3::Z, DVec3::splat(f64::NAN)];
        let triangles = [[0, 1, 3], [0, 2, 4], [0, 4, 5], [0, 1, 99]];
        assert_eq!(Anchors::new(&positions, &triangles, 100).len(), 4);
        assert_eq!(Anchors::new(&[], &[], 100).len(), 0);
    }
}
