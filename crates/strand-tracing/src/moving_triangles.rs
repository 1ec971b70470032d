//! Boxes of moving triangles at the keys of the tree over them.

use glam::{DVec3, Vec3};
use obvhs::aabb::Aabb;

use crate::bounds;
use crate::meshes::Meshes;
use crate::stray;
use crate::tracks::{Between, Track};

/// All triangles that move, for a tree of so many intervals; see [`moving_pieces`](crate::moving_pieces).
pub(crate) struct MovingTriangles<'a> {
    meshes: &'a Meshes,
    intervals: usize,
    /// Their numbers, and how far a corner ever is from where the tree has it.
    pub(crate) all: Vec<(u32, f64)>,
}

impl<'a> MovingTriangles<'a> {
    pub(crate) fn gather(meshes: &'a Meshes, intervals: usize) -> Self {
        let mut triangles = Self { meshes, intervals, all: Vec::new() };
        for number in 0..meshes.all().len() as u32 {
            if let Some(track) = meshes.tracks().of(number) {
                let stray = triangles.stray(track, number);
                triangles.all.push((number, stray));
            }
        }
        triangles
    }

    /// How far some of the triangles stray and how large they are, for a tree of so many intervals.
    pub(crate) fn strays(
        meshes: &'a Meshes,
        intervals: usize,
        samples: usize,
    ) -> impl Iterator<Item = (f64, f64)> {
        let triangles = Self { meshes, intervals, all: Vec::new() };
        let moving = move |&number: &u32| meshes.tracks().of(number).is_some();
        let all = 0..meshes.all().len() as u32;
        let step = all.clone().filter(moving).count() / samples + 1;
        all.filter(moving).step_by(step).filter_map(move |number| {
            let corners = meshes.all().get(number as usize)?.map(|corner| corner.as_dvec3());
            let stray = triangles.stray(meshes.tracks().of(number)?, number);
            Some((stray, (corners[1] - corners[0]).length().max((corners[2] - corners[0]).length())))
        })
    }

    /// Round a triangle at a key of the tree.
    pub(crate) fn around(&self, &(number, stray): &(u32, f64), key: usize) -> Aabb {
        let Some(track) = self.meshes.tracks().of(number) else { return Aabb::empty() };
        let corners = self.corners(track, number, key as f64 / self.intervals as f64);
        let mut around = bounds::of_triangle(&corners.map(|corner| corner.as_vec3()));
        if stray > 0.0 {
            let by = Vec3::splat((stray as f32).next_up());
            let (low, high) = (Vec3::from(around.min) - by, Vec3::from(around.max) + by);
            around = bounds::widened(low, high);
        }
        around
    }

    /// Not rounded.
    fn corners(&self, track: &Track<[Vec3; 3]>, number: u32, time: f64) -> [DVec3; 3] {
        let first = self.meshes.all().get(number as usize).copied().unwrap_or_default();
        let Between { before, share } = Between::of(time, track.intervals());
        let (low, high) = (track.at(number, before, first), track.at(number, before + 1, first));
        std::array::from_fn(|i| low[i].as_dvec3() * (1.0 - share) + high[i].as_dvec3() * share)
    }

    fn stray(&self, track: &Track<[Vec3; 3]>, number: u32) -> f64 {
        if track.intervals() == self.intervals {
            return 0.0;
        }
        stray::greatest(track.intervals(), self.intervals, |time| self.corners(track, number, time))
    }
}
