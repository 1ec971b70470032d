//! Material libraries.

use std::fs::File;
use std::io::BufReader;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use glam::Vec3;
use tobj::{LoadError, MTLLoadResult, Material, Model};

use crate::shape::Look;
use crate::texture::TextureSource;

/// Loads a library that lies in the folder of the OBJ file or below it.
pub(super) fn load(folder: Option<&Path>, library: &Path) -> MTLLoadResult {
    let path = folder.and_then(|folder| inside(folder, library)).ok_or(LoadError::OpenFileFailed)?;
    let file = File::open(path).map_err(|_| LoadError::OpenFileFailed)?;
    tobj::load_mtl_buf(&mut BufReader::new(file))
}

/// How a model looks. `Kd` is taken as linear; a picture is multiplied by it.
pub(super) fn look(model: &Model, materials: &[Material], path: &Path) -> Look {
    let Some(material) = model.mesh.material_id.and_then(|id| materials.get(id)) else {
        return Look::default();
    };
    let picture = |name: &String| {
        let file = path.parent().and_then(|folder| inside(folder, Path::new(name.trim())));
        Arc::new(file.map_or_else(
            || TextureSource::Lost {
                path: path.to_owned(),
                place: format!("material `{}`", material.name),
                fault: format!(
                    "the picture {name:?}, expected one in the folder of the OBJ file or below it"
                ),
            },
            TextureSource::File,
        ))
    };
    Look {
        material: Some(material.name.clone()),
        base_color: material.diffuse.map_or(Vec3::ONE, Vec3::from),
        texture: material.diffuse_texture.as_ref().map(picture),
    }
}

pub(super) fn inside(folder: &Path, name: &Path) -> Option<PathBuf> {
    let stays = name.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    let is_file = name.components().any(|c| matches!(c, Component::Normal(_)));
    (stays && is_file).then(|| folder.join(name))
}
