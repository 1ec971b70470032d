//! A material of this project's models, as the checks meet it.

use fibre_scattering::{
    Absorption, FarFieldBcsdf, FibreBcsdf, FurBcsdf, FurParameters, FurReference, HairBcsdf, MedullaKey,
    ReferenceBcsdf,
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
    /// Of a medulla that scatters.
    fur: Option<FurReference>,
}

impl Subject {
    /// Prepares a material; `nodes` of the quadrature over the offset make it a far field. The table of a
    /// medulla is built, or found in its cache.
    ///
    /// # Errors
    /// [`VerificationError`] where a parameter is out of range or a table cannot be had.
    pub fn new(parameters: &FurParameters, nodes: Option<u32>) -> Result<Subject, VerificationError> {
        parameters.check()?;
        let mut fur = None;
        let bcsdf = match (nodes, MedullaKey::needed(parameters)) {
            (Some(_), Some(_)) => return Err(VerificationError::FarFur),
            (Some(nodes), None) => FibreBcsdf::FarField(FarFieldBcsdf::new(&parameters.hair, nodes)?),
            // A medulla that only absorbs is fur without a table.
            (None, None) if parameters.medulla.kappa > 0.0 => {
                fur = Some(FurReference::new(parameters, None)?);
                FibreBcsdf::Fur(FurBcsdf::new(parameters, None)?)
            }
            (None, None) => FibreBcsdf::Hair(HairBcsdf::new(&parameters.hair)?),
            (None, Some(key)) => {
                let table = medulla_tables::table(&key)?;
                fur = Some(FurReference::new(parameters, Some(table.clone()))?);
                FibreBcsdf::Fur(FurBcsdf::new(parameters, Some(table))?)
            }
        };
        Ok(Subject { parameters: *parameters, nodes, bcsdf, fur })
    }

    /// The model itself.
    #[must_use]
    pub fn bcsdf(&self) -> &FibreBcsdf {
        &self.bcsdf
    }

    /// The double precision path, where there is one, for a direction of more digits than single precision has.
    #[must_use]
    pub fn double_of(
        &self,
        wo: [f64; 3],
        h: f64,
        absorption: Absorption,
    ) -> Option<Box<dyn DoubleScatterer + '_>> {
        if let Some(fur) = &self.fur {
            let both = [absorption.cortex(), absorption.medulla()];
            let both = both.map(|sigma| sigma.to_array().map(f64::from));
            return Some(Box::new(fur.at_absorbing(wo, h, both)));
        }
        if !matches!(self.bcsdf, FibreBcsdf::Hair(_)) {
            return None;
        }
        let mut hair = self.parameters.hair;
        hair.sigma_a = absorption.cortex();
        Some(Box::new(ReferenceBcsdf::new(&hair).ok()?.at(wo, h)))
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
        // From the numbers single precision is given, so that only its arithmetic is measured.
        self.double_of(widened(view.wo()), f64::from(view.h as f32), absorption)
    }

    fn landmarks(&self, view: View) -> Landmarks {
        let mut landmarks = Landmarks::of_hair(&self.parameters.hair, view);
        if self.parameters.medulla.scatters() {
            landmarks.add_medulla(&self.parameters.hair, view);
        }
        landmarks.add_pilots(&*self.at(view, Absorption::default()));
        landmarks
    }
}
