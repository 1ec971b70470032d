//! How far a scene reaches.

use glam::DVec3;

/// A box along the axes, in world metres, Y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub min: DVec3,
    /// The largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The middle of the box.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Half the box's diagonal: the radius of the sphere about it.
    #[must_use]
    pub fn radius(&self) -> f64 {
        0.5 * (self.max - self.min).length()
    }

    /// The box grown to hold `other`.
    #[must_use]
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box about some points; `None` when there are none.
    pub(crate) fn of_points(points: impl Iterator<Item = DVec3>) -> Option<Bounds> {
        points.map(|p| Bounds { min: p, max: p }).reduce(Bounds::union)
    }
}
