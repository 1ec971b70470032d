//! A material on a groom.

use fibre_scattering::{Absorption, FurParameters};
use groom::{Domain, Groom};

use crate::painter::{Painter, Place};
use crate::variation::Lot;
use crate::{Field, Material, MaterialError, Varying};

/// A material on a groom: what a renderer needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Dressed {
    /// What is the same for all strands; the absorptions here are those of `absorption` where it is
    /// constant, and 0 elsewhere.
    pub parameters: FurParameters,
    /// Absorption of cortex and medulla.
    pub absorption: Varying<Absorption>,
    /// Longitudinal and azimuthal roughness of each strand, where they differ.
    pub roughness: Option<Vec<[f32; 2]>>,
    /// Near or far.
    pub field: Field,
}

impl Material {
    /// The material on the strands of `groom`. What is the same for all strands is held once, what is the
    /// same along each strand once a strand.
    ///
    /// # Errors
    /// [`MaterialError`] names the first value out of range, and the strand where it is the groom's.
    pub fn dress(&self, groom: &Groom) -> Result<Dressed, MaterialError> {
        self.check()?;
        let absorption = self.absorption(groom)?;
        let constant = match absorption {
            Varying::Constant(absorption) => absorption,
            _ => Absorption::default(),
        };
        let mut parameters = FurParameters { hair: self.parameters, medulla: self.medulla };
        (parameters.hair.sigma_a, parameters.medulla.sigma_a) = (constant.cortex(), constant.medulla());
        parameters.check()?;
        Ok(Dressed { parameters, absorption, roughness: self.roughness(groom), field: self.field })
    }

    fn absorption(&self, groom: &Groom) -> Result<Varying<Absorption>, MaterialError> {
        let painter = Painter::new(self, groom)?;
        let strands = 0..groom.strand_count();
        let lot = |strand| self.variation.lot(groom.strand_id(strand));
        Ok(match painter.domain() {
            Domain::Groom => Varying::Constant(painter.mean()?),
            Domain::Strand => {
                let root =
                    |strand: usize| Place { strand, vertex: groom.strand_range(strand).start, along: 0.0 };
                let all: Result<_, _> = strands.map(|s| painter.at(root(s), &lot(s))).collect();
                Varying::Strand(all?).collapsed(groom.offsets())
            }
            Domain::Vertex => {
                let along = groom.along_strands();
                let mut all = Vec::with_capacity(groom.point_count());
                for strand in strands {
                    let lot = lot(strand);
                    for vertex in groom.strand_range(strand) {
                        let along = along.get(vertex).copied().unwrap_or_default();
                        all.push(painter.at(Place { strand, vertex, along }, &lot)?);
                    }
                }
                Varying::Vertex(all).collapsed(groom.offsets())
            }
        })
    }

    fn roughness(&self, groom: &Groom) -> Option<Vec<[f32; 2]>> {
        let of =
            |Lot { roughness, .. }| [self.parameters.beta_m * roughness, self.parameters.beta_n * roughness];
        let lots = (0..groom.strand_count()).map(|strand| self.variation.lot(groom.strand_id(strand)));
        (self.variation.roughness > 0.0).then(|| lots.map(of).collect())
    }
}
