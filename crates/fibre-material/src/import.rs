//! Hair as other programs describe it, key by key in their names; `fibre_scattering` has the formulas.

use fibre_scattering::{
    ArnoldHair, CyclesHair, CyclesParametrization, HairParameters, MaterialXHair, MitsubaHair, PbrtHair,
    PxrMarschnerHair, ScatteringError,
};
use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::{HairColor, PigmentSet};

/// Puts a value of the file where the other program's struct holds it.
trait Assign<T> {
    fn assign(self, to: &mut T);
}

impl<T> Assign<T> for T {
    fn assign(self, to: &mut T) {
        *to = self;
    }
}

impl Assign<Vec3> for [f32; 3] {
    fn assign(self, to: &mut Vec3) {
        *to = self.into();
    }
}

impl Assign<Option<Vec3>> for [f32; 3] {
    fn assign(self, to: &mut Option<Vec3>) {
        *to = Some(self.into());
    }
}

impl Assign<Option<f32>> for f32 {
    fn assign(self, to: &mut Option<f32>) {
        *to = Some(self);
    }
}

/// An angle the file states in degrees and the other program's struct holds in radians.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Degrees(pub f32);

impl Assign<f32> for Degrees {
    fn assign(self, to: &mut f32) {
        *to = self.0.to_radians();
    }
}

/// Where Cycles takes the absorption from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum CyclesColoring {
    /// Direct coloring.
    Color,
    /// Melanin concentration.
    Melanin,
    /// Absorption coefficient.
    Absorption,
}

impl Assign<CyclesParametrization> for CyclesColoring {
    fn assign(self, to: &mut CyclesParametrization) {
        *to = match self {
            CyclesColoring::Color => CyclesParametrization::Color,
            CyclesColoring::Melanin => CyclesParametrization::Melanin,
            CyclesColoring::Absorption => CyclesParametrization::Absorption,
        };
    }
}

/// A block of a material file: the other program's parameters, each its default when absent.
macro_rules! block {
    ($(#[$doc:meta])* $name:ident of $theirs:ident { $($(#[$attribute:meta])* $field:ident: $kind:ty),+ $(,)? }
     $(beside { $($own:ident: $own_kind:ty),+ })?) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            $(
                #[doc = concat!("[`", stringify!($theirs), "`]'s `", stringify!($field), "`.")]
                $(#[$attribute])*
                pub $field: Option<$kind>,
            )+
            $( $(
                #[doc = concat!("`", stringify!($own), "`, which differs from strand to strand.")]
                pub $own: Option<$own_kind>,
            )+ )?
        }

        impl $name {
            fn theirs(&self) -> $theirs {
                let mut theirs = $theirs::default();
                $( if let Some(value) = self.$field { value.assign(&mut theirs.$field); } )+
                theirs
            }
        }
    };
}

block! {
    /// Blender's *Principled Hair BSDF*, model Chiang; `offset` in degrees, as Blender's panel shows it.
    CyclesBlock of CyclesHair {
        parametrization: CyclesColoring,
        color: [f32; 3],
        melanin: f32,
        melanin_redness: f32,
        tint: [f32; 3],
        absorption_coefficient: [f32; 3],
        roughness: f32,
        radial_roughness: f32,
        coat: f32,
        ior: f32,
        offset: Degrees,
    } beside { random_color: f32, random_roughness: f32 }
}

block! {
    /// MaterialX's `chiang_hair_bsdf`, its roughness as (v, s) pairs.
    MaterialXBlock of MaterialXHair {
        #[serde(rename = "tint_R")]
        tint_r: [f32; 3],
        #[serde(rename = "tint_TT")]
        tint_tt: [f32; 3],
        #[serde(rename = "tint_TRT")]
        tint_trt: [f32; 3],
        ior: f32,
        #[serde(rename = "roughness_R")]
        roughness_r: [f32; 2],
        #[serde(rename = "roughness_TT")]
        roughness_tt: [f32; 2],
        #[serde(rename = "roughness_TRT")]
        roughness_trt: [f32; 2],
        cuticle_angle: f32,
        absorption_coefficient: [f32; 3],
    }
}

block! {
    /// pbrt-v4's `hair`; `alpha` in degrees, with pbrt's sign.
    PbrtBlock of PbrtHair {
        sigma_a: [f32; 3],
        reflectance: [f32; 3],
        eumelanin: f32,
        pheomelanin: f32,
        eta: f32,
        beta_m: f32,
        beta_n: f32,
        alpha: f32,
    }
}

block! {
    /// Mitsuba 3's `hair`; `scale_tilt` in degrees, with Mitsuba's sign.
    MitsubaBlock of MitsubaHair {
        eumelanin: f32,
        pheomelanin: f32,
        sigma_a: [f32; 3],
        scale: f32,
        int_ior: f32,
        ext_ior: f32,
        longitudinal_roughness: f32,
        azimuthal_roughness: f32,
        scale_tilt: f32,
    }
}

block! {
    /// Arnold's `standard_hair`; `shift` in degrees.
    ArnoldBlock of ArnoldHair {
        base: f32,
        base_color: [f32; 3],
        melanin: f32,
        melanin_redness: f32,
        roughness: f32,
        roughness_azimuthal: f32,
        roughness_anisotropic: bool,
        ior: f32,
        shift: f32,
        specular_tint: [f32; 3],
        specular2_tint: [f32; 3],
        transmission_tint: [f32; 3],
        diffuse: f32,
    }
}

block! {
    /// RenderMan's `PxrMarschnerHair`; angles in degrees.
    RenderManBlock of PxrMarschnerHair {
        #[serde(rename = "diffuseGain")]
        diffuse_gain: f32,
        #[serde(rename = "specularGainR")]
        specular_gain_r: f32,
        #[serde(rename = "specularGainTRT")]
        specular_gain_trt: f32,
        #[serde(rename = "specularGainTT")]
        specular_gain_tt: f32,
        #[serde(rename = "specularColorR")]
        specular_color_r: [f32; 3],
        #[serde(rename = "specularColorTRT")]
        specular_color_trt: [f32; 3],
        #[serde(rename = "specularColorTT")]
        specular_color_tt: [f32; 3],
        #[serde(rename = "specularConeAngleR")]
        specular_cone_angle_r: f32,
        #[serde(rename = "specularConeAngleTRT")]
        specular_cone_angle_trt: f32,
        #[serde(rename = "specularConeAngleTT")]
        specular_cone_angle_tt: f32,
        #[serde(rename = "specularOffset")]
        specular_offset: f32,
        #[serde(rename = "specularIor")]
        specular_ior: f32,
        #[serde(rename = "specularGlintWidth")]
        specular_glint_width: f32,
        #[serde(rename = "specularEccentricity")]
        specular_eccentricity: f32,
    }
}

/// A fibre as another program describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Import {
    Cycles(CyclesBlock),
    MaterialX(MaterialXBlock),
    Pbrt(PbrtBlock),
    Mitsuba(MitsubaBlock),
    Arnold(ArnoldBlock),
    RenderMan(RenderManBlock),
}

/// What an import comes to.
pub(crate) struct Imported {
    pub parameters: HairParameters,
    pub color: HairColor,
    pub pigments: PigmentSet,
    /// Amounts of the variation of pigment and roughness.
    pub varied: [f32; 2],
}

impl Import {
    /// The block's key.
    pub fn key(&self) -> &'static str {
        match self {
            Import::Cycles(_) => "cycles",
            Import::MaterialX(_) => "materialx",
            Import::Pbrt(_) => "pbrt",
            Import::Mitsuba(_) => "mitsuba",
            Import::Arnold(_) => "arnold",
            Import::RenderMan(_) => "renderman",
        }
    }

    /// The fibre in this project's parameters. Cycles' colour and melanin stay what they are, so that they can
    /// vary; every other colour comes as absorption.
    pub fn fibre(&self) -> Result<Imported, ScatteringError> {
        let parameters = match self {
            Import::Cycles(block) => return cycles(block),
            Import::MaterialX(block) => block.theirs().parameters()?,
            Import::Pbrt(block) => block.theirs().parameters()?,
            Import::Mitsuba(block) => block.theirs().parameters()?,
            Import::Arnold(block) => block.theirs().parameters()?,
            Import::RenderMan(block) => block.theirs().parameters()?,
        };
        let color = HairColor::Absorption(parameters.sigma_a);
        Ok(Imported { parameters, color, pigments: PigmentSet::Deon, varied: [0.0; 2] })
    }
}

fn cycles(block: &CyclesBlock) -> Result<Imported, ScatteringError> {
    if let Some(Degrees(offset)) = block.offset
        && !(offset > -90.0 && offset < 90.0)
    {
        let range = "(-90, 90) degrees";
        return Err(ScatteringError::OutOfRange { name: "offset", found: offset, range });
    }
    let theirs = block.theirs();
    let parameters = theirs.parameters()?;
    let is_melanin = theirs.parametrization == CyclesParametrization::Melanin;
    let random_color = block.random_color.unwrap_or(0.0);
    let color = match theirs.parametrization {
        CyclesParametrization::Color => HairColor::Color(theirs.color),
        CyclesParametrization::Melanin if theirs.tint == Vec3::ONE => {
            HairColor::Melanin { concentration: theirs.melanin, redness: theirs.melanin_redness }
        }
        CyclesParametrization::Melanin if random_color != 0.0 => {
            let range = "{0} beside a tint: varied melanin under a dye has no counterpart";
            return Err(ScatteringError::OutOfRange { name: "random_color", found: random_color, range });
        }
        _ => HairColor::Absorption(parameters.sigma_a),
    };
    // In Cycles it is the melanin that varies, and nothing else.
    let pigment = if is_melanin { random_color } else { 0.0 };
    let varied = [pigment, block.random_roughness.unwrap_or(0.0)];
    Ok(Imported { parameters, color, pigments: PigmentSet::Cycles, varied })
}
