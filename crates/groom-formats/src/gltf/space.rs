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
        // Four points side by side, so that processors compare several numbers at once.
        let (mut min, mut max) = ([Vec3::INFINITY; 4], [Vec3::NEG_INFINITY; 4]);
        for run in runs(drawable) {
            let points = drawable.groom.positions().get(run.vertices).unwrap_or_default();
            let (fours, rest) = points.as_chunks::<4>();
            for four in fours {
                stretch(&mut min, &mut max, four);
            }
            for &point in rest {
                stretch(&mut min, &mut max, &[point; 4]);
            }
        }
        let [min, max] = [min.into_iter().reduce(Vec3::min), max.into_iter().reduce(Vec3::max)];
        let (a, b) = (self.vector(min.unwrap_or_default()), self.vector(max.unwrap_or_default()));
        [a.min(b), a.max(b)]
    }
}

#[inline]
fn stretch(min: &mut [Vec3; 4], max: &mut [Vec3; 4], points: &[Vec3; 4]) {
    let points: &[f32; 12] = bytemuck::cast_ref(points);
    let (min, max): (&mut [f32; 12], &mut [f32; 12]) = (bytemuck::cast_mut(min), bytemuck::cast_mut(max));
    for i in 0..12 {
        min[i] = if points[i] < min[i] { points[i] } else { min[i] };
        max[i] = if points[i] > max[i] { points[i] } else { max[i] };
    }
}
