//! What moves, and how long the shutter is open.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The frames of an animated groom or mesh that are shown, and their blur. Without it everything stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionSettings {
    /// The frame of the animation that the first picture shows; the animation's first when absent.
    pub first: Option<f64>,
    /// Frames of the animation from one picture to the next.
    pub step: f64,
    /// Frames a second; the groom's own, or the mesh's, or 24 when absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub fps: Option<f64>,
    /// When the shutter opens and closes, in frames from the frame itself.
    pub shutter: [f64; 2],
    /// How it opens and closes: `box`, `triangle`, `cosine`, `trapezoid:OPENING,CLOSING` or `curve:HEIGHT,...`.
    pub shape: String,
    /// At how many times the shape of what moves is held; 2, or 3 with accelerations, when absent.
    #[schemars(range(min = 2, max = 255))]
    pub samples: Option<u32>,
    /// What strands are blurred by; the best there is when absent.
    pub blur: Option<BlurBy>,
}

impl Default for MotionSettings {
    fn default() -> Self {
        MotionSettings {
            first: None,
            step: 1.0,
            fps: None,
            shutter: [-0.25, 0.25],
            shape: "box".to_owned(),
            samples: None,
            blur: None,
        }
    }
}

/// What is blurred, and by what.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum BlurBy {
    /// Nothing: every picture is of one instant.
    Off,
    /// Positions at different times.
    Positions,
    /// Positions at the frame, and velocities.
    Velocities,
    /// Velocities and accelerations.
    Accelerations,
}
