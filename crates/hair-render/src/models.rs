//! The scattering models of one groom: one for all strands, or one for each roughness that occurs.

use std::collections::HashMap;
use std::sync::Arc;

use fibre_material::{Dressed, Field};
use fibre_scattering::{
    FarFieldBcsdf, FibreBcsdf, FurBcsdf, FurParameters, HairBcsdf, HairParameters, ScatteringError,
};
use medulla_tables::Found;

use crate::{RenderError, TableUse};

/// Prepared models, and which one each strand has.
#[derive(Debug)]
pub(crate) struct Models {
    prepared: Vec<FibreBcsdf>,
    /// Index into `prepared` by strand; empty where one model serves all.
    by_strand: Vec<u32>,
    table: Option<TableUse>,
}

impl Models {
    /// Prepares every model that `dressed` asks for; strands of the same roughness share theirs.
    pub fn new(object: usize, dressed: &Dressed) -> Result<Models, RenderError> {
        let refused = |source: ScatteringError| RenderError::Scattering { object, source };
        let maker = Maker::new(object, &dressed.parameters, dressed.field)?;
        let table = maker.table(object);
        let Some(roughness) = &dressed.roughness else {
            let only = maker.make(dressed.parameters.hair).map_err(refused)?;
            return Ok(Models { prepared: vec![only], by_strand: Vec::new(), table });
        };
        let mut prepared = Vec::new();
        let mut known = HashMap::new();
        let mut by_strand = Vec::with_capacity(roughness.len());
        for &[beta_m, beta_n] in roughness {
            let index = match known.get(&[beta_m.to_bits(), beta_n.to_bits()]) {
                Some(&index) => index,
                None => {
                    let hair = HairParameters { beta_m, beta_n, ..dressed.parameters.hair };
                    prepared.push(maker.make(hair).map_err(refused)?);
                    let index = prepared.len() as u32 - 1;
                    known.insert([beta_m.to_bits(), beta_n.to_bits()], index);
                    index
                }
            };
            by_strand.push(index);
        }
        if prepared.len() <= 1 {
            by_strand = Vec::new();
        }
        if prepared.is_empty() {
            // A groom without strands.
            prepared.push(maker.make(dressed.parameters.hair).map_err(refused)?);
        }
        Ok(Models { prepared, by_strand, table })
    }

    /// The medulla's table, where there is one.
    pub fn table(&self) -> Option<&TableUse> {
        self.table.as_ref()
    }

    /// The model of a strand.
    #[inline]
    pub fn of(&self, strand: u32) -> &FibreBcsdf {
        match self.by_strand.get(strand as usize) {
            Some(&index) => &self.prepared[index as usize],
            None => &self.prepared[0],
        }
    }
}

/// What all models of a groom share: the kind, and the table of the medulla.
struct Maker<'a> {
    parameters: &'a FurParameters,
    kind: Kind,
}

enum Kind {
    Hair,
    Far { nodes: u32 },
    Fur(Option<Found>),
}

impl<'a> Maker<'a> {
    fn new(object: usize, parameters: &'a FurParameters, field: Field) -> Result<Self, RenderError> {
        let fur = parameters.medulla.kappa > 0.0;
        let kind = match field {
            Field::Far { nodes } if fur => {
                let found = format!("{nodes} offsets for fur (kappa {})", parameters.medulla.kappa);
                return Err(RenderError::argument("far field", found, "near field: fur has no far field"));
            }
            Field::Far { nodes } => Kind::Far { nodes },
            Field::Near if fur => {
                let found = medulla_tables::needed(parameters);
                Kind::Fur(found.map_err(|source| RenderError::Table { object, source })?)
            }
            Field::Near => Kind::Hair,
        };
        Ok(Maker { parameters, kind })
    }

    fn table(&self, object: usize) -> Option<TableUse> {
        match &self.kind {
            Kind::Fur(Some(found)) => Some(TableUse::new(object, found)),
            _ => None,
        }
    }

    fn make(&self, hair: HairParameters) -> Result<FibreBcsdf, ScatteringError> {
        Ok(match &self.kind {
            Kind::Hair => FibreBcsdf::Hair(HairBcsdf::new(&hair)?),
            Kind::Far { nodes } => FibreBcsdf::FarField(FarFieldBcsdf::new(&hair, *nodes)?),
            Kind::Fur(found) => {
                let table = found.as_ref().map(|found| Arc::clone(&found.table));
                let parameters = FurParameters { hair, ..*self.parameters };
                FibreBcsdf::Fur(FurBcsdf::new(&parameters, table)?)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use fibre_material::Varying;
    use fibre_scattering::Absorption;
    use glam::Vec3;

    use super::*;

    fn dressed(roughness: Option<Vec<[f32; 2]>>) -> Dressed {
        Dressed {
            parameters: FurParameters::default(),
            absorption: Varying::Constant(Absorption::default()),
            roughness,
            field: Field::Near,
        }
    }

    #[test]
    fn every_strand_has_its_own_roughness_and_shares_it() {
        let roughness = vec![[0.1, 0.2], [0.3, 0.3], [0.1, 0.2], [0.1, 0.3]];
        let models = Models::new(0, &dressed(Some(roughness.clone()))).unwrap();
        assert_eq!(models.prepared.len(), 3);
        let (wo, wi) = (Vec3::new(0.28, 0.96, 0.0), Vec3::new(-0.48, 0.64, 0.6));
        for (strand, [beta_m, beta_n]) in roughness.into_iter().enumerate() {
            let own = HairBcsdf::new(&HairParameters { beta_m, beta_n, ..Default::default() }).unwrap();
            let found = models.of(strand as u32).at(wo, 0.3, Absorption::default());
            assert_eq!(found.evaluate_with_pdf(wi), own.at(wo, 0.3).evaluate_with_pdf(wi), "{strand}");
        }
    }

    #[test]
    fn one_roughness_needs_one_model_and_bad_ones_are_refused() {
        let same = Models::new(0, &dressed(Some(vec![[0.2, 0.4]; 9]))).unwrap();
        assert!(same.prepared.len() == 1 && same.by_strand.is_empty());
        let Err(refused) = Models::new(3, &dressed(Some(vec![[0.2, 0.4], [0.2, f32::NAN]]))) else {
            panic!("taken");
        };
        assert!(matches!(refused, RenderError::Scattering { object: 3, .. }));
        assert_eq!(Models::new(0, &dressed(Some(vec![]))).unwrap().prepared.len(), 1);
        let mut fur = dressed(None);
        fur.field = Field::Far { nodes: 8 };
        fur.parameters.medulla.kappa = 0.5;
        assert!(Models::new(0, &fur).unwrap_err().to_string().contains("far field"));
    }
}
