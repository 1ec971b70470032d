//! The five ways light leaves a fibre, and values kept apart by them.

use std::ops::{Index, Mul};

use glam::Vec3;

/// How light left the fibre, counted by what it did inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Lobe {
    /// Reflected at the surface.
    R = 0,
    /// Transmitted twice: in and out.
    Tt = 1,
    /// Transmitted in, reflected once inside, transmitted out.
    Trt = 2,
    /// Reflected twice or more inside: all that the first three leave over.
    Residual = 3,
    /// Scattered at least once inside the medulla; hair without a medulla has none.
    Scattered = 4,
}

impl Lobe {
    /// All lobes, in the order of every array of five in this crate.
    pub const ALL: [Lobe; 5] = [Lobe::R, Lobe::Tt, Lobe::Trt, Lobe::Residual, Lobe::Scattered];

    /// Position in [`Lobe::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The short name used for passes: `R`, `TT`, `TRT`, `residual` or `scattered`.
    pub const fn name(self) -> &'static str {
        match self {
            Lobe::R => "R",
            Lobe::Tt => "TT",
            Lobe::Trt => "TRT",
            Lobe::Residual => "residual",
            Lobe::Scattered => "scattered",
        }
    }
}

/// One RGB value per lobe, in the order of [`Lobe::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LobeValues(pub [Vec3; 5]);

impl LobeValues {
    /// No light in any lobe.
    pub const ZERO: LobeValues = LobeValues([Vec3::ZERO; 5]);

    /// All lobes together.
    #[must_use]
    pub fn sum(&self) -> Vec3 {
        self.0[0] + self.0[1] + self.0[2] + self.0[3] + self.0[4]
    }
}

impl Index<Lobe> for LobeValues {
    type Output = Vec3;

    fn index(&self, lobe: Lobe) -> &Vec3 {
        &self.0[lobe.index()]
    }
}

impl Mul<f32> for LobeValues {
    type Output = LobeValues;

    fn mul(self, factor: f32) -> LobeValues {
        LobeValues(self.0.map(|value| value * factor))
    }
}
