//! Which views are taken.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which views are taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Turn {
    /// How many, spread evenly.
    #[schemars(range(min = 1, max = 9999))]
    pub frames: u32,
    /// Azimuth of the first, degrees; 0 looks at the front.
    pub start: f64,
    /// How far the camera goes round, degrees; a full circle does not repeat its start.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub degrees: f64,
    /// What stays with the groom: `camera` turns the camera alone, `groom` turns the groom before
    /// a camera and lights that stand still.
    pub turn: Turning,
    /// How the turn sets off and stops.
    pub ease: Ease,
}

impl Default for Turn {
    fn default() -> Self {
        Turn { frames: 12, start: 0.0, degrees: 360.0, turn: Turning::Camera, ease: Ease::Linear }
    }
}

/// What turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Turning {
    /// The camera goes round; the light stays with the groom.
    Camera,
    /// The groom turns before the camera; the light stays with the camera.
    Groom,
}

/// How a turn sets off and stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Ease {
    /// Evenly: a full circle loops without a jump.
    Linear,
    /// Slowly at both ends (smoothstep), fastest in the middle; the last frame is where the turn ends.
    Smooth,
}
