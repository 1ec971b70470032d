//! Films of the turntable.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A film of the frames, made by ffmpeg.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Video {
    /// The film, in the output folder (in the variant's folder where there is a `matrix`): `.mp4` or `.mov`.
    pub file: PathBuf,
    /// How it is packed; H.264 for `.mp4` and ProRes 4444 for `.mov` when absent.
    pub codec: Option<Codec>,
    /// Frames a second.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub fps: f64,
    /// How good H.264 looks, 0 (exact) to 51.
    #[schemars(range(max = 51))]
    pub crf: u32,
    /// Whether a machine without ffmpeg is an error; else the film is left out and that is said.
    pub required: bool,
}

impl Default for Video {
    fn default() -> Self {
        Video { file: PathBuf::from("turntable.mp4"), codec: None, fps: 24.0, crf: 18, required: false }
    }
}

/// How a film is packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Codec {
    /// H.264, 8 bits, 4:2:0: plays everywhere.
    H264,
    /// ProRes 4444 with alpha: for editing.
    Prores4444,
}
