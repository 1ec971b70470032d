//! The bytes a document refers to: the GLB chunk, data URIs and files beside it.

use std::borrow::Cow;
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use gltf::Document;
use gltf::buffer::{Buffer, Source};

use crate::error::Fault;

/// One slice a buffer, each at least as long as the document says.
pub(crate) type Buffers<'a> = Vec<Cow<'a, [u8]>>;

/// Loads every buffer of the document at `path`.
pub(crate) fn load<'a>(
    document: &Document,
    binary: Option<&'a [u8]>,
    path: &Path,
) -> Result<Buffers<'a>, Fault> {
    document.buffers().map(|buffer| load_one(&buffer, binary, path)).collect()
}

fn load_one<'a>(buffer: &Buffer<'_>, binary: Option<&'a [u8]>, path: &Path) -> Result<Cow<'a, [u8]>, Fault> {
    let place = || format!("buffers[{}]", buffer.index());
    let bytes = match buffer.source() {
        Source::Bin => {
            let missing = || Fault::invalid(place(), "no uri and the file has no binary chunk");
            Cow::Borrowed(binary.ok_or_else(missing)?)
        }
        Source::Uri(uri) => match uri.strip_prefix("data:") {
            Some(data) => {
                Cow::Owned(decode(data).ok_or_else(|| Fault::invalid(place(), "broken base64 data URI"))?)
            }
            None => {
                let file = beside(path, uri).ok_or_else(|| Fault::Unsupported {
                    what: format!("the buffer address {uri:?}"),
                    remedy: "put the file beside the glTF and name it by a relative path",
                })?;
                Cow::Owned(std::fs::read(&file).map_err(|source| Fault::Io { path: file, source })?)
            }
        },
    };
    if bytes.len() < buffer.length() {
        let (found, expected) = (bytes.len(), buffer.length());
        return Err(Fault::invalid(place(), format!("{found} bytes, expected byteLength {expected}")));
    }
    Ok(bytes)
}

fn decode(data: &str) -> Option<Vec<u8>> {
    let (_, payload) = data.split_once(";base64,")?;
    base64::engine::general_purpose::STANDARD.decode(payload).ok()
}

/// The file a relative URI names; a file must not reach out of its own folder tree.
fn beside(path: &Path, uri: &str) -> Option<PathBuf> {
    let name = percent_encoding::percent_decode_str(uri).decode_utf8().ok()?;
    let relative = Path::new(&*name);
    let inside = relative.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    inside.then(|| path.parent().unwrap_or(Path::new("")).join(relative))
}
