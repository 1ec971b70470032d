//! Where the absorption of the cortex comes from.

use fibre_scattering::{absorption_from_color, absorption_from_melanin};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};

use crate::{MaterialError, Varying};

/// Where the absorption of the fibres comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HairColor {
    /// The groom's `color` attribute through Chiang's fit, per groom, strand or vertex; the colour
    /// given here where the groom has none.
    Groom {
        /// Linear Rec. 709, used when the groom has no `color`.
        fallback: Vec3,
    },
    /// One colour, linear Rec. 709 in 0..1, through Chiang's fit: the albedo of a thick assembly.
    Color(Vec3),
    /// Melanin concentration (0..1) and redness (0..1).
    Melanin {
        /// How much pigment, 0 (white) .. 1 (black).
        concentration: f32,
        /// Share of pheomelanin, 0 .. 1.
        redness: f32,
    },
    /// Absorption per fibre radius, at least 0, as it is in `HairParameters::sigma_a`.
    Absorption(Vec3),
}

impl Default for HairColor {
    /// The groom's own colour; a light brown where it has none.
    fn default() -> Self {
        HairColor::Groom { fallback: Vec3::new(0.42, 0.24, 0.12) }
    }
}

/// The cortex's absorption over a groom.
pub(crate) fn absorption(
    groom: &Groom,
    color: HairColor,
    beta_n: f32,
) -> Result<Varying<Vec3>, MaterialError> {
    Ok(match color {
        HairColor::Absorption(sigma) => Varying::Constant(sigma),
        HairColor::Melanin { concentration, redness } => {
            for (what, value) in [("melanin concentration", concentration), ("melanin redness", redness)] {
                if !(0.0..=1.0).contains(&value) {
                    return Err(MaterialError::value(what, value, "0..1"));
                }
            }
            Varying::Constant(absorption_from_melanin(concentration, redness)?)
        }
        HairColor::Color(color) => Varying::Constant(absorption_from_color(checked(color)?, beta_n)?),
        HairColor::Groom { fallback } => match groom.attribute(names::COLOR) {
            Some(Attribute { domain, values: Values::Vec3(colors) }) => by_color(*domain, colors, beta_n)?,
            _ => Varying::Constant(absorption_from_color(checked(fallback)?, beta_n)?),
        },
    })
}

/// Colours turned into absorption, kept once when they are all the same.
fn by_color(domain: Domain, colors: &[Vec3], beta_n: f32) -> Result<Varying<Vec3>, MaterialError> {
    let first = checked(colors.first().copied().unwrap_or(Vec3::ONE))?;
    if colors.iter().all(|&color| color == first) {
        return Ok(Varying::Constant(absorption_from_color(first, beta_n)?));
    }
    let sigmas: Result<Vec<_>, MaterialError> =
        colors.iter().map(|&color| Ok(absorption_from_color(checked(color)?, beta_n)?)).collect();
    Ok(Varying::new(domain, sigmas?).unwrap_or(Varying::Constant(Vec3::ZERO)))
}

fn checked(color: Vec3) -> Result<Vec3, MaterialError> {
    if color.is_finite() && color.min_element() >= 0.0 {
        Ok(color.min(Vec3::ONE))
    } else {
        Err(MaterialError::value("hair colour", color, "finite, 0..1"))
    }
}
