//! A mesh under the strands.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Axis;

/// A matte mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MeshSource {
    /// `.obj`, `.gltf`, `.glb`, `.usda`, `.usdc`, `.usdz` or a sequence `head.####.obj`, relative to the pipeline
    /// file.
    pub file: PathBuf,
    /// Which axis of the file points up; the file's own word when absent.
    pub up: Option<Axis>,
    /// Metres in one unit of the file; the file's own word when absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub meters_per_unit: Option<f64>,
    /// Reflected share of the light, linear Rec. 709.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub albedo: [f32; 3],
    /// Take the base colours of the file's materials instead; of a picture its mean.
    pub base_colors: bool,
    /// Which animation moves it, by name or by number from 0 (glTF); the first when absent. Nothing of it moves
    /// without `motion`.
    pub animation: Option<String>,
}

impl Default for MeshSource {
    fn default() -> Self {
        MeshSource {
            file: PathBuf::new(),
            up: None,
            meters_per_unit: None,
            albedo: [0.5, 0.42, 0.36],
            base_colors: false,
            animation: None,
        }
    }
}
