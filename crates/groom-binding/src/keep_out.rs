//! Strands kept out of the mesh.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use groom::Groom;
use moving_mesh::Pose;
use rayon::prelude::*;

use crate::Surface;
use crate::pseudo_normals::{Features, PseudoNormals};
use crate::strand_blocks::each_strand;
use crate::surface_tree::{Search, SurfaceTree};

/// How often a point is pushed out and put back to its segment's length in turn.
///
/// Each turn at least halves what is missing where the skin is even; what is still inside after these is told.
const TURNS: usize = 8;

/// A point this near to where it should be, in parts of the mesh's size, is there.
const NEAR: f64 = 1e-9;

/// Keeps the points of strands at a distance from a mesh.
#[derive(Clone, Debug)]
pub(crate) struct KeepOut<'a> {
    surface: Surface<'a>,
    features: Features,
    distance: f64,
}

/// What was pushed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pushed {
    /// Points that were moved because they were too near.
    pub(crate) pushed: usize,
    /// Points still inside.
    pub(crate) inside: usize,
    /// How deep the deepest of them is.
    pub(crate) deepest: f64,
}

/// A mesh at one pose, to be asked how far places are from it.
struct Skin<'a> {
    tree: SurfaceTree,
    features: &'a Features,
    normals: PseudoNormals,
    triangles: &'a [[u32; 3]],
    positions: &'a [DVec3],
}

/// A place seen from the skin.
struct Seen {
    /// Under 0 inside.
    distance: f64,
    /// The unit direction away from the skin, in which the distance grows.
    out: DVec3,
}

impl<'a> KeepOut<'a> {
    pub(crate) fn new(surface: Surface<'a>, distance: f64) -> Self {
        KeepOut { surface, features: Features::of(&surface), distance }
    }

    /// Pushes the points of all strands out of the mesh at `pose`, from root to tip; segments keep the lengths they come
    /// with, and roots their places.
    ///
    /// A point keeps `distance` from the skin, or as much of it as its strand is long up to there: a strand has to
    /// rise first. It is taken along the segment's length after the point before it, and pushed out along the
    /// direction in which the distance to the skin grows, in turns ([`TURNS`]). What is nearest to the border of an open
    /// mesh is beside it and never inside. A strand that nothing is done to keeps its points to the bit.
    ///
    /// The tree of triangles is built for every pose: 60,000 triangles that move freely leave no box as it was.
    pub(crate) fn push(&self, groom: &Groom, pose: &Pose, places: &mut [DVec3]) -> Pushed {
        let skin = self.skin(pose);
        let near = NEAR * skin.tree.size();
        let pushed = AtomicUsize::new(0);
        each_strand(groom, [&mut *places], |_, [strand]| {
            let count = self.push_strand(&skin, strand, near);
            pushed.fetch_add(count, Ordering::Relaxed);
        });
        let (inside, deepest) = count_inside(groom, &skin, places, near);
        Pushed { pushed: pushed.into_inner(), inside, deepest }
    }

    fn skin<'s>(&'s self, pose: &'s Pose) -> Skin<'s> {
        let (triangles, positions) = (self.surface.triangles, &pose.positions[..]);
        let corners = |triangle: u32| self.surface.corners(positions, triangle);
        let (tree, normals) = rayon::join(
            || SurfaceTree::of_sound(triangles.len(), corners, corners),
            || self.features.normals(triangles, positions),
        );
        Skin { tree, features: &self.features, normals, triangles, positions }
    }

    /// Pushes the points of one strand; how many were too near.
    fn push_strand(&self, skin: &Skin<'_>, strand: &mut [DVec3], near: f64) -> usize {
        let mut search = Search::default();
        let (mut pushed, mut moved, mut along) = (0, false, 0.0);
        // No point within `free` of `from` can be too near: the distance grows no faster than one goes.
        let (mut from, mut free) = (DVec3::ZERO, f64::NEG_INFINITY);
        let Some(&first) = strand.first() else { return 0 };
        let mut before = first;
        for i in 1..strand.len() {
            let carried = strand[i];
            let segment = carried - before;
            let length = segment.length();
            before = carried;
            along += length;
            let previous = strand[i - 1];
            // As it comes, while nothing before it has moved.
            let mut place = if moved { previous + at_length(carried - previous, segment) } else { carried };
            let needed = self.distance.min(along);
            if place.distance(from) >= free {
                let mut missing = None;
                for _ in 0..TURNS {
                    let Some(seen) = skin.see(place, &mut search) else { break };
                    (from, free) = (place, seen.distance - self.distance);
                    if seen.distance >= needed - near {
                        break;
                    }
                    missing = Some(());
                    let out = place + seen.out * (needed - seen.distance);
                    place = previous + at_length(out - previous, segment);
                }
                if missing.is_some() {
                    (pushed, moved, free) = (pushed + 1, true, f64::NEG_INFINITY);
                }
            }
            strand[i] = place;
        }
        pushed
    }
}

impl Skin<'_> {
    /// How far a place is from the skin, and on which side; none when there is no triangle.
    fn see(&self, place: DVec3, search: &mut Search) -> Option<Seen> {
        let nearest = self.tree.nearest(place, search)?;
        let [a, b, c] =
            self.triangles[nearest.triangle as usize].map(|vertex| self.positions[vertex as usize]);
        let weights = nearest.barycentrics;
        let offset = (place - a) - (b - a) * weights.y - (c - a) * weights.z;
        let feature = self.features.at(nearest.triangle, weights);
        let normal = self.normals.of(feature);
        let distance = offset.length();
        let is_inside = offset.dot(normal) < 0.0 && !self.features.is_border(feature);
        let outwards = if is_inside { -offset } else { offset };
        // On the skin itself there is no direction but its normal.
        let out = if distance > 1e-12 * self.tree.size() {
            outwards / distance
        } else {
            normal.normalize_or_zero()
        };
        Some(Seen { distance: if is_inside { -distance } else { distance }, out })
    }
}

/// As long as `segment` in the direction of `towards`; the segment itself where that is none.
fn at_length(towards: DVec3, segment: DVec3) -> DVec3 {
    towards.try_normalize().map_or(segment, |direction| direction * segment.length())
}

/// How many points but roots are inside, and how deep the deepest is.
fn count_inside(groom: &Groom, skin: &Skin<'_>, places: &[DVec3], near: f64) -> (usize, f64) {
    let strand = |strand: usize| {
        let mut search = Search::default();
        let (mut count, mut deepest) = (0, 0.0_f64);
        let (mut from, mut free) = (DVec3::ZERO, f64::NEG_INFINITY);
        for &place in places[groom.strand_range(strand)].iter().skip(1) {
            if place.distance(from) < free {
                continue;
            }
            let Some(seen) = skin.see(place, &mut search) else { break };
            (from, free) = (place, seen.distance);
            if seen.distance < -near {
                count += 1;
                deepest = deepest.max(-seen.distance);
            }
        }
        (count, deepest)
    };
    let sum = |a: (usize, f64), b: (usize, f64)| (a.0 + b.0, a.1.max(b.1));
    (0..groom.strand_count()).into_par_iter().with_min_len(256).map(strand).reduce(|| (0, 0.0), sum)
}

#[cfg(test)]
mod tests {
    use glam::dvec3;
    use groom::random;

    use super::*;

    /// Inside or outside of a body that no pseudo-normal but the right one tells: four thin and blunt corners, of which
    /// each place is on a known side of four planes. Every triangle has vertices of its own, as files without an index
    /// have them.
    #[test]
    fn the_side_is_right_by_sharp_corners_and_edges() {
        let corners =
            [dvec3(0.0, 0.0, 0.0), dvec3(10.0, 0.1, 0.0), dvec3(9.0, 0.0, 1.0), dvec3(0.4, 3.0, 0.2)];
        let faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
        let outward = |face: [usize; 3]| {
            let [a, b, c] = face.map(|v| corners[v]);
            (a, (b - a).cross(c - a).normalize())
        };
        let middle = corners.iter().sum::<DVec3>() / 4.0;
        assert!(faces.iter().all(|&face| {
            let (a, normal) = outward(face);
            (middle - a).dot(normal) < 0.0
        }));
        let positions: Vec<DVec3> = faces.as_flattened().iter().map(|&v| corners[v]).collect();
        let rest = Pose { positions, normals: None };
        let triangles: Vec<[u32; 3]> = (0..4).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let keep_out = KeepOut::new(Surface { triangles: &triangles, rest: &rest, uvs: None }, 0.1);
        let skin = keep_out.skin(&rest);
        let (mut inside, mut by_corner) = (0, 0);
        for i in 0..20_000 {
            let one = |purpose| f64::from(random(1, i, purpose)) * 2.0 - 1.0;
            // Close to a corner, most of them.
            let near = corners[(i % 4) as usize];
            let place = near + dvec3(one("x"), one("y"), one("z")) * [0.2, 1.0, 5.0][(i % 3) as usize];
            let depth = faces.iter().map(|&face| {
                let (a, normal) = outward(face);
                (place - a).dot(normal)
            });
            let depth = depth.fold(f64::NEG_INFINITY, f64::max);
            let seen = skin.see(place, &mut Search::default()).unwrap();
            assert_eq!(seen.distance < 0.0, depth < 0.0, "{place}: {}, {depth}", seen.distance);
            inside += usize::from(depth < 0.0);
            by_corner += usize::from((seen.distance - place.distance(near)).abs() < 1e-12);
            if depth < 0.0 {
                assert!((seen.distance - depth).abs() < 1e-12);
            }
            // The distance grows the way that is told.
            let farther = skin.see(place + seen.out * 1e-3, &mut Search::default()).unwrap();
            assert!(farther.distance > seen.distance + 0.99e-3);
        }
        assert!(inside > 100 && by_corner > 2000, "{inside} {by_corner}");
    }
}
