//! Positions rounded to a grid of cubes.

use glam::{DVec3, Vec3};

/// Integers of up to this many bits are stored as such.
const STORED: u32 = 16;
/// What stands for 1 in 16 normalised bits.
const ONE: f64 = 65535.0;
/// From here to twice of it, doubles are integers.
const INTEGERS: f64 = (1_u64 << 52) as f64;

/// A grid over the bounds of all positions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    origin: Vec3,
    /// Side of a cube, metres.
    step: f64,
    /// Cubes a metre.
    steps: f64,
    /// The number of the last grid point.
    last: u32,
    bits: u32,
}

impl Grid {
    /// A grid with 2^bits points along the longest side of the box from `min` to `max`.
    pub(super) fn new(min: Vec3, max: Vec3, bits: u32) -> Self {
        let last = (1_u32 << bits.clamp(1, 24)) - 1;
        let longest = (DVec3::from(max) - DVec3::from(min)).max_element();
        let exact = if longest > 0.0 { longest / f64::from(last) } else { 1.0 };
        // The node keeps the scale as a 32-bit float; it must not end before the box does.
        let step = if bits <= STORED {
            let scale = (exact * ONE) as f32;
            f64::from(if f64::from(scale) < exact * ONE { scale.next_up() } else { scale }) / ONE
        } else {
            exact
        };
        Grid { origin: min, step, steps: 1.0 / step, last, bits }
    }

    /// Whether positions are stored as integers.
    pub(super) fn is_stored(self) -> bool {
        self.bits <= STORED
    }

    pub(super) fn bits(self) -> u32 {
        self.bits
    }

    /// Where the node stands whose mesh holds the integers.
    pub(super) fn translation(self) -> Vec3 {
        self.origin
    }

    /// Metres in one unit of the mesh that holds the integers.
    pub(super) fn scale(self) -> f32 {
        (self.step * ONE) as f32
    }

    /// The nearest grid point.
    #[inline]
    pub(super) fn place(self, point: Vec3) -> [u32; 3] {
        let steps = (DVec3::from(point) - DVec3::from(self.origin)) * self.steps;
        // Added to 2^52, a number is rounded and is its own lowest bits.
        let nearest = |steps: f64| (steps.clamp(0.0, f64::from(self.last)) + INTEGERS).to_bits() as u32;
        steps.to_array().map(nearest)
    }

    /// The nearest grid point as it is stored: fits 16 bits while [`Grid::is_stored`].
    #[inline]
    pub(super) fn stored(self, point: Vec3) -> [u16; 3] {
        self.place(point).map(|step| step as u16)
    }

    /// The nearest grid point, metres.
    #[inline]
    pub(super) fn rounded(self, point: Vec3) -> Vec3 {
        let steps = DVec3::from_array(self.place(point).map(f64::from));
        (DVec3::from(self.origin) + steps * self.step).as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_is_held_and_the_error_is_half_a_cube() {
        let (min, max) = (Vec3::new(-0.3, 1.7, 5.0), Vec3::new(0.1, 2.9, 5.0));
        for bits in [4, 12, 16, 17, 20] {
            let grid = Grid::new(min, max, bits);
            assert!(grid.place(max)[1] == (1 << bits) - 1 && grid.place(min) == [0; 3], "{bits} bits");
            let half = 1.2 / f64::from((1 << bits) - 1) / 2.0;
            for i in 0..1000 {
                let point = min + (max - min) * (i as f32 / 999.0);
                let error = (DVec3::from(grid.rounded(point)) - DVec3::from(point)).abs().max_element();
                assert!(error <= half + 2e-7, "{bits} bits: {error}, half a cube is {half}");
            }
        }
    }

    #[test]
    fn a_single_point_has_a_grid() {
        let grid = Grid::new(Vec3::ONE, Vec3::ONE, 12);
        assert_eq!((grid.stored(Vec3::ONE), grid.rounded(Vec3::ONE)), ([0; 3], Vec3::ONE));
        assert!(grid.scale() > 0.0);
    }
}
