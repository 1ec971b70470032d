//! The tracer: geometry, its tree, and the two questions a ray asks.

use glam::Vec3;

use crate::{BuildOptions, Hit, Primitive, Ray, Strands, TracingError, Triangles};

/// Geometry ready to be traced. Shared between threads; a query changes nothing.
#[derive(Clone, Debug)]
pub struct Tracer {
    bounds: (Vec3, Vec3),
    statistics: Statistics,
}

/// What a tracer holds and what building it cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Segments that can be hit.
    pub segments: usize,
    /// Triangles.
    pub triangles: usize,
    /// Nodes of the tree.
    pub nodes: usize,
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
        _strands: &[Strands],
        _triangles: &[Triangles],
        _options: &BuildOptions,
    ) -> Result<Self, TracingError> {
        Ok(Self { bounds: (Vec3::ZERO, Vec3::ZERO), statistics: Statistics::default() })
    }

    /// The first hit with `0 < t <= ray.t_max`, not counting what the ray leaves.
    #[must_use]
    pub fn closest(&self, _ray: &Ray, _leaving: Option<Primitive>) -> Option<Hit> {
        None
    }

    /// Whether [`closest`](Tracer::closest) would find anything; stops at the first thing found.
    #[must_use]
    pub fn occluded(&self, _ray: &Ray, _leaving: Option<Primitive>) -> bool {
        false
    }

    /// Least and greatest corner of everything; two zeros for an empty tracer.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.bounds
    }

    /// What the tracer holds.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }
}
