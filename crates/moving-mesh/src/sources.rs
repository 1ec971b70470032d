//! The files that a mesh or a camera is read from.

use std::path::{Path, PathBuf};

use crate::{MeshError, obj_file, usd_file};

/// Every file that a mesh or camera of this name is read from, itself first: the frames of a sequence
/// (`walk.####.obj`), the buffers of a glTF document, the layers that a USD stage is composed of. With `pictures` also
/// those that its base colours come from: pictures and material libraries.
///
/// What is named and not there is left out, as are value clips that are named by a template; a file that cannot be
/// understood names none. Whoever reads it says what is wrong.
///
/// # Errors
/// [`MeshError`] for a sequence that has no files or gaps.
pub fn sources(path: impl AsRef<Path>, pictures: bool) -> Result<Vec<PathBuf>, MeshError> {
    let path = path.as_ref();
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let mut files = match ending.as_str() {
        "obj" => obj_file::sources(path, pictures).map_err(|fault| fault.in_file(path))?,
        "gltf" | "glb" => {
            let mut files = vec![path.to_owned()];
            files.extend(gltf_bytes::files(path, pictures).unwrap_or_default());
            files
        }
        "usd" | "usda" | "usdc" | "usdz" => usd_file::sources(path, pictures),
        _ => vec![path.to_owned()],
    };
    let mut nth = 0;
    files.retain(|file| {
        nth += 1;
        nth == 1 || file.is_file()
    });
    Ok(files)
}
