//! The files that a file named in a pipeline stands for.

use std::path::{Path, PathBuf};

use crate::TurntableError;
use crate::schema::{CameraFile, MeshSource};

/// The files of a mesh: the frames of a sequence, buffers, layers; pictures where its own colours count.
pub(super) fn of_mesh(mesh: &MeshSource, base: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    Ok(moving_mesh::sources(base.join(&mesh.file), mesh.base_colors)?)
}

/// The files of a camera.
pub(super) fn of_camera(camera: &CameraFile, base: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    Ok(moving_mesh::sources(base.join(&camera.path), false)?)
}

/// The files of a groom; a glTF document has its buffers beside it, all others are one file.
pub(super) fn of_groom(file: &Path, base: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    let path = base.join(file);
    let is_gltf = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gltf"));
    if is_gltf { Ok(moving_mesh::sources(path, false)?) } else { Ok(vec![path]) }
}
