//! A material of fibres.

use fibre_scattering::{FurParameters, HairParameters, Medulla};

use crate::painter::Painter;
use crate::{HairColor, MaterialError, PigmentSet, Variation};

/// How the strands of a groom scatter light, as people describe it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Roughness, tilt, refractive index, film and lobe weights; its `sigma_a` is replaced by `color`.
    pub parameters: HairParameters,
    /// Where the absorption of the cortex comes from.
    pub color: HairColor,
    /// What a unit of melanin, eumelanin or pheomelanin absorbs.
    pub pigments: PigmentSet,
    /// The core of fur; none for hair.
    pub medulla: Medulla,
    /// Whether the medulla absorbs as the cortex around it does; its own `sigma_a` then does not count.
    pub medulla_as_cortex: bool,
    /// How strands differ, and change along their length.
    pub variation: Variation,
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

impl Material {
    /// The material's fibre where there is no groom: no variation, the fallback of what the groom would say,
    /// the mean of a picture, half way along what runs from root to tip.
    ///
    /// # Errors
    /// [`MaterialError`] names the first value out of range.
    pub fn constant(&self) -> Result<FurParameters, MaterialError> {
        let absorption = Painter::without_groom(self)?.mean()?;
        let mut parameters = FurParameters { hair: self.parameters, medulla: self.medulla };
        (parameters.hair.sigma_a, parameters.medulla.sigma_a) = (absorption.cortex(), absorption.medulla());
        parameters.check()?;
        Ok(parameters)
    }

    /// Checks what can be checked without a groom.
    ///
    /// # Errors
    /// [`MaterialError`] names the first value out of range.
    pub fn check(&self) -> Result<(), MaterialError> {
        self.variation.check()?;
        self.variation_fits()?;
        if let Field::Far { nodes } = self.field
            && !(1..=64).contains(&nodes)
        {
            return Err(MaterialError::value("nodes", nodes, "1..=64"));
        }
        self.constant().map(drop)
    }

    /// Whether the variation asked for means anything for this colour and keeps the roughness in its range.
    fn variation_fits(&self) -> Result<(), MaterialError> {
        let Variation { redness, hue, value, roughness, along, .. } = &self.variation;
        let is_melanin = matches!(self.color, HairColor::Melanin { .. } | HairColor::GroomMelanin { .. });
        let has_redness = is_melanin || matches!(self.color, HairColor::Pigments { .. });
        let is_fitted = self.color.is_fitted();
        let needs = |bad: bool, what: &str, found: f32, expected| {
            if bad { Err(MaterialError::value(what, found, expected)) } else { Ok(()) }
        };
        let colors = "0: it is for color, color_ramp, texture and groom colours (redness is for pigments)";
        needs(*hue > 0.0 && !is_fitted, "variation.hue", (360.0 * hue).round(), colors)?;
        needs(*value > 0.0 && !is_fitted, "variation.value", *value, colors)?;
        let pigments = "0: it is for melanin and pigments (hue is for colours)";
        needs(*redness > 0.0 && !has_redness, "variation.redness", *redness, pigments)?;
        if along.melanin.is_some() && !is_melanin {
            let expected = "melanin as the colour (along.absorption is for everything)";
            return Err(MaterialError::value("along.melanin", "there", expected));
        }
        for (name, beta) in [("beta_m", self.parameters.beta_m), ("beta_n", self.parameters.beta_n)] {
            let (least, most) = (beta * (1.0 - roughness), beta * (1.0 + roughness));
            if *roughness > 0.0 && !(least >= 0.001 && most <= 1.0) {
                let found = format!("{roughness}, which takes {name} from {least:.4} to {most:.4}");
                return Err(MaterialError::value(
                    "variation.roughness",
                    found,
                    "0.001..1 for both roughnesses",
                ));
            }
        }
        Ok(())
    }
}
