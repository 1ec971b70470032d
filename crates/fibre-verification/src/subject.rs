//! A material of this project's models, as the checks meet it.

use fibre_scattering::{
    Absorption, FarFieldBcsdf, FibreBcsdf, FurBcsdf, FurParameters, HairBcsdf, MedullaKey, ReferenceBcsdf,
};

use crate::error::VerificationError;
use crate::landmarks::Landmarks;
use crate::scatterer::{DoubleScatterer, Model, Scatterer, View, widened};

/// A material and the model made of it.
#[derive(Debug, Clone)]
pub struct Subject {
    parameters: FurParameters,
    nodes: Option<u32>,
    bcsdf: FibreBcsdf,
}

impl Subject {
    /// Prepares a material; `nodes` of the quadrature over the offset make it a far field. The table of a
    /// medulla is built, or found in its cache.
    ///
    /// # Errors
    /// [`VerificationError`] where a parameter is out of range or a table cannot be had.
    pub fn new(parameters: &FurParameters, nodes: Option<u32>) -> Result<Subject, VerificationError> {
        parameters.check()?;
        let bcsdf = match (nodes, MedullaKey::needed(parameters)) {
            (Some(_), Some(_)) => return Err(VerificationError::FarFur),
            (Some(nodes), None) => FibreBcsdf::FarField(FarFieldBcsdf::new(&parameters.hair, nodes)?),
            (None, None) => FibreBcsdf::Hair(HairBcsdf::new(&parameters.hair)?),
            (None, Some(key)) => {
                FibreBcsdf::Fur(FurBcsdf::new(parameters, Some(medulla_tables::table(&key)?))?)
            }
        };
        Ok(Subject { parameters: *parameters, nodes, bcsdf })
    }

    /// The model itself.
    #[must_use]
    pub fn bcsdf(&self) -> &FibreBcsdf {
        &self.bcsdf
    }

    /// Nodes over the offset, for a far field.
    #[must_use]
    pub fn nodes(&self) -> Option<u32> {
        self.nodes
    }
}

impl Model for Subject {
    fn parameters(&self) -> &FurParameters {
        &self.parameters
    }

    fn is_near(&self) -> bool {
        self.nodes.is_none()
    }

    fn upright(&self) -> Option<Box<dyn Model + '_>> {
        let mut parameters = self.parameters;
        parameters.hair.alpha = 0.0;
        Some(Box::new(Subject::new(&parameters, self.nodes).ok()?))
    }

    fn at(&self, view: View, absorption: Absorption) -> Box<dyn Scatterer + '_> {
        Box::new(self.bcsdf.at(view.wo(), view.h as f32, absorption))
    }

    fn double_at(&self, view: View, absorption: Absorption) -> Option<Box<dyn DoubleScatterer + '_>> {
        if !matches!(self.bcsdf, FibreBcsdf::Hair(_)) {
            return None;
        }
        let mut hair = self.parameters.hair;
        hair.sigma_a = absorption.cortex();
        let reference = ReferenceBcsdf::new(&hair).ok()?;
        // From the numbers single precision is given, so that only its arithmetic is measured.
        Some(Box::new(reference.at(widened(view.wo()), f64::from(view.h as f32))))
    }

    fn landmarks(&self, view: View) -> Landmarks {
        let mut landmarks = Landmarks::of_hair(&self.parameters.hair, view);
        landmarks.add_pilots(&*self.at(view, Absorption::default()));
        landmarks
    }
}
