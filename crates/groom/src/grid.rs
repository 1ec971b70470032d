//! Positions rounded to a grid.

use glam::{DVec3, UVec3, Vec3};

use crate::{Groom, GroomError};

/// A cubic lattice over a box, as fine as a number of bits allows along the box's longest side.
///
/// Point `i` of it is `origin + i * step`, `i` from 0 to 2^bits - 1 on each axis; one step for all axes
/// keeps strands round and lets a file undo the grid with one scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The box's lowest corner.
    pub origin: DVec3,
    /// How far apart neighbours are; 0 when the box is a point.
    pub step: f64,
    /// Bits of a coordinate.
    pub bits: u32,
}

impl Grid {
    /// The grid over the finite points of `groom`.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `bits` lies in 4..=24.
    pub fn of(groom: &Groom, bits: u32) -> Result<Grid, GroomError> {
        if !(4..=24).contains(&bits) {
            return Err(GroomError::argument("bits of a coordinate", bits, "4 to 24"));
        }
        let finite = groom.positions().iter().filter(|p| p.is_finite());
        let ends = finite.fold(None, |ends: Option<(Vec3, Vec3)>, &p| {
            Some(ends.map_or((p, p), |(low, high)| (low.min(p), high.max(p))))
        });
        let (low, high) = ends.unwrap_or_default();
        let size = (high.as_dvec3() - low.as_dvec3()).max_element();
        let mut grid = Grid { origin: low.as_dvec3(), step: 0.0, bits };
        grid.step = size / f64::from(grid.last());
        Ok(grid)
    }

    /// The highest index on each axis.
    #[must_use]
    pub fn last(&self) -> u32 {
        u32::MAX >> (32 - self.bits.clamp(1, 32))
    }

    /// The indices of the lattice point closest to `position`; those of the closest one in the box when
    /// it lies outside, and 0 for what is not a number.
    #[must_use]
    pub fn index(&self, position: Vec3) -> UVec3 {
        if self.step <= 0.0 {
            return UVec3::ZERO;
        }
        let steps = ((position.as_dvec3() - self.origin) / self.step).round();
        // The cast takes what is below 0, and not-a-number, to 0.
        steps.as_uvec3().min(UVec3::splat(self.last()))
    }

    /// The lattice point with these indices, rounded once.
    #[must_use]
    pub fn point(&self, index: UVec3) -> Vec3 {
        (self.origin + index.as_dvec3() * self.step).as_vec3()
    }
}

impl Groom {
    /// Moves every point to the closest point of the [`Grid`] of `bits` bits over the groom, and gives the
    /// farthest that one was moved, in the groom's units: at most half the grid's step times the root of
    /// 3, and a rounding. Doing it again moves nothing. Points that are not finite stay.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `bits` lies in 4..=24.
    pub fn quantize(&mut self, bits: u32) -> Result<f64, GroomError> {
        let grid = Grid::of(self, bits)?;
        let mut farthest = 0.0_f64;
        for position in self.positions_mut().iter_mut().filter(|p| p.is_finite()) {
            let there = grid.point(grid.index(*position));
            farthest = farthest.max(there.as_dvec3().distance_squared(position.as_dvec3()));
            *position = there;
        }
        Ok(farthest.sqrt())
    }
}
