//! What stands before the camera, for every frame of a variant.

pub(crate) mod ingredients;
pub(crate) mod material;
mod prepare;
mod scene;
pub(crate) mod views;

use std::path::Path;

use groom::Groom;
use hair_render::{MovingCamera, Scene};

pub(crate) use scene::{render_settings, tone_mapping};

use crate::schema::Pipeline;
use crate::{Event, Reporter, TurntableError};

/// The groom of a variant: read or made up, then changed as the pipeline says.
pub(crate) fn groom(
    pipeline: &Pipeline,
    base: &Path,
    reporter: &dyn Reporter,
) -> Result<Groom, TurntableError> {
    reporter.event(&Event::Stage("preparing the groom"));
    prepare::groom(base, &pipeline.groom, &pipeline.attributes, reporter)
}

/// Everything that the frames of a variant have in common, loaded once.
pub(crate) struct Stage {
    pipeline: Pipeline,
    scene: scene::Lit,
}

/// One frame, ready to be rendered.
pub(crate) struct View<'a> {
    pub scene: &'a Scene,
    pub camera: MovingCamera,
    /// Frames a second, where something moves.
    pub frame_rate: Option<f64>,
    /// How long the shutter is open, where something moves.
    pub exposure_seconds: Option<f64>,
}

impl Stage {
    /// Loads what the frames of a variant need.
    pub fn set(pipeline: &Pipeline, base: &Path, reporter: &dyn Reporter) -> Result<Stage, TurntableError> {
        let groom = groom(pipeline, base, reporter)?;
        reporter.event(&Event::Stage("building the scene"));
        let scene = scene::Lit::set(groom, pipeline, base)?;
        Ok(Stage { pipeline: pipeline.clone(), scene })
    }

    /// Frame `number`, from 1.
    pub fn view(&mut self, number: u32) -> Result<View<'_>, TurntableError> {
        let azimuth = views::azimuth(&self.pipeline.turntable, number);
        let render = &self.pipeline.render;
        let aspect = f64::from(render.width) / f64::from(render.height);
        let scene = self.scene.scene(azimuth.to_radians())?;
        let camera = scene::camera(scene, &self.pipeline.camera, azimuth, aspect)?;
        Ok(View { scene, camera: camera.into(), frame_rate: None, exposure_seconds: None })
    }
}
