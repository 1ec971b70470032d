//! What may differ from strand to strand of one material.

use glam::Vec3;

use crate::error::ScatteringError;
use crate::range;

/// What varies from strand to strand without a new material: absorption per fibre radius, RGB.
///
/// Checked when it is made, so that no hit needs to be: each channel is finite and at least 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Absorption {
    cortex: Vec3,
    medulla: Vec3,
}

impl Absorption {
    /// Of the cortex, hair's `sigma_a`, and of the medulla, which is of no account for hair.
    ///
    /// # Errors
    /// [`ScatteringError::OutOfRange`] for a channel that is negative or not finite.
    pub fn new(cortex: Vec3, medulla: Vec3) -> Result<Absorption, ScatteringError> {
        range::absorption(cortex)?;
        range::medulla_absorption(medulla)?;
        Ok(Absorption { cortex, medulla })
    }

    /// That of hair: a cortex alone.
    ///
    /// # Errors
    /// As [`Absorption::new`].
    pub fn of_cortex(cortex: Vec3) -> Result<Absorption, ScatteringError> {
        Absorption::new(cortex, Vec3::ZERO)
    }

    /// Of the cortex, per fibre radius.
    #[must_use]
    pub fn cortex(&self) -> Vec3 {
        self.cortex
    }

    /// Of the medulla, per fibre radius.
    #[must_use]
    pub fn medulla(&self) -> Vec3 {
        self.medulla
    }

    /// Part of the way from this to another, as between two vertices of a strand: `part` is 0 for this and
    /// 1 for the other. A `part` outside 0..1 lies off the strand and counts as its nearer end.
    #[must_use]
    pub fn toward(&self, other: Absorption, part: f32) -> Absorption {
        let part = if part > 0.0 { part.min(1.0) } else { 0.0 };
        let between = |a: Vec3, b: Vec3| a * (1.0 - part) + b * part;
        Absorption {
            cortex: between(self.cortex, other.cortex),
            medulla: between(self.medulla, other.medulla),
        }
    }
}
