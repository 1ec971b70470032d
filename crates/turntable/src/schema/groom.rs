//! Where the strands come from.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the strands come from: a file or a made-up sample, one of the two.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GroomSource {
    /// A groom file, relative to the pipeline file.
    pub file: Option<PathBuf>,
    /// A groom the program makes itself.
    pub sample: Option<SampleSource>,
    /// Which axis of the file points up; the file's own word when absent.
    pub up: Option<Axis>,
    /// Metres in one unit of the file; the file's own word, or 1, when absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub meters_per_unit: Option<f64>,
    /// Mend what is merely odd in a file (zero-length segments, one-point strands).
    pub repair: bool,
}

/// A groom the program makes itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SampleSource {
    /// Kind of hair.
    pub style: Style,
    /// How many strands.
    #[schemars(range(min = 1, max = 4_000_000))]
    pub strands: u32,
    /// Points a strand.
    #[schemars(range(min = 3, max = 1000))]
    pub points: u32,
    /// Everything random follows from it.
    pub seed: u64,
    /// Of fur: length of the longest strand as a part of the mesh's diagonal, over 0, up to 1; 0.03 when absent.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub length: Option<f32>,
    /// Of fur: 0 stands up from the skin, 1 lies along it at the tip; 0.8 when absent.
    #[schemars(range(min = 0, max = 1))]
    pub lean: Option<f32>,
    /// Of fur: how far strands wind round their own course, as a part of their length, 0..1; 0.02 when absent.
    #[schemars(range(min = 0, max = 1))]
    pub curl: Option<f32>,
    /// Of fur: how much tips gather in tufts, 0..1; 0.4 when absent.
    #[schemars(range(min = 0, max = 1))]
    pub clump: Option<f32>,
}

impl Default for SampleSource {
    fn default() -> Self {
        SampleSource {
            style: Style::Wavy,
            strands: 5000,
            points: 24,
            seed: 1,
            length: None,
            lean: None,
            curl: None,
            clump: None,
        }
    }
}

/// Kind of made-up hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Style {
    /// Straight hair.
    Straight,
    /// Wavy hair.
    Wavy,
    /// Curly hair.
    Curly,
    /// Fur all over the pipeline's `mesh`, in its unit and axes.
    Fur,
}

/// An axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}
