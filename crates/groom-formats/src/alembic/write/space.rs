//! The unit and the axis of what is written.

use std::borrow::Cow;

use glam::{DVec3, Vec3};
use groom::{Groom, UpAxis};

use crate::Dialect;

/// Unreal's unit in metres.
const CENTIMETRE: f64 = 0.01;

/// How the groom's numbers become the file's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    from: UpAxis,
    /// Which way is up in the file.
    pub(super) up_axis: UpAxis,
    /// Metres in a unit of the file.
    pub(super) meters_per_unit: f64,
    factor: f64,
}

impl Space {
    /// The groom's own numbers, or Unreal's centimetres with z up.
    pub(super) fn new(groom: &Groom, dialect: Option<Dialect>) -> Self {
        let (from, unit) = (groom.up_axis, groom.meters_per_unit);
        if dialect == Some(Dialect::Unreal) {
            let factor = if unit == CENTIMETRE { 1.0 } else { unit / CENTIMETRE };
            return Space { from, up_axis: UpAxis::Z, meters_per_unit: CENTIMETRE, factor };
        }
        Space { from, up_axis: from, meters_per_unit: unit, factor: 1.0 }
    }

    /// Positions or velocities; those that stay as they are are not copied.
    pub(super) fn vectors(self, vectors: &[Vec3]) -> Cow<'_, [Vec3]> {
        if self.factor == 1.0 && self.from == self.up_axis {
            return Cow::Borrowed(vectors);
        }
        let change = |v: &Vec3| {
            let turned = self.from.rotate(*v, self.up_axis);
            if self.factor == 1.0 { turned } else { (turned.as_dvec3() * self.factor).as_vec3() }
        };
        Cow::Owned(vectors.iter().map(change).collect())
    }

    /// A place, in 64 bits.
    pub(super) fn place(self, place: DVec3) -> DVec3 {
        let turned = match (self.from, self.up_axis) {
            (UpAxis::Y, UpAxis::Z) => DVec3::new(place.x, -place.z, place.y),
            (UpAxis::Z, UpAxis::Y) => DVec3::new(place.x, place.z, -place.y),
            _ => place,
        };
        turned * self.factor
    }

    /// Twice a radius.
    pub(super) fn diameter(self, radius: f32) -> f32 {
        if self.factor == 1.0 { 2.0 * radius } else { (f64::from(radius) * 2.0 * self.factor) as f32 }
    }
}
