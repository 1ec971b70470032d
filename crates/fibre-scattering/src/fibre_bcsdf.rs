//! Any of the models, as a renderer holds them.

use glam::Vec3;

use crate::fur::bcsdf::{FurBcsdf, FurScatter};
use crate::hair::bcsdf::{HairBcsdf, HairScatter};
use crate::hair::far_field::{FarFieldBcsdf, FarFieldScatter};
use crate::lobe::LobeValues;
use crate::per_strand::Absorption;
use crate::sample::FibreSample;

/// A material of fibres.
#[derive(Debug, Clone)]
pub enum FibreBcsdf {
    /// Hair, met at an offset.
    Hair(HairBcsdf),
    /// Fur, met at an offset.
    Fur(FurBcsdf),
    /// Hair seen from afar.
    FarField(FarFieldBcsdf),
}

impl FibreBcsdf {
    /// The fibre as seen from the unit direction `wo` at the offset `h`, with this absorption in place of
    /// the material's: see [`HairBcsdf::at`].
    #[must_use]
    pub fn at(&self, wo: Vec3, h: f32, absorption: Absorption) -> FibreScatter<'_> {
        match self {
            FibreBcsdf::Hair(hair) => FibreScatter::Hair(hair.with_absorption(absorption).at(wo, h)),
            FibreBcsdf::Fur(fur) => FibreScatter::Fur(fur.at(wo, h, absorption)),
            FibreBcsdf::FarField(far) => FibreScatter::FarField(far.at(wo, absorption)),
        }
    }
}

/// A fibre met by a ray: scattering as a function of the other direction.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant)] // one is made per hit: a box would cost more than the bytes
pub enum FibreScatter<'a> {
    /// Hair.
    Hair(HairScatter),
    /// Fur.
    Fur(FurScatter<'a>),
    /// Hair seen from afar.
    FarField(FarFieldScatter),
}

impl FibreScatter<'_> {
    /// As [`HairScatter::evaluate_with_pdf`].
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        match self {
            FibreScatter::Hair(hair) => hair.evaluate_with_pdf(wi),
            FibreScatter::Fur(fur) => fur.evaluate_with_pdf(wi),
            FibreScatter::FarField(far) => far.evaluate_with_pdf(wi),
        }
    }

    /// f cos(theta_i) of each lobe: see [`HairScatter::evaluate`].
    #[must_use]
    pub fn evaluate(&self, wi: Vec3) -> LobeValues {
        self.evaluate_with_pdf(wi).0
    }

    /// The density of [`FibreScatter::sample`], per steradian.
    #[must_use]
    pub fn pdf(&self, wi: Vec3) -> f32 {
        self.evaluate_with_pdf(wi).1
    }

    /// As [`HairScatter::sample`].
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> Option<FibreSample> {
        match self {
            FibreScatter::Hair(hair) => hair.sample(u),
            FibreScatter::Fur(fur) => fur.sample(u),
            FibreScatter::FarField(far) => far.sample(u),
        }
    }

    /// As [`HairScatter::albedo`].
    #[must_use]
    pub fn albedo(&self) -> [Vec3; 5] {
        match self {
            FibreScatter::Hair(hair) => hair.albedo(),
            FibreScatter::Fur(fur) => fur.albedo(),
            FibreScatter::FarField(far) => far.albedo(),
        }
    }
}
