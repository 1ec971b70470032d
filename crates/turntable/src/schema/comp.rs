//! What is done to finished frames before they are shown.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Passes weighed anew and something put behind, in previews, sheet, video and page; frames stay as they are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Comp {
    /// Factors on passes, by name (`R`, `TT`, `TRT`, ...); a pass that is named must be in `render.aovs`.
    pub weights: BTreeMap<String, f32>,
    /// A picture to put behind transparent frames, `.png`, `.jpg`, `.exr` or `.hdr`, relative to the pipeline file;
    /// `tone.background` where there is none.
    pub plate: Option<PathBuf>,
}
