//! Where the pictures of a sweep are taken: one groom, one light, one camera.

use glam::DVec3;
use groom::Groom;
use hair_render::{
    Camera, Environment, HairMaterial, HairObject, RenderError, STUDIO_WIDTH, Scene, SceneDescription,
};

/// Degrees the camera stands round the groom, where the sample hair hangs as one sheet, and above it.
const VIEW: [f64; 2] = [125.0, 8.0];

/// A groom in the studio, ready for any material: its tree is built once.
#[derive(Debug)]
pub struct Stage {
    groom: Groom,
    scene: Scene,
}

impl Stage {
    /// Puts `groom` in the studio.
    ///
    /// # Errors
    /// [`RenderError`] for a groom that cannot be traced.
    pub fn new(groom: Groom) -> Result<Stage, RenderError> {
        let scene = Scene::build(SceneDescription {
            hair: vec![HairObject::still(groom.clone(), HairMaterial::default())],
            // The key light keeps its place beside the camera.
            environment: Some(Environment::studio(STUDIO_WIDTH)?.rotated(VIEW[0].to_radians() as f32)),
            ..SceneDescription::default()
        })?;
        Ok(Stage { groom, scene })
    }

    /// Gives the groom another material.
    ///
    /// # Errors
    /// As [`Scene::set_material`].
    pub fn dress(&mut self, material: &HairMaterial) -> Result<(), RenderError> {
        self.scene.set_material(0, &self.groom, material)
    }

    /// The groom as it is lit and dressed now.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The same, to change.
    pub fn scene_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }

    /// The camera: near enough that the groom fills the picture from top to bottom.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for an `aspect` (width over height) that is not above 0.
    pub fn camera(&self, aspect: f64) -> Result<Camera, RenderError> {
        let [azimuth, elevation] = VIEW.map(f64::to_radians);
        let fov = 30_f64.to_radians();
        let fitted = Camera::fit(self.scene.bounds(), azimuth, elevation, fov, aspect)?;
        let (from, at): (DVec3, DVec3) = (fitted.position(), fitted.target());
        // The sphere about the groom leaves room that strands seldom fill.
        Camera::look_at(at + (from - at) * CLOSER, at, DVec3::Y, fov)
    }
}

/// Share of the distance from which the whole sphere about the groom would be seen.
const CLOSER: f64 = 0.8;
