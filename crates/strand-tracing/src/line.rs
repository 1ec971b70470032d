//! A ray as the intersectors see it.

use glam::DVec3;

use crate::Ray;

/// A ray's line in double precision: positions near the ray's far end keep their last bits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    /// Squared length of the direction: a unit vector rounded to single precision is not quite one.
    pub(crate) squared: f64,
}

impl Line {
    pub(crate) fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, squared: direction.length_squared() }
    }

    pub(crate) fn of(ray: &Ray) -> Self {
        Self::new(ray.origin.as_dvec3(), ray.direction.as_dvec3())
    }

    pub(crate) fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    pub(crate) fn reversed(&self) -> Self {
        Self { direction: -self.direction, ..*self }
    }
}
