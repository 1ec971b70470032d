//! What a material file may say: every key, its type and its unit.
//!
//! Plain data; what it comes to, and its ranges, are `build.rs`'s work.

use std::path::PathBuf;

use fibre_scattering::Pigments;
use serde::{Deserialize, Serialize};

use crate::import::{
    ArnoldBlock, CyclesBlock, Import, MaterialXBlock, MitsubaBlock, PbrtBlock, RenderManBlock,
};

/// A material in words: what a material file holds, or the `material` of a pipeline. Every key may be left
/// out; unknown ones are refused.
///
/// The colour is said in one way: `color`, `absorption`, `melanin` (with `redness`), `eumelanin` and
/// `pheomelanin`, `groom`, `texture` or `color_ramp`. Without any, the groom's own colour counts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct MaterialFile {
    /// Begin with this preset; the other keys change it.
    pub preset: Option<String>,
    /// Begin with this material file, relative to the one that names it; the other keys change it.
    pub file: Option<PathBuf>,

    /// Colour of many strands seen together, linear Rec. 709, 0..1.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0, max = 1.0))))]
    pub color: Option<[f32; 3]>,
    /// Absorption per fibre radius, at least 0.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0))))]
    pub absorption: Option<[f32; 3]>,
    /// Pigment, perceptually even: 0 white, 0.1 to 0.3 blond, 1 black.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub melanin: Option<f32>,
    /// Share of red pigment, 0..1; needs `melanin`.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub redness: Option<f32>,
    /// Concentration of the brown to black pigment: about 0.3 blond, 1.3 brown, 8 black.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10_000.0)))]
    pub eumelanin: Option<f32>,
    /// Concentration of the yellow to red pigment.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10_000.0)))]
    pub pheomelanin: Option<f32>,
    /// What a unit of pigment absorbs: `deon` (pbrt, Mitsuba, MaterialX) or `cycles`.
    pub pigments: Option<PigmentSet>,
    /// The groom's own attributes.
    pub groom: Option<GroomColor>,
    /// A picture at the strands' `root_uv`.
    pub texture: Option<TextureFile>,
    /// Colours from root to tip: how far along (0 to 1) and the colour there.
    pub color_ramp: Option<Vec<(f32, [f32; 3])>>,

    /// Roughness along the fibre, 0.001..1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1.0)))]
    pub beta_m: Option<f32>,
    /// Roughness around the fibre, 0.001..1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1.0)))]
    pub beta_n: Option<f32>,
    /// How much rougher TT and TRT are than R along the fibre.
    pub roughness_scales: Option<ScalesFile>,
    /// Tilt of the cuticle's scales in degrees, above 0 for real hair.
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = -90, "exclusiveMaximum" = 90)))]
    pub alpha: Option<f32>,
    /// Index of refraction, 1.0001..3.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0001, max = 3.0)))]
    pub eta: Option<f32>,
    /// Factors on the lobes; 1 is physical.
    pub lobes: Option<LobesFile>,
    /// Whether a film of water is over the fibre.
    pub wet: Option<bool>,
    /// What the film is like; stating it makes the fibre wet.
    pub film: Option<FilmFile>,
    /// Layers of cuticle scales as Yan et al. 2017 count them, 0.01..100.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
    pub cuticle_layers: Option<f32>,
    /// Smaller over larger axis of the cross-section, 0.1..1; 1 is round.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 1.0)))]
    pub aspect: Option<f32>,

    /// The core of fur by its physical parameters.
    pub medulla: Option<MedullaFile>,
    /// The core of fur by the friendly controls.
    pub fur: Option<FurFile>,

    /// How strands differ.
    pub variation: Option<VariationFile>,
    /// What changes from root to tip.
    pub along: Option<AlongFile>,

    /// A fibre as Blender's Cycles describes it; of this and the next five at most one. Other keys change it.
    pub cycles: Option<CyclesBlock>,
    /// As MaterialX's `chiang_hair_bsdf` describes it.
    pub materialx: Option<MaterialXBlock>,
    /// As pbrt-v4 describes it.
    pub pbrt: Option<PbrtBlock>,
    /// As Mitsuba 3 describes it.
    pub mitsuba: Option<MitsubaBlock>,
    /// As Arnold's `standard_hair` describes it.
    pub arnold: Option<ArnoldBlock>,
    /// As RenderMan's `PxrMarschnerHair` describes it.
    pub renderman: Option<RenderManBlock>,

    /// `near`, every hit with its own offset across the fibre, or `far`, offsets integrated out.
    pub field: Option<FieldName>,
    /// Offsets in the far field's quadrature, 1..=64; needs `field: far`.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 64)))]
    pub nodes: Option<u32>,
}

/// What a unit of pigment absorbs: programs disagree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum PigmentSet {
    /// d'Eon et al. 2011: pbrt, Mitsuba, MaterialX.
    #[default]
    Deon,
    /// Blender's Cycles.
    Cycles,
}

impl PigmentSet {
    /// The figures.
    #[must_use]
    pub fn pigments(self) -> Pigments {
        match self {
            PigmentSet::Deon => Pigments::DEON,
            PigmentSet::Cycles => Pigments::CYCLES,
        }
    }
}

impl MaterialFile {
    /// The blocks of other programs that are there.
    pub(crate) fn imports(&self) -> Vec<Import> {
        let all = [
            self.cycles.map(Import::Cycles),
            self.materialx.map(Import::MaterialX),
            self.pbrt.map(Import::Pbrt),
            self.mitsuba.map(Import::Mitsuba),
            self.arnold.map(Import::Arnold),
            self.renderman.map(Import::RenderMan),
        ];
        all.into_iter().flatten().collect()
    }
}

/// Colour from the groom's attributes: `color`, or `melanin` and `redness` where `melanin` is said here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct GroomColor {
    /// What a groom without `color` gets.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0, max = 1.0))))]
    pub color: Option<[f32; 3]>,
    /// What a groom without `melanin` gets.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub melanin: Option<f32>,
    /// What a groom without `redness` gets.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub redness: Option<f32>,
}

/// A picture at the strands' `root_uv`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct TextureFile {
    /// A `.png` (sRGB) or `.hdr` (linear), relative to the material file.
    pub file: PathBuf,
    /// Which way v runs.
    pub v: VDirection,
}

/// Where v = 0 is in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum VDirection {
    /// At the bottom: USD, Blender, Houdini.
    #[default]
    Up,
    /// At the top: glTF.
    Down,
}

/// Factors on the roughness along the fibre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct ScalesFile {
    /// Of TT, 0.1..8; 0.5 when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 8.0)))]
    pub tt: Option<f32>,
    /// Of TRT and the residual, 0.1..8; 2 when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 8.0)))]
    pub trt: Option<f32>,
}

/// Factors on the lobes, 1 when absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct LobesFile {
    /// Reflected at the surface.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    #[serde(rename = "R")]
    pub r: Option<f32>,
    /// Transmitted twice.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    #[serde(rename = "TT")]
    pub tt: Option<f32>,
    /// Reflected once inside.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    #[serde(rename = "TRT")]
    pub trt: Option<f32>,
    /// Reflected twice or more inside.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub residual: Option<f32>,
    /// Scattered by the medulla.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub scattered: Option<f32>,
}

/// A film of water.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct FilmFile {
    /// Index of refraction, 1.0001..3; 1.33 when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0001, max = 3.0)))]
    pub eta: Option<f32>,
    /// Roughness of its surface, 0.001..1; 0.1 when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1.0)))]
    pub roughness: Option<f32>,
}

/// The core of fur: Yan et al. 2017. What is absent is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct MedullaFile {
    /// Radius of the medulla over that of the fibre, 0..0.99.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.99)))]
    pub kappa: Option<f32>,
    /// Scattering per fibre radius, 0..100.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 100.0)))]
    pub sigma_s: Option<f32>,
    /// Absorption per fibre radius, at least 0.
    pub sigma_a: Option<[f32; 3]>,
    /// Mean cosine of the phase function, -0.99..0.99.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.99, max = 0.99)))]
    pub g: Option<f32>,
}

/// The core of fur by the controls of [`crate::FurControls`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct FurFile {
    /// Colour of the cortex: another name for the material's `color`.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0, max = 1.0))))]
    pub base_color: Option<[f32; 3]>,
    /// Colour of the medulla; as the cortex when absent.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0, max = 1.0))))]
    pub medulla_color: Option<[f32; 3]>,
    /// How much of the fibre is medulla, 0..1; 0.5 when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub medulla_index: Option<f32>,
    /// How much it scatters, 0..5; 0.065 when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 5.0)))]
    pub medulla_scattering: Option<f32>,
    /// Layers of cuticle scales, 0.01..100.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
    pub cuticle_layers: Option<f32>,
}

/// How strands differ: see [`crate::Variation`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct VariationFile {
    /// Everything random follows from it; 0 when absent.
    pub seed: Option<u64>,
    /// Amount of the factor on the pigment, 0..1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub pigment: Option<f32>,
    /// How far redness moves, 0..1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub redness: Option<f32>,
    /// How far the hue turns to either side, degrees.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 180.0)))]
    pub hue: Option<f32>,
    /// Amount of the factor on the colour's value, 0..1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub value: Option<f32>,
    /// Amount of the factor on the roughness, 0..0.99.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.99)))]
    pub roughness: Option<f32>,
    /// Share of white hairs, 0..1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub white: Option<f32>,
    /// Melanin of white hairs, 0..1; none when absent.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub white_melanin: Option<f32>,
    /// Colour of white hairs.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0, max = 1.0))))]
    pub white_color: Option<[f32; 3]>,
}

/// Factors from root to tip: how far along (0 to 1) and the factor there, at least 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct AlongFile {
    /// On the absorption.
    pub absorption: Option<Vec<(f32, f32)>>,
    /// On the concentration of melanin.
    pub melanin: Option<Vec<(f32, f32)>>,
}

/// How wide a fibre is on the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum FieldName {
    /// Every hit has its own offset across the fibre.
    Near,
    /// The offset is integrated out.
    Far,
}
