//! Hair as other systems describe it: their names, units and defaults, turned into [`HairParameters`].
//!
//! One plain struct per system, each with a `parameters` that says where its formula is from and whether it
//! is *exact* (the same model, another spelling) or a *correspondence* (another model, or one whose formulas
//! are not published: the spread or the colour is carried over, not the picture).
//!
//! | system | struct | how |
//! |---|---|---|
//! | Cycles, Principled Hair (Chiang) | [`CyclesHair`] | exact |
//! | pbrt-v4, `hair` | [`PbrtHair`] | exact |
//! | Mitsuba 3, `hair` | [`MitsubaHair`] | exact |
//! | MaterialX, `chiang_hair_bsdf` | [`MaterialXHair`], [`MaterialXRoughness`] | exact, both ways |
//! | Arnold, `standard_hair` | [`ArnoldHair`] | correspondence |
//! | RenderMan, `PxrMarschnerHair` | [`PxrMarschnerHair`] | correspondence by spread |
//!
//! V-Ray's `HairNextMtl` and RenderMan's `PxrHairColor` are not here: nobody has published what their
//! melanin means. What varies from strand to strand (`random_roughness` and the like) belongs to a groom's
//! material and not to one fibre's parameters.
//!
//! [`HairParameters`]: crate::HairParameters

mod arnold;
mod cycles;
mod materialx;
mod mitsuba;
mod pbrt;
mod renderman;
mod roughness;
#[cfg(test)]
mod tests;

pub use arnold::ArnoldHair;
pub use cycles::{CyclesHair, CyclesParametrization};
pub use materialx::{MaterialXHair, MaterialXMelanin, MaterialXRoughness};
pub use mitsuba::MitsubaHair;
pub use pbrt::PbrtHair;
pub use renderman::PxrMarschnerHair;
use roughness::of_spread;
pub use roughness::{beta_m_from_variance, beta_n_from_scale};

use glam::Vec3;

use crate::error::ScatteringError;
use crate::range;

/// The grey a tint amounts to. The model's lobe weights are numbers: a lobe cannot be tinted, other than by
/// absorption.
fn grey(name: &'static str, tint: Vec3) -> Result<f32, ScatteringError> {
    let [red, green, blue] = tint.to_array();
    for channel in [red, green, blue] {
        range::not_negative(name, channel)?;
    }
    if red == green && green == blue {
        Ok(red)
    } else {
        Err(ScatteringError::OutOfRange {
            name,
            found: tint.max_element(),
            range: "greys: the same in red, green and blue",
        })
    }
}

/// A tilt in radians from one in degrees, refused in the degrees it was given in.
fn tilt(name: &'static str, degrees: f32) -> Result<f32, ScatteringError> {
    let range = "(-90, 90) degrees";
    range::tilt(name, degrees.to_radians()).map_err(|_| ScatteringError::OutOfRange {
        name,
        found: degrees,
        range,
    })
}

/// A control this model has no counterpart for: only the value that switches it off.
fn absent(name: &'static str, found: f32, off: f32, range: &'static str) -> Result<(), ScatteringError> {
    if found == off { Ok(()) } else { Err(ScatteringError::OutOfRange { name, found, range }) }
}

/// Two settings of which only one may be given.
fn exclusive(one: (&'static str, bool), other: (&'static str, bool)) -> Result<(), ScatteringError> {
    if one.1 && other.1 { Err(ScatteringError::Conflict { one: one.0, other: other.0 }) } else { Ok(()) }
}
