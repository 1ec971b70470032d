//! A direction drawn from a fibre's scattering function.

use glam::Vec3;

use crate::lobe::{Lobe, LobeValues};

/// A direction drawn by [`crate::FibreScatter::sample`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FibreSample {
    /// The unit direction drawn, away from the fibre, in the fibre frame.
    pub wi: Vec3,
    /// What [`crate::FibreScatter::evaluate`] returns for `wi`: all lobes, not only the one drawn.
    pub values: LobeValues,
    /// What [`crate::FibreScatter::pdf`] returns for `wi`; positive and finite.
    pub pdf: f32,
    /// The lobe the direction was drawn from.
    pub lobe: Lobe,
}

impl FibreSample {
    /// Value over pdf, which no channel of a fibre with unit lobe weights has above 1 (but for
    /// rounding): what a path's throughput is multiplied by.
    #[must_use]
    pub fn weight(&self) -> Vec3 {
        self.values.sum() / self.pdf
    }
}
