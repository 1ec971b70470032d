//! How a frame is rendered.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a frame is rendered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Render {
    /// Pixels across.
    #[schemars(range(min = 1, max = 65_536))]
    pub width: u32,
    /// Pixels down.
    #[schemars(range(min = 1, max = 65_536))]
    pub height: u32,
    /// Samples a pixel.
    #[schemars(range(min = 1))]
    pub spp: u32,
    /// Everything random follows from it.
    pub seed: u64,
    /// Scatterings after the first before a path is cut.
    pub max_bounces: u32,
    /// Passes beside beauty and alpha: R, TT, TRT, residual, scattered, surface, background.
    pub aovs: Vec<String>,
    /// Leave the environment out of the picture and say by alpha what is covered.
    pub transparent: bool,
    /// How exactly pixels are stored.
    pub precision: Precision,
}

impl Default for Render {
    fn default() -> Self {
        Render {
            width: 512,
            height: 512,
            spp: 64,
            seed: 0,
            max_bounces: 256,
            aovs: Vec::new(),
            transparent: true,
            precision: Precision::Float,
        }
    }
}

/// How exactly pixels are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// 32 bits a channel.
    Float,
    /// 16 bits a channel: half the bytes, three digits.
    Half,
}
