//! From the groom's axes and unit to glTF's.

use glam::{DVec3, Vec3};
use groom::{Groom, UpAxis};

use super::runs::runs;
use crate::drawable::Drawable;

/// Turns and scales: y up, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    up_axis: UpAxis,
    unit: f64,
}

impl Space {
    pub(super) fn of(groom: &Groom) -> Self {
        Space { up_axis: groom.up_axis, unit: groom.meters_per_unit }
    }

    /// Whether the groom's numbers are glTF's already.
    pub(super) fn is_the_same(self) -> bool {
        self.up_axis == UpAxis::Y && self.unit == 1.0
    }

    /// A point or a velocity of the groom, y-up and in metres.
    #[inline]
    pub(super) fn vector(self, v: Vec3) -> Vec3 {
        let turned = self.up_axis.rotate(v, UpAxis::Y);
        if self.unit == 1.0 { turned } else { (DVec3::from(turned) * self.unit).as_vec3() }
    }

    /// The diameter in metres.
    #[inline]
    pub(super) fn width(self, radius: f32) -> f32 {
        (2.0 * f64::from(radius) * self.unit) as f32
    }

    /// Exact bounds of the drawable points, y-up and in metres. Turning and scaling by a positive number keep
    /// the order of numbers, rounding included, so the bounds can be taken first.
    pub(super) fn bounds(self, drawable: Drawable<'_>) -> [Vec3; 2] {
        let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for run in runs(drawable) {
            for &point in drawable.groom.positions().get(run.vertices).unwrap_or_default() {
                (min, max) = (min.min(point), max.max(point));
            }
        }
        let (a, b) = (self.vector(min), self.vector(max));
        [a.min(b), a.max(b)]
    }
}
