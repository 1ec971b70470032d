//! Wavefront OBJ through `tobj`: single files and sequences of them.

mod frames;
mod materials;
mod sequence;
mod single;
mod sources;

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use tobj::{LoadOptions, Material, Model};

use crate::MeshOptions;
use crate::error::Fault;
use crate::loaded::Loaded;
pub(crate) use sequence::Sequence;
pub(crate) use sources::sources;

/// Reads an OBJ file, or the sequence that a name with `#` in the place of digits stands for.
pub(crate) fn read(path: &Path, options: &MeshOptions) -> Result<Loaded, Fault> {
    if is_sequence(path) { sequence::read(path, options) } else { single::read(path) }
}

/// Whether a name stands for many files.
fn is_sequence(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().contains('#')) && !path.exists()
}

/// Models and materials of a file; `single_index` gives a vertex to every combination of indices.
fn load(path: &Path, single_index: bool) -> Result<(Vec<Model>, Vec<Material>), Fault> {
    let file = File::open(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    parse(&mut BufReader::new(file), path.parent(), single_index)
}

fn parse(
    reader: &mut impl BufRead,
    folder: Option<&Path>,
    single_index: bool,
) -> Result<(Vec<Model>, Vec<Material>), Fault> {
    // Lines and points are no surface; tobj would hand them out as thin triangles.
    let options = LoadOptions { triangulate: true, single_index, ignore_lines: true, ignore_points: true };
    let loaded = tobj::load_obj_buf(reader, &options, |library| materials::load(folder, library));
    let (models, materials) = loaded.map_err(|e| Fault::invalid("OBJ text", e.to_string()))?;
    // A library that is lost is no reason to refuse the mesh.
    Ok((models, materials.unwrap_or_default()))
}

/// Triples of numbers of a model.
fn triples<'m>(model: &Model, what: &str, numbers: &'m [f32]) -> Result<&'m [[f32; 3]], Fault> {
    match numbers.as_chunks::<3>() {
        (triples, []) => Ok(triples),
        _ => Err(Fault::invalid(format!("object `{}`", model.name), format!("{what} are not triples"))),
    }
}

/// Triangles of a model, of whatever its indices count.
fn triangles(model: &Model) -> Result<&[[u32; 3]], Fault> {
    match model.mesh.indices.as_chunks::<3>() {
        (triangles, []) => Ok(triangles),
        _ => {
            let place = format!("object `{}`", model.name);
            Err(Fault::invalid(place, "faces do not split into triangles"))
        }
    }
}
