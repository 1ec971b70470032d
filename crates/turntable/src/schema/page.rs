//! The page that shows the result.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One HTML file with everything to look at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Page {
    /// The page, in the output folder.
    pub file: PathBuf,
    /// Longest edge of a picture in it, pixels; frames that are larger are made smaller.
    #[schemars(range(min = 16, max = 4096))]
    pub size: u32,
    /// Whether it holds the passes of `render.aovs` beside the beauty.
    pub passes: bool,
}

impl Default for Page {
    fn default() -> Self {
        Page { file: PathBuf::from("index.html"), size: 512, passes: true }
    }
}
