//! What of a pipeline the groom, the scene and a frame depend on.

use std::path::{Path, PathBuf};

use moving_scene::GroomAt;

use super::{framing, material, sources, views};
use crate::TurntableError;
use crate::digest::{Digest, Ingredients};
use crate::schema::{BlurBy, Pipeline, Style, Turning};

/// Every file that a pipeline reads.
pub(crate) fn files(pipeline: &Pipeline, base: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    let environment = pipeline.lights.environment.as_ref().and_then(|e| e.file.as_ref());
    let named = [environment, pipeline.comp.plate.as_ref()];
    let mut files: Vec<PathBuf> = named.into_iter().flatten().map(|input| base.join(input)).collect();
    files.extend(pipeline.material.files(base)?);
    if let Some(file) = &pipeline.groom.file {
        files.extend(sources::of_groom(file, base)?);
    }
    if let Some(camera) = &pipeline.camera.file {
        files.extend(sources::of_camera(camera, base)?);
    }
    if let Some(mesh) = &pipeline.mesh {
        files.extend(sources::of_mesh(mesh, base)?);
    }
    Ok(files)
}

/// What the groom depends on, as all that is made of it sees it.
pub(crate) fn groom(pipeline: &Pipeline, base: &Path) -> Result<Digest, TurntableError> {
    let source = &pipeline.groom;
    let mut digest = Ingredients::of("groom");
    if let Some(file) = &source.file {
        let ending = file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        digest = digest.word(&ending).files(&sources::of_groom(file, base)?)?;
    }
    if let (Some(sample), Some(mesh)) = (&source.sample, &pipeline.mesh)
        && sample.style == Style::Fur
    {
        digest = digest.files(&sources::of_mesh(mesh, base)?)?;
        let rest = pipeline.bind.as_ref().map(|bind| bind.rest);
        digest = digest.settings(&(mesh.up, mesh.meters_per_unit, rest));
    }
    let settings = (&source.sample, source.up, source.meters_per_unit, source.repair);
    Ok(digest.settings(&settings).settings(&pipeline.attributes).finish())
}

/// What all frames of a variant depend on.
pub(crate) fn scene(pipeline: &Pipeline, groom: &Digest, base: &Path) -> Result<Digest, TurntableError> {
    let mut digest = material::added(Ingredients::of("scene").digest(groom), &pipeline.material, base)?;
    if let Some(mesh) = &pipeline.mesh {
        digest = digest.files(&sources::of_mesh(mesh, base)?)?;
        digest = digest.settings(&(mesh.up, mesh.meters_per_unit, mesh.albedo, mesh.base_colors));
    }
    if pipeline.bind.is_some() {
        digest = digest.settings(&pipeline.bind);
    }
    if may_move(pipeline) {
        let animation = pipeline.mesh.as_ref().and_then(|mesh| mesh.animation.as_ref());
        digest = digest.settings(&(animation, exposure(pipeline)));
    }
    digest = digest.settings(&pipeline.lights.area);
    if let Some(environment) = &pipeline.lights.environment {
        if let Some(file) = &environment.file {
            digest = digest.file(&base.join(file))?;
        }
        let e = environment;
        digest = digest.settings(&(e.constant, e.studio, e.rotation, e.intensity));
    }
    if let Some(cornell) = &pipeline.lights.cornell {
        digest = digest.settings(cornell);
    }
    if let Some(file) = &pipeline.camera.file {
        digest = digest.files(&sources::of_camera(file, base)?)?;
    }
    if pipeline.camera.blur || pipeline.camera.file.is_some() {
        // The scene holds the shutter that the camera is seen through, and the rate says when a frame is.
        digest = digest.settings(&exposure(pipeline));
    }
    Ok(digest.finish())
}

/// What one frame depends on. The view counts, the frame's number and how many there are do not: the same view is
/// the same picture in a turntable of 4 and of 8. The frame of the animation counts where something may move.
pub(crate) fn frame(pipeline: &Pipeline, scene: &Digest, number: u32) -> Digest {
    let digest = Ingredients::of("frame").digest(scene).settings(&pipeline.render);
    let mut digest = digest.settings(&camera(pipeline)).settings(&view(pipeline, number));
    if may_move(pipeline) || pipeline.camera.file.is_some() {
        let step = pipeline.motion.as_ref().map_or(1.0, |motion| motion.step);
        let first = pipeline.motion.as_ref().map(|motion| motion.first);
        digest = digest.settings(&(first, step * f64::from(number - 1)));
    }
    if may_move(pipeline) && framing::is_by_contents(pipeline) {
        // All that is shown is framed.
        digest = digest.settings(&framing::length(pipeline));
    }
    digest.settings(&pipeline.turntable.turn).finish()
}

/// Whether frames may differ by more than their view: as far as names tell, so that nothing has to be opened.
fn may_move(pipeline: &Pipeline) -> bool {
    let groom = pipeline.bind.is_none() && pipeline.groom.file.as_deref().is_some_and(GroomAt::may_move);
    let mesh = pipeline.mesh.as_ref().is_some_and(|mesh| {
        let is_obj = mesh.file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
        !is_obj || mesh.file.to_string_lossy().contains('#')
    });
    pipeline.motion.is_some() && (groom || mesh)
}

/// What is said of the shutter and of blur.
fn exposure(pipeline: &Pipeline) -> impl serde::Serialize + use<'_> {
    let motion = pipeline.motion.as_ref();
    motion.map(|motion| (motion.fps, motion.shutter, &motion.shape, motion.samples, motion.blur))
}

/// What is said of the camera and holds for all views.
fn camera(pipeline: &Pipeline) -> impl serde::Serialize + use<'_> {
    let camera = &pipeline.camera;
    let file = camera.file.as_ref().map(|file| (&file.name, &file.animation));
    let framing = (camera.fov, camera.distance, camera.zoom, camera.target, camera.position);
    // Of a camera of a file nothing else counts.
    (file.is_none().then_some(framing), file, camera.blur)
}

/// Where the camera is, or the groom is turned to, at the frame and through its shutter.
fn view(pipeline: &Pipeline, number: u32) -> Vec<(f64, f64)> {
    let (turn, camera) = (&pipeline.turntable, &pipeline.camera);
    let stays = camera.file.is_some() || camera.position.is_some();
    if stays && turn.turn == Turning::Camera {
        return Vec::new();
    }
    let blurs = pipeline.motion.as_ref().is_none_or(|motion| motion.blur != Some(BlurBy::Off));
    let mut view = vec![(views::azimuth(turn, number), views::elevation(turn, camera, f64::from(number)))];
    if camera.blur && blurs {
        let shutter = pipeline.motion.as_ref().map_or([-0.25, 0.25], |motion| motion.shutter);
        let at = |offset: f64| f64::from(number) + offset;
        view.extend(shutter.map(|o| (views::turned(turn, at(o)), views::elevation(turn, camera, at(o)))));
    }
    view
}
