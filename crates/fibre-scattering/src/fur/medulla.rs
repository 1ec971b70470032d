//! The core of a fibre of fur: a cylinder that scatters.

use glam::Vec3;

use crate::error::ScatteringError;
use crate::hair::parameters::HairParameters;
use crate::range;

/// The medulla of Yan et al. 2017, "An Efficient and Practical Near and Far Field Fur Reflectance Model"
/// (doi:10.1145/3072959.3073600). It shares the cortex's index of refraction, so that light bends at the
/// fibre's surface only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medulla {
    /// Radius of the medulla over that of the fibre (the medullary index), in [0, 0.99].
    pub kappa: f32,
    /// Scattering coefficient per fibre radius, in [0, 100].
    pub sigma_s: f32,
    /// Absorption of the medulla in red, green and blue, per fibre radius; at least 0.
    pub sigma_a: Vec3,
    /// Mean cosine of the Henyey-Greenstein phase function, in [-0.99, 0.99].
    pub g: f32,
}

impl Medulla {
    /// No medulla: hair.
    pub const NONE: Medulla = Medulla { kappa: 0.0, sigma_s: 0.0, sigma_a: Vec3::ZERO, g: 0.0 };

    /// Whether light is scattered inside: whether a [`MedullaTable`](crate::MedullaTable) is needed.
    #[must_use]
    pub fn scatters(&self) -> bool {
        self.kappa > 0.0 && self.sigma_s > 0.0
    }

    /// Checks every bound stated on the fields.
    ///
    /// # Errors
    /// The first bound broken, as a [`ScatteringError`]; NaN breaks every bound.
    pub fn check(&self) -> Result<(), ScatteringError> {
        range::within("medulla.kappa", self.kappa, 0.0..=0.99, "[0, 0.99]")?;
        range::within("medulla.sigma_s", self.sigma_s, 0.0..=100.0, "[0, 100]")?;
        range::within("medulla.g", self.g, -0.99..=0.99, "[-0.99, 0.99]")?;
        range::medulla_absorption(self.sigma_a)
    }
}

impl Default for Medulla {
    fn default() -> Self {
        Medulla::NONE
    }
}

/// A fibre of fur: hair (whose `sigma_a` is that of the cortex) around a medulla.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FurParameters {
    /// Surface and cortex.
    pub hair: HairParameters,
    /// The core.
    pub medulla: Medulla,
}

impl FurParameters {
    /// Checks every bound of both. Around a medulla a fibre is round: `aspect` is then 1.
    ///
    /// # Errors
    /// The first bound broken.
    pub fn check(&self) -> Result<(), ScatteringError> {
        self.hair.check()?;
        self.medulla.check()?;
        if self.medulla.kappa > 0.0 {
            range::within("aspect", self.hair.aspect, 1.0..=1.0, "[1, 1]: a fibre with a medulla is round")?;
        }
        Ok(())
    }
}

impl From<HairParameters> for FurParameters {
    fn from(hair: HairParameters) -> Self {
        FurParameters { hair, medulla: Medulla::NONE }
    }
}
