//! How the groom is framed.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the groom is framed: from a circle about the target, from one place (`position`), or as a camera of a scene
/// file sees it (`file`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraSettings {
    /// Vertical field of view, degrees.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 180))]
    pub fov: f64,
    /// Angle above the horizon, degrees.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub elevation: f64,
    /// Angle above the horizon at the last frame; `elevation` throughout when absent.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub elevation_to: Option<f64>,
    /// Distance to the target in metres; far enough for everything that is seen in any picture to fit when absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub distance: Option<f64>,
    /// Factor on the size in the picture when the distance is fitted.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub zoom: f64,
    /// What is looked at, in world metres, Y up; the middle of the scene, and of its motion, when absent.
    pub target: Option<[f64; 3]>,
    /// Where the camera stands, in world metres, Y up: it looks at the target from there in every frame.
    pub position: Option<[f64; 3]>,
    /// A camera of a glTF or USD file, with its own animation; all other keys of the camera are then left out.
    pub file: Option<CameraFile>,
    /// Whether the turn itself is blurred while the shutter is open.
    pub blur: bool,
}

impl Default for CameraSettings {
    fn default() -> Self {
        CameraSettings {
            fov: 30.0,
            elevation: 5.0,
            elevation_to: None,
            distance: None,
            zoom: 1.0,
            target: None,
            position: None,
            file: None,
            blur: false,
        }
    }
}

/// A camera of a scene file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraFile {
    /// `.gltf`, `.glb`, `.usda`, `.usdc` or `.usdz`, relative to the pipeline file.
    pub path: PathBuf,
    /// Its name (glTF), its path or the last of it (USD), or its number from 0; the first when absent.
    pub name: Option<String>,
    /// Which animation moves it, by name or by number from 0 (glTF); the first that does when absent.
    pub animation: Option<String>,
}
