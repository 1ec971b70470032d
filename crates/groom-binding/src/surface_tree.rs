//! Which triangle is nearest to a place: a tree of boxes.

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::closest_point;
use crate::root_frame::has_area;
use crate::surface::bounds;

/// The nearest point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    pub(crate) triangle: u32,
    pub(crate) barycentrics: DVec3,
    /// Squared, in the units of the surface.
    pub(crate) distance_squared: f64,
}

/// Triangles in boxes, moved to the origin and scaled to 1: what is far away or tiny is found as well as
/// anything.
#[derive(Clone)]
pub(crate) struct SurfaceTree {
    tree: Bvh2,
    /// The triangles in the order of the tree's leaves, with their numbers.
    triangles: Vec<([DVec3; 3], u32)>,
    centre: DVec3,
    scale: f64,
}

/// How far a box may be beyond the best distance, relatively: rounding must not hide an equally near triangle,
/// or the answer would depend on the order of the search.
const SLACK: f64 = 1.0 + 1e-12;

impl SurfaceTree {
    /// A tree over some triangles, each with its number. Every coordinate must be finite.
    pub(crate) fn new(mut triangles: Vec<([DVec3; 3], u32)>) -> Self {
        let (low, high) = bounds(triangles.iter().flat_map(|(corners, _)| *corners));
        let size = low.distance(high);
        let (centre, scale) =
            if size > 0.0 && size.is_finite() { (low.midpoint(high), size.recip()) } else { (low, 1.0) };
        for (corners, _) in &mut triangles {
            *corners = corners.map(|p| (p - centre) * scale);
        }
        let boxes: Vec<Aabb> = triangles.iter().map(|(corners, _)| around(corners)).collect();
        let indices = (0..boxes.len() as u32).collect();
        let tree = PlocBuilder::with_capacity(boxes.len()).build(
            PlocSearchDistance::Low,
            &boxes,
            indices,
            SortPrecision::U64,
            0,
        );
        let sorted = tree.primitive_indices.iter().filter_map(|&i| triangles.get(i as usize).copied());
        let triangles = sorted.collect();
        SurfaceTree { tree, triangles, centre, scale }
    }

    /// A tree over those of `count` triangles that have an area in space; over all when none has. One without lies on the
    /// edges of others, and tells neither a frame nor a side. `corners` are what is searched, in space or elsewhere.
    pub(crate) fn of_sound(
        count: usize,
        in_space: impl Fn(u32) -> [DVec3; 3],
        corners: impl Fn(u32) -> [DVec3; 3],
    ) -> Self {
        let all = 0..count as u32;
        let mut sound: Vec<u32> = all.clone().filter(|&triangle| has_area(in_space(triangle))).collect();
        if sound.is_empty() {
            sound = all.collect();
        }
        Self::new(sound.into_iter().map(|triangle| (corners(triangle), triangle)).collect())
    }

    /// The diagonal of the box round all triangles.
    pub(crate) fn size(&self) -> f64 {
        self.scale.recip()
    }

    /// The point nearest to `point`, which must be finite; of triangles equally near the one of the least
    /// number. `None` when there is no triangle. `search` saves time from one question to the next and changes
    /// no answer.
    pub(crate) fn nearest(&self, point: DVec3, search: &mut Search) -> Option<Nearest> {
        let point = (point - self.centre) * self.scale;
        let mut best = Best { distance: f64::INFINITY, triangle: u32::MAX, weights: DVec3::X, place: 0 };
        if let Some(place) = search.last {
            self.try_triangle(point, place, &mut best);
        }
        self.walk(point, search, &mut best, |best| best.distance, Self::try_triangle);
        search.last = Some(best.place);
        (best.triangle != u32::MAX).then(|| self.answer(&best))
    }

    /// Every triangle whose distance from `point` is at most `distance`, with its point nearest to it, in no
    /// order.
    pub(crate) fn within(&self, point: DVec3, distance: f64, search: &mut Search) -> Vec<Nearest> {
        let point = (point - self.centre) * self.scale;
        let most = (distance * self.scale).powi(2);
        let mut found = Vec::new();
        let mut take = |tree: &Self, point, place, _: &mut ()| {
            let mut one = Best { distance: f64::INFINITY, triangle: u32::MAX, weights: DVec3::X, place };
            tree.try_triangle(point, place, &mut one);
            if one.distance <= most {
                found.push(tree.answer(&one));
            }
        };
        self.walk(
            point,
            search,
            &mut (),
            |()| most,
            |tree, point, place, state| take(tree, point, place, state),
        );
        found
    }

    /// Visits every triangle in a box nearer than `limit` says, the nearer boxes first.
    #[inline]
    fn walk<S>(
        &self,
        point: DVec3,
        search: &mut Search,
        state: &mut S,
        limit: impl Fn(&S) -> f64,
        mut visit: impl FnMut(&Self, DVec3, u32, &mut S),
    ) {
        let seeker = Seeker::new(point);
        let waiting = &mut search.waiting;
        waiting.clear();
        if !self.tree.nodes.is_empty() {
            waiting.push((0.0, 0));
        }
        while let Some((distance, node)) = waiting.pop() {
            if distance > limit(state) * SLACK {
                continue;
            }
            let node = &self.tree.nodes[node as usize];
            if node.prim_count > 0 {
                for place in node.first_index..node.first_index + node.prim_count {
                    visit(self, point, place, state);
                }
                continue;
            }
            let first = node.first_index;
            let child = |child: u32| (seeker.bound(&self.tree.nodes[child as usize].aabb), child);
            let mut children = [child(first), child(first + 1)];
            // The nearer one is taken first: it is put on top.
            if children[0].0 < children[1].0 {
                children.swap(0, 1);
            }
            let limit = limit(state) * SLACK;
            for child in children {
                if child.0 <= limit {
                    waiting.push(child);
                }
            }
        }
    }

    fn answer(&self, best: &Best) -> Nearest {
        let unit = self.scale.recip();
        let distance_squared = best.distance * unit * unit;
        Nearest { triangle: best.triangle, barycentrics: best.weights, distance_squared }
    }

    #[inline]
    fn try_triangle(&self, point: DVec3, place: u32, best: &mut Best) {
        let &([a, b, c], triangle) = &self.triangles[place as usize];
        let found = closest_point::to_origin([a - point, b - point, c - point]);
        if (found.distance_squared, triangle) < (best.distance, best.triangle) {
            *best = Best { distance: found.distance_squared, triangle, weights: found.barycentrics, place };
        }
    }
}

/// What is kept from one question to the next: the last answer is a good first guess for a place near by.
/// Belongs to one tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search {
    last: Option<u32>,
    waiting: Vec<(f64, u32)>,
}

struct Best {
    distance: f64,
    triangle: u32,
    weights: DVec3,
    place: u32,
}

/// A place, as boxes are asked about it.
#[derive(Clone, Copy)]
struct Seeker {
    exact: DVec3,
    near: Vec3A,
    /// What rounding to f32 may add to a difference; `None` where that is too much and f64 is called for.
    rounding: Option<Vec3A>,
}

impl Seeker {
    fn new(point: DVec3) -> Self {
        let size = 1.0 + point.abs().max_element();
        let rounding = (size < 100.0).then(|| Vec3A::splat(size as f32 * 2.5 * f32::EPSILON));
        Seeker { exact: point, near: point.as_vec3a(), rounding }
    }

    /// A squared distance that nothing in the box is nearer than, 0 inside.
    #[inline]
    fn bound(&self, aabb: &Aabb) -> f64 {
        if let Some(rounding) = self.rounding {
            let apart = (aabb.min - self.near).max(self.near - aabb.max) - rounding;
            return f64::from(apart.max(Vec3A::ZERO).length_squared()) * (1.0 - 1e-6);
        }
        let (low, high) = (aabb.min.as_dvec3(), aabb.max.as_dvec3());
        (low - self.exact).max(self.exact - high).max(DVec3::ZERO).length_squared()
    }
}

/// A box in single precision that holds a triangle for certain.
fn around([a, b, c]: &[DVec3; 3]) -> Aabb {
    let (low, high) = (a.min(*b).min(*c).as_vec3(), a.max(*b).max(*c).as_vec3());
    Aabb::new(low.map(f32::next_down).into(), high.map(f32::next_up).into())
}
