//! What of a pipeline the groom, the scene and a frame depend on.

use std::path::{Path, PathBuf};

use super::{material, views};
use crate::TurntableError;
use crate::digest::{Digest, Ingredients};
use crate::schema::Pipeline;

/// Every file that a pipeline reads.
pub(crate) fn files(pipeline: &Pipeline, base: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    let named = [
        pipeline.groom.file.as_ref(),
        pipeline.mesh.as_ref().map(|m| &m.file),
        pipeline.lights.environment.as_ref().and_then(|e| e.file.as_ref()),
    ];
    let material = pipeline.material.files(base)?;
    Ok(named.into_iter().flatten().map(|input| base.join(input)).chain(material).collect())
}

/// What the groom depends on, as all that is made of it sees it.
pub(crate) fn groom(pipeline: &Pipeline, base: &Path) -> Result<Digest, TurntableError> {
    let source = &pipeline.groom;
    let mut digest = Ingredients::of("groom");
    if let Some(file) = &source.file {
        let ending = file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        digest = digest.word(&ending).file(&base.join(file))?;
    }
    let settings = (&source.sample, source.up, source.meters_per_unit, source.repair);
    Ok(digest.settings(&settings).settings(&pipeline.attributes).finish())
}

/// What all frames of a variant depend on.
pub(crate) fn scene(pipeline: &Pipeline, groom: &Digest, base: &Path) -> Result<Digest, TurntableError> {
    let mut digest = material::added(Ingredients::of("scene").digest(groom), &pipeline.material, base)?;
    if let Some(mesh) = &pipeline.mesh {
        digest = digest.file(&base.join(&mesh.file))?;
        digest = digest.settings(&(mesh.up, mesh.meters_per_unit, mesh.albedo));
    }
    digest = digest.settings(&pipeline.lights.area);
    if let Some(environment) = &pipeline.lights.environment {
        if let Some(file) = &environment.file {
            digest = digest.file(&base.join(file))?;
        }
        let e = environment;
        digest = digest.settings(&(e.constant, e.studio, e.rotation, e.intensity));
    }
    Ok(digest.finish())
}

/// What one frame depends on. The azimuth counts, the frame's number and how many there are do not: the same view is
/// the same picture in a turntable of 4 and of 8.
pub(crate) fn frame(pipeline: &Pipeline, scene: &Digest, number: u32) -> Digest {
    let digest = Ingredients::of("frame").digest(scene);
    let digest = digest.settings(&pipeline.camera).settings(&pipeline.render);
    let azimuth = views::azimuth(&pipeline.turntable, number);
    digest.settings(&(azimuth, pipeline.turntable.turn)).finish()
}
