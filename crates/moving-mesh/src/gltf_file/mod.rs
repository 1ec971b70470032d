//! glTF 2.0, through the crate `gltf` for the JSON and our own checked reads for the bytes.
//!
//! The crate's accessor iterators trust offsets and counts; a groom tool meets broken files, so every
//! range is checked here before a byte is read.

mod accessor;
mod buffers;
mod container;
mod rest_pose;

use std::path::Path;

use gltf::json::validation::Checked;
use gltf::{Document, Semantic};

use crate::TriangleMesh;
use crate::error::Fault;

/// Extensions that change where vertices are and that this module does not apply.
const REMEDY: &str = "export without it (most exporters have a switch for compression)";

/// Reads the default scene in its rest pose.
pub(crate) fn read(path: &Path) -> Result<TriangleMesh, Fault> {
    let bytes = std::fs::read(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    let (json, binary) = container::split(&bytes)?;
    let document = parse(json)?;
    let buffers = buffers::load(&document, binary, path)?;
    rest_pose::mesh(&document, &buffers)
}

fn parse(json: &[u8]) -> Result<Document, Fault> {
    let mut root: gltf::json::Root = gltf::json::deserialize::from_slice(json).map_err(|e| {
        Fault::invalid(format!("JSON line {} column {}", e.line(), e.column()), e.to_string())
    })?;
    let known = ["KHR_texture_transform", "KHR_materials_unlit", "KHR_materials_emissive_strength"];
    if let Some(extension) =
        root.extensions_required.iter().find(|e| !is_about_looks(e) && !known.contains(&e.as_str()))
    {
        return Err(Fault::Unsupported {
            what: format!("the required extension {extension}"),
            remedy: REMEDY,
        });
    }
    check_positions(&root)?;
    // `Document::from_json` validates indices and required fields, and would also refuse the required
    // extensions it has not been compiled for: those that are left only concern looks.
    root.extensions_required.clear();
    Document::from_json(root).map_err(|e| Fault::invalid("glTF JSON", e.to_string()))
}

/// Material and texture extensions change no vertex.
fn is_about_looks(extension: &str) -> bool {
    extension.starts_with("KHR_materials_") || extension.contains("texture") || extension.contains("lights")
}

/// The crate's validation looks up every `POSITION` accessor before it has checked the index.
fn check_positions(root: &gltf::json::Root) -> Result<(), Fault> {
    let position = Checked::Valid(Semantic::Positions);
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let count = root.accessors.len();
            if let Some(index) = primitive.attributes.get(&position).filter(|index| index.value() >= count) {
                let place = format!("meshes[{m}].primitives[{p}].attributes.POSITION");
                return Err(Fault::invalid(
                    place,
                    format!("{index}, expected below the accessor count {count}"),
                ));
            }
        }
    }
    Ok(())
}
