//! The files of an OBJ mesh.

use std::cell::RefCell;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use tobj::LoadOptions;

use super::{frames, is_sequence, materials};
use crate::error::Fault;

/// The file, or those of the sequence; with `pictures` also the material libraries of the first and the pictures they
/// name.
pub(crate) fn sources(path: &Path, pictures: bool) -> Result<Vec<PathBuf>, Fault> {
    let mut files: Vec<PathBuf> = if is_sequence(path) {
        frames::find(path)?.into_iter().map(|(_, file)| file).collect()
    } else {
        vec![path.to_owned()]
    };
    if let Some(first) = files.first().filter(|_| pictures) {
        let named = named(first);
        files.extend(named);
    }
    Ok(files)
}

/// Libraries that are loaded with a file, and the pictures of their materials; none where it cannot be read.
fn named(path: &Path) -> Vec<PathBuf> {
    let Some((file, folder)) = File::open(path).ok().zip(path.parent()) else { return Vec::new() };
    let libraries = RefCell::new(Vec::new());
    let loaded = tobj::load_obj_buf(&mut BufReader::new(file), &LoadOptions::default(), |library| {
        libraries.borrow_mut().extend(materials::inside(folder, library));
        materials::load(Some(folder), library)
    });
    let mut files = libraries.into_inner();
    let materials = loaded.ok().and_then(|(_, materials)| materials.ok()).unwrap_or_default();
    let pictures = materials.iter().filter_map(|material| material.diffuse_texture.as_ref());
    files.extend(pictures.filter_map(|name| materials::inside(folder, Path::new(name.trim()))));
    files
}
