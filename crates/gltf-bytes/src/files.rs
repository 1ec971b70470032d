//! The files beside a document that it names.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use gltf::image::Source;

use crate::buffers::{address, beside};
use crate::{GltfError, document};

/// Bytes of a container before its JSON: the header, and that of the first chunk.
const BEFORE_JSON: usize = 20;

/// The files that the `.gltf` or `.glb` at `path` names: those of its buffers and, with `images`, of its images. Only
/// its JSON is read. An address that is no relative path inside its folder is left out: nothing is read from there.
///
/// # Errors
/// [`GltfError`]: a file that cannot be read, or a broken document.
pub fn files(path: &Path, images: bool) -> Result<Vec<PathBuf>, GltfError> {
    let document = document::parse(&json(path)?)?;
    let mut addresses: Vec<&str> = document.buffers().filter_map(|buffer| address(&buffer)).collect();
    if images {
        addresses.extend(document.images().filter_map(|image| match image.source() {
            Source::Uri { uri, .. } => Some(uri),
            Source::View { .. } => None,
        }));
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let named = addresses.into_iter().filter(|address| !address.starts_with("data:"));
    Ok(named.filter_map(|address| beside(folder, address)).collect())
}

fn json(path: &Path) -> Result<Vec<u8>, GltfError> {
    let io = |source| GltfError::Io { path: path.to_owned(), source };
    let mut file = File::open(path).map_err(io)?;
    let mut bytes = Vec::new();
    file.by_ref().take(BEFORE_JSON as u64).read_to_end(&mut bytes).map_err(io)?;
    if let Some([a, b, c, d]) = bytes.get(12..16).filter(|_| bytes.starts_with(b"glTF")) {
        let length = u32::from_le_bytes([*a, *b, *c, *d]);
        bytes.clear();
        file.take(u64::from(length)).read_to_end(&mut bytes).map_err(io)?;
    } else {
        file.read_to_end(&mut bytes).map_err(io)?;
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const JSON: &str = r#"{"asset":{"version":"2.0"},
        "buffers":[{"byteLength":1,"uri":"my%20hair.bin"},{"byteLength":1,"uri":"data:;base64,AA=="},
            {"byteLength":1,"uri":"../out.bin"}],
        "images":[{"uri":"skin.png"},{"uri":"data:image/png;base64,AAEC"}]}"#;

    fn names(file: &str, bytes: &[u8], images: bool) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(file);
        std::fs::write(&path, bytes).unwrap();
        let inside = |file: PathBuf| file.strip_prefix(folder.path()).unwrap().display().to_string();
        files(&path, images).unwrap().into_iter().map(inside).collect()
    }

    #[test]
    fn a_document_names_its_buffers_and_images() {
        assert_eq!(names("a.gltf", JSON.as_bytes(), false), ["my hair.bin"]);
        assert_eq!(names("a.gltf", JSON.as_bytes(), true), ["my hair.bin", "skin.png"]);
        assert!(files(Path::new("/nowhere/a.gltf"), true).is_err());
    }

    #[test]
    fn of_a_container_the_json_alone_is_read() {
        let word = |n: usize| (n as u32).to_le_bytes();
        let head = [&b"glTF"[..], &word(2), &word(1 << 30), &word(JSON.len()), b"JSON"].concat();
        assert_eq!(names("a.glb", &[&head, JSON.as_bytes()].concat(), true), ["my hair.bin", "skin.png"]);
    }
}
