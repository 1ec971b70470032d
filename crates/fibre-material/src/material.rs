//! A material of fibres, and what it comes to on one groom.

use fibre_scattering::{Absorption, FurParameters, HairParameters, Medulla};
use groom::Groom;

use crate::{HairColor, MaterialError, Varying, color};

/// How the strands of a groom scatter light, as people describe it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Roughness, tilt, refractive index, film and lobe weights; its `sigma_a` is replaced by `color`.
    pub parameters: HairParameters,
    /// Where the absorption of the cortex comes from.
    pub color: HairColor,
    /// The core of fur; none for hair.
    pub medulla: Medulla,
    /// Whether fibres are seen near or from afar.
    pub field: Field,
}

/// How wide a fibre is on the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Field {
    /// Every hit has its own offset across the fibre.
    #[default]
    Near,
    /// The offset is integrated out, by so many nodes (1..=64).
    Far {
        /// Offsets in the quadrature.
        nodes: u32,
    },
}

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
    /// The material on the strands of `groom`.
    ///
    /// # Errors
    /// [`MaterialError`] names the first value out of range.
    pub fn dress(&self, groom: &Groom) -> Result<Dressed, MaterialError> {
        let cortex = color::absorption(groom, self.color, self.parameters.beta_n)?;
        let medulla = self.medulla.sigma_a;
        let both = |cortex| Absorption::new(cortex, medulla);
        let absorption = match cortex {
            Varying::Constant(cortex) => Varying::Constant(both(cortex)?),
            Varying::Strand(all) => Varying::Strand(all.into_iter().map(both).collect::<Result<_, _>>()?),
            Varying::Vertex(all) => Varying::Vertex(all.into_iter().map(both).collect::<Result<_, _>>()?),
        };
        let constant = match absorption {
            Varying::Constant(absorption) => absorption,
            _ => Absorption::default(),
        };
        let mut parameters = FurParameters { hair: self.parameters, medulla: self.medulla };
        (parameters.hair.sigma_a, parameters.medulla.sigma_a) = (constant.cortex(), constant.medulla());
        parameters.check()?;
        Ok(Dressed { parameters, absorption, roughness: None, field: self.field })
    }
}
