//! The contact sheet.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The contact sheet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sheet {
    /// The PNG, in the output folder.
    pub file: PathBuf,
    /// Pictures in a row. When absent: about square; where there is a `matrix`, a row for each variant, or, of variants
    /// with one frame, a row for all settings of the last axis.
    #[schemars(range(min = 1))]
    pub columns: Option<u32>,
    /// Pixels between frames.
    #[schemars(range(max = 1024))]
    pub gap: u32,
    /// Write each frame's number in its corner.
    pub labels: bool,
    /// What stands under each picture.
    pub captions: Vec<Caption>,
}

impl Default for Sheet {
    fn default() -> Self {
        Sheet { file: PathBuf::from("sheet.png"), columns: None, gap: 4, labels: true, captions: Vec::new() }
    }
}

/// Something to be written under a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Caption {
    /// The names of the variant's settings; letters outside of Latin-1 show as `?`.
    Variant,
    /// The frame's number.
    Frame,
    /// The estimated relative error.
    Error,
    /// Seconds the frame took to render.
    Seconds,
}
