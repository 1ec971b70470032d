//! What a render does without, and why that changes no pixel.

use crate::{RenderSettings, SceneDescription};

/// Something that was not loaded, built or computed.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    /// What was left out.
    pub what: String,
    /// Why it is not needed.
    pub why: String,
}

/// What rendering `description` with `settings` leaves out.
#[must_use]
pub fn explain(_description: &SceneDescription, _settings: &RenderSettings) -> Vec<LeftOut> {
    Vec::new()
}
