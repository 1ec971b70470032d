//! What shines.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What shines.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Lights {
    /// Light from all around.
    pub environment: Option<EnvironmentSource>,
    /// Shining rectangles.
    pub area: Vec<AreaSource>,
    /// A Cornell box around everything: white walls, a red one, a green one, a light in the ceiling.
    pub cornell: Option<CornellBox>,
}

/// Light from all around: one of `file`, `constant` or `studio: true`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentSource {
    /// An equirectangular `.hdr` or `.exr`, relative to the pipeline file.
    pub file: Option<PathBuf>,
    /// The same radiance from everywhere.
    #[schemars(inner(range(min = 0.0)))]
    pub constant: Option<[f32; 3]>,
    /// A studio the program makes itself: soft boxes over a grey room.
    pub studio: bool,
    /// Turn about the up axis, degrees.
    pub rotation: f32,
    /// Factor on the radiance.
    #[schemars(range(min = 0.0))]
    pub intensity: f32,
}

impl Default for EnvironmentSource {
    fn default() -> Self {
        EnvironmentSource { file: None, constant: None, studio: false, rotation: 0.0, intensity: 1.0 }
    }
}

/// A rectangle that shines from its front, in world metres, Y up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AreaSource {
    /// Its middle, metres.
    pub position: [f64; 3],
    /// The point its front looks at, metres.
    pub target: [f64; 3],
    /// Width and height, metres.
    pub size: [f32; 2],
    /// Radiance, linear Rec. 709.
    #[schemars(inner(range(min = 0.0)))]
    pub radiance: [f32; 3],
    /// Whether the camera sees its front.
    pub visible_camera: bool,
}

impl Default for AreaSource {
    fn default() -> Self {
        AreaSource {
            position: [1.0, 1.0, 1.0],
            target: [0.0; 3],
            size: [0.5, 0.5],
            radiance: [5.0; 3],
            visible_camera: false,
        }
    }
}

/// A Cornell box: five walls and a light in the ceiling, open towards azimuth 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CornellBox {
    /// Edge over the largest edge of what stands in it.
    #[schemars(extend("exclusiveMinimum" = 1, "maximum" = 1000))]
    pub room: f64,
    /// Factor on the light's radiance.
    #[schemars(range(min = 0.0))]
    pub intensity: f32,
    /// Whether the camera sees the light.
    pub visible_camera: bool,
}

impl Default for CornellBox {
    fn default() -> Self {
        CornellBox { room: 1.8, intensity: 1.0, visible_camera: true }
    }
}
