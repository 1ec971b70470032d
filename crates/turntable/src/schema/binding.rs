//! How strands are bound to a mesh that moves.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Strands bound by their roots to the mesh, which carries them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Bind {
    /// How a strand finds its place on the mesh.
    pub by: BindBy,
    /// How a strand follows its place.
    pub mode: BindMode,
    /// Blended strands keep the lengths of their segments.
    pub keep_length: bool,
    /// Push points out of the mesh where they enter it, this far off it, in the mesh's unit.
    #[schemars(range(min = 0.0))]
    pub avoid_penetration: Option<f64>,
    /// Strands whose root is farther from the mesh than this are told of, in the mesh's unit.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub limit: Option<f64>,
    /// What is done with strands beyond the limit.
    pub beyond: Beyond,
    /// Strands whose root moves farther than this in a frame jump: nothing of it is blurred.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub teleport: Option<f64>,
    /// The pose the strands were made for.
    pub rest: Rest,
    /// Multiply points and widths of the groom before it is bound, after its unit and up axis are the mesh's.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub scale: Option<f64>,
    /// Move the groom before it is bound, in the mesh's numbers.
    pub translate: Option<[f64; 3]>,
    /// All of that at once: from the groom's numbers to the mesh's, row by row, for column vectors.
    pub matrix: Option<[[f64; 4]; 4]>,
}

impl Default for Bind {
    fn default() -> Self {
        Bind {
            by: BindBy::Nearest,
            mode: BindMode::Rigid,
            keep_length: false,
            avoid_penetration: None,
            limit: None,
            beyond: Beyond::Keep,
            teleport: None,
            rest: Rest::Bind,
            scale: None,
            translate: None,
            matrix: None,
        }
    }
}

/// What says where a strand belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum BindBy {
    /// The place nearest to its root.
    Nearest,
    /// Its attribute `root_uv`, looked up on the mesh.
    Uv,
    /// Its attribute `root_triangle`, the number of a triangle of the mesh from 0.
    Id,
}

/// How a strand follows its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum BindMode {
    /// As one piece: lengths and shape are kept.
    Rigid,
    /// The root rigidly, the tip with the mesh around it.
    Blended,
}

/// What is done with strands too far from the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Beyond {
    /// They are bound all the same.
    Keep,
    /// They are moved onto the mesh.
    Snap,
    /// They are left out.
    Drop,
}

/// The pose that strands were made for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase", expecting = "expected `bind`, `nodes` or the number of a frame")]
pub enum Rest {
    /// A skinned mesh as it was modelled.
    Bind,
    /// As the file stands.
    Nodes,
    /// At this frame.
    #[serde(untagged)]
    Frame(f64),
}
