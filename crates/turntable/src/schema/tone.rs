//! From light to display colours.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// From light to display colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Tone {
    /// Stops: each doubles the light.
    #[schemars(range(min = -64.0, max = 64.0))]
    pub exposure: f32,
    /// How bright values are brought into 0..1.
    pub curve: ToneCurve,
    /// What lies behind transparent frames, linear Rec. 709; exposure and curve leave it alone.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub background: [f32; 3],
    /// Also write every frame as a PNG beside its EXR.
    pub frames: bool,
}

impl Default for Tone {
    fn default() -> Self {
        Tone { exposure: 0.0, curve: ToneCurve::Neutral, background: [0.18; 3], frames: false }
    }
}

/// How bright values are brought into 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ToneCurve {
    /// Khronos PBR Neutral: true colours, soft highlights.
    Neutral,
    /// Cut off at 1.
    Clip,
}
