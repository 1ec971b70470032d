//! Values as the file has them, least significant byte first, and as this machine has them.

use bytemuck::Pod;

/// A value an array of a HAIR file holds: `u16`, `f32` or three `f32`.
pub trait Value: Pod {
    /// The value whose bytes, as the file has them, are those of `self`; the same on little-endian
    /// machines. Also the way back.
    #[must_use]
    fn swapped_on_big_endian(self) -> Self;
}

impl Value for u16 {
    fn swapped_on_big_endian(self) -> Self {
        self.to_le()
    }
}

impl Value for f32 {
    fn swapped_on_big_endian(self) -> Self {
        f32::from_bits(self.to_bits().to_le())
    }
}

impl Value for [f32; 3] {
    fn swapped_on_big_endian(self) -> Self {
        self.map(f32::swapped_on_big_endian)
    }
}

/// Turns values as read into values to use, and values to use into values to write, in place.
pub(crate) fn swap_on_big_endian<T: Value>(values: &mut [T]) {
    if cfg!(target_endian = "big") {
        for value in values {
            *value = value.swapped_on_big_endian();
        }
    }
}
