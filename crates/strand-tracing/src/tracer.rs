//! The tracer: geometry, its tree, and the two questions a ray asks.

use std::time::Instant;

use glam::Vec3;

use crate::build::{self, Built};
use crate::fibres::Fibres;
use crate::meshes::Meshes;
use crate::moving::Moving;
use crate::pose::{Moment, Still};
use crate::query::Query;
use crate::search::{self, Nearest};
use crate::{BuildOptions, Hit, Primitive, Ray, Strands, TracingError, Triangles};

/// Geometry ready to be traced. Shared between threads; a query changes nothing.
#[derive(Clone, Debug)]
pub struct Tracer {
    fibres: Fibres,
    meshes: Meshes,
    /// What stands still.
    built: Built,
    /// What moves; none where nothing does.
    moving: Option<Moving>,
    statistics: Statistics,
}

/// What a tracer holds and what building it cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Segments that can be hit.
    pub segments: usize,
    /// Triangles.
    pub triangles: usize,
    /// Nodes of the tree, or of both: of what stands still and of what moves.
    pub nodes: usize,
    /// Keys of the tree over what moves, 0 where nothing does. No more than the objects' paths need to be
    /// followed closely.
    pub tree_keys: usize,
    /// Memory held, in bytes.
    pub bytes: usize,
    /// Seconds the build took.
    pub build_seconds: f64,
}

impl Tracer {
    /// Copies the geometry and builds the tree over it. Nothing is built for what is not there.
    ///
    /// # Errors
    /// Offsets, indices or counts that do not fit, and numbers that are not finite.
    pub fn build(
        strands: &[Strands],
        triangles: &[Triangles],
        options: &BuildOptions,
    ) -> Result<Self, TracingError> {
        let start = Instant::now();
        build::check_counts(strands, triangles)?;
        let fibres = Fibres::gather(strands)?;
        let meshes = Meshes::gather(triangles)?;
        let built = build::tree(&fibres, &meshes, options);
        let moving = Moving::build(&fibres, &meshes, options);
        let statistics = Statistics {
            segments: fibres.solid().count(),
            triangles: meshes.all().len(),
            nodes: built.tree.node_count() + moving.as_ref().map_or(0, |moving| moving.tree.node_count()),
            tree_keys: moving.as_ref().map_or(0, |moving| moving.intervals + 1),
            bytes: fibres.bytes() + meshes.bytes() + built.bytes() + moving.as_ref().map_or(0, Moving::bytes),
            build_seconds: start.elapsed().as_secs_f64(),
        };
        Ok(Self { fibres, meshes, built, moving, statistics })
    }

    /// The first hit with `0 < t <= ray.t_max`, not counting what the ray leaves: pass the primitive of the
    /// hit a ray starts from, with the ray's origin at [`Hit::position`].
    ///
    /// Of several hits at the same distance the one that came first in the input counts, strands before
    /// triangles. A ray with a component that is not a number hits nothing.
    #[must_use]
    pub fn closest(&self, ray: &Ray, leaving: Option<Primitive>) -> Option<Hit> {
        match &self.moving {
            None => {
                let query = Query::new(self.still(), ray, leaving);
                let mut nearest = Nearest::new(ray);
                nearest.search(&self.built, &query, ray);
                nearest.describe(&query, ray)
            }
            Some(moving) => {
                let query = Query::new(self.moment(ray)?, ray, leaving);
                let mut nearest = Nearest::new(ray);
                nearest.search(moving, &query, ray);
                nearest.search(&self.built, &query, ray);
                nearest.describe(&query, ray)
            }
        }
    }

    /// Whether [`closest`](Tracer::closest) would find anything; stops at the first thing found.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, leaving: Option<Primitive>) -> bool {
        match &self.moving {
            None => search::any(&self.built, &Query::new(self.still(), ray, leaving), ray),
            Some(moving) => self.moment(ray).is_some_and(|moment| {
                let query = Query::new(moment, ray, leaving);
                search::any(moving, &query, ray) || search::any(&self.built, &query, ray)
            }),
        }
    }

    #[inline]
    fn still(&self) -> Still<'_> {
        Still { fibres: &self.fibres, meshes: &self.meshes }
    }

    /// Everything at the ray's time; none if that is outside the shutter.
    #[inline]
    fn moment(&self, ray: &Ray) -> Option<Moment<'_>> {
        let moment = Moment { fibres: &self.fibres, meshes: &self.meshes, time: f64::from(ray.time) };
        (0.0..=1.0).contains(&ray.time).then_some(moment)
    }

    /// Least and greatest corner of everything that can be hit, at any time; two zeros for an empty tracer.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let still = (!self.built.is_empty()).then_some(self.built.bounds);
        let moving = self.moving.as_ref().map(|moving| moving.bounds);
        let both = still.into_iter().chain(moving).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        both.unwrap_or_default()
    }

    /// What the tracer holds.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }
}
