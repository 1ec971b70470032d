//! The model in double precision, with an exact Bessel function: the measure of the fast path.

use crate::error::ScatteringError;
use crate::hair::fibre::{Fibre, Hit};
use crate::hair::parameters::HairParameters;

/// [`HairBcsdf`](crate::HairBcsdf) in `f64`, for tests and for offline figures. Slow: its Bessel
/// function is a series; the other formulas are the same code.
#[derive(Debug, Clone, Copy)]
pub struct ReferenceBcsdf {
    fibre: Fibre<f64>,
}

impl ReferenceBcsdf {
    /// Prepares a material.
    ///
    /// # Errors
    /// As [`HairBcsdf::new`](crate::HairBcsdf::new).
    pub fn new(parameters: &HairParameters) -> Result<ReferenceBcsdf, ScatteringError> {
        parameters.check()?;
        Ok(ReferenceBcsdf { fibre: Fibre::new(parameters) })
    }

    /// As [`HairBcsdf::at`](crate::HairBcsdf::at).
    #[must_use]
    pub fn at(&self, wo: [f64; 3], h: f64) -> ReferenceScatter {
        ReferenceScatter { hit: self.fibre.at(wo, h) }
    }
}

/// [`HairScatter`](crate::HairScatter) in `f64`; directions and RGB are arrays of three.
#[derive(Debug, Clone, Copy)]
pub struct ReferenceScatter {
    hit: Hit<f64>,
}

impl ReferenceScatter {
    /// f cos(theta_i) of each lobe, and the density per steradian.
    #[must_use]
    pub fn evaluate_with_pdf(&self, wi: [f64; 3]) -> ([[f64; 3]; 5], f64) {
        self.hit.evaluate_with_pdf(wi)
    }

    /// Draws a direction from four uniform numbers in [0, 1).
    #[must_use]
    pub fn sample_direction(&self, u: [f64; 4]) -> Option<[f64; 3]> {
        self.hit.sample_direction(u).map(|(wi, _)| wi)
    }

    /// The attenuations A_p, times the lobe weights.
    #[must_use]
    pub fn albedo(&self) -> [[f64; 3]; 5] {
        self.hit.attenuations()
    }
}
