//! The bytes a document refers to: the binary chunk, data URIs and files beside it.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use gltf::Document;
use gltf::buffer::{Buffer, Source, View};

use crate::GltfError;

/// Every buffer of a document, each at least as long as the document says.
#[derive(Debug, Default)]
pub struct Buffers<'a> {
    /// Bytes of each address named; buffers of one file share them.
    loaded: Vec<Cow<'a, [u8]>>,
    /// Buffer to entry of `loaded`.
    places: Vec<usize>,
}

impl<'a> Buffers<'a> {
    /// Loads every buffer. `binary` is the container's chunk, `folder` is where relative addresses start
    /// (`None` when the document comes from a stream: files are then refused).
    ///
    /// # Errors
    /// [`GltfError`] naming the buffer: too short, an address that is no data URI in base64 and no relative
    /// path inside `folder`, a file that cannot be read.
    pub fn load(
        document: &Document,
        binary: Option<&'a [u8]>,
        folder: Option<&Path>,
    ) -> Result<Self, GltfError> {
        let mut wanted: BTreeMap<Option<&str>, usize> = BTreeMap::new();
        for buffer in document.buffers() {
            let longest = wanted.entry(address(&buffer)).or_default();
            *longest = buffer.length().max(*longest);
        }
        let mut buffers = Buffers::default();
        let mut known = BTreeMap::new();
        for buffer in document.buffers() {
            let address = address(&buffer);
            let place = match known.get(&address) {
                Some(&place) => place,
                None => {
                    let length = wanted.get(&address).copied().unwrap_or_default();
                    buffers.loaded.push(load_one(&buffer, address, length, binary, folder)?);
                    known.insert(address, buffers.loaded.len() - 1);
                    buffers.loaded.len() - 1
                }
            };
            buffers.places.push(place);
            let found = buffers.get(buffer.index()).len();
            if found < buffer.length() {
                let expected = format!("byteLength {}", buffer.length());
                return Err(GltfError::invalid(place_of(&buffer), format!("{found} bytes"), expected));
            }
        }
        Ok(buffers)
    }

    /// The bytes of buffer `index`; empty when there is no such buffer.
    #[must_use]
    pub fn get(&self, index: usize) -> &[u8] {
        self.places.get(index).and_then(|&place| self.loaded.get(place)).map_or(&[], |bytes| bytes)
    }

    /// The bytes of a view; `place` names who asks.
    ///
    /// # Errors
    /// [`GltfError::Invalid`] when the view does not lie inside its buffer.
    pub fn view(&self, view: &View<'_>, place: &str) -> Result<&[u8], GltfError> {
        let buffer = self.get(view.buffer().index());
        let range = view.offset().checked_add(view.length()).and_then(|end| buffer.get(view.offset()..end));
        range.ok_or_else(|| {
            let (offset, length, found) = (view.offset(), view.length(), buffer.len());
            GltfError::invalid(
                format!("bufferViews[{}] (of {place})", view.index()),
                format!("{length} bytes from {offset}"),
                format!("a range inside the buffer's {found} bytes"),
            )
        })
    }

    /// Bytes of all buffers together.
    #[must_use]
    pub fn total(&self) -> usize {
        self.loaded.iter().map(|bytes| bytes.len()).fold(0, usize::saturating_add)
    }
}

fn place_of(buffer: &Buffer<'_>) -> String {
    format!("buffers[{}]", buffer.index())
}

/// `None` for the container's chunk.
pub(crate) fn address<'a>(buffer: &Buffer<'a>) -> Option<&'a str> {
    match buffer.source() {
        Source::Bin => None,
        Source::Uri(uri) => Some(uri),
    }
}

fn load_one<'a>(
    buffer: &Buffer<'_>,
    address: Option<&str>,
    length: usize,
    binary: Option<&'a [u8]>,
    folder: Option<&Path>,
) -> Result<Cow<'a, [u8]>, GltfError> {
    let invalid = |found: &str, expected: &str| GltfError::invalid(place_of(buffer), found, expected);
    let Some(uri) = address else {
        let missing = || invalid("no uri and no binary chunk in the file", "one of them");
        return Ok(Cow::Borrowed(binary.ok_or_else(missing)?));
    };
    if let Some(data) = uri.strip_prefix("data:") {
        let broken = || invalid("a data URI that cannot be decoded", "data:TYPE;base64,CONTENT");
        return Ok(Cow::Owned(decode(data).ok_or_else(broken)?));
    }
    let refused = || GltfError::Unsupported {
        what: format!("the buffer address {uri:?}"),
        remedy: "put the file beside the glTF and name it by a relative path",
    };
    let path = folder.and_then(|folder| beside(folder, uri)).ok_or_else(refused)?;
    // No more than is asked for: the file may be a device without an end.
    let mut bytes = Vec::new();
    let read = File::open(&path).and_then(|file| file.take(length as u64).read_to_end(&mut bytes));
    read.map_err(|source| GltfError::Io { path, source })?;
    Ok(Cow::Owned(bytes))
}

/// The bytes of a data URI, without its `data:`.
pub(crate) fn decode(data: &str) -> Option<Vec<u8>> {
    let (_, payload) = data.split_once(";base64,")?;
    base64::engine::general_purpose::STANDARD.decode(payload).ok()
}

/// The file a relative URI names; a file must not reach out of its own folder tree.
pub(crate) fn beside(folder: &Path, uri: &str) -> Option<PathBuf> {
    let name = percent_encoding::percent_decode_str(uri).decode_utf8().ok()?;
    let relative = Path::new(&*name);
    let inside = relative.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    // An address without a name would be the folder itself.
    let is_file = relative.components().any(|c| matches!(c, Component::Normal(_)));
    (inside && is_file).then(|| folder.join(relative))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(buffers: &str) -> Document {
        let json = format!(r#"{{"asset":{{"version":"2.0"}},"buffers":[{buffers}]}}"#);
        crate::document::parse(json.as_bytes()).unwrap()
    }

    fn told(buffer: &str, folder: Option<&Path>) -> String {
        Buffers::load(&document(buffer), None, folder).unwrap_err().to_string()
    }

    #[test]
    fn bytes_come_from_the_chunk_from_uris_and_from_files() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("my hair#2 ä.bin"), b"0123456789").unwrap();
        let document = document(
            r#"{"byteLength":2},
            {"byteLength":3,"uri":"data:application/octet-stream;base64,AAEC"},
            {"byteLength":4,"uri":"my%20hair%232%20%C3%A4.bin"},
            {"byteLength":5,"uri":"my%20hair%232%20%C3%A4.bin"}"#,
        );
        let buffers = Buffers::load(&document, Some(b"BIN"), Some(folder.path())).unwrap();
        assert_eq!((buffers.get(0), buffers.get(1)), (&b"BIN"[..], &[0, 1, 2][..]));
        assert_eq!((buffers.get(2), buffers.get(3)), (&b"01234"[..], &b"01234"[..]));
        assert_eq!((buffers.get(4), buffers.total()), (&[][..], 3 + 3 + 5), "one file is loaded once");
    }

    #[test]
    fn addresses_that_reach_out_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        for uri in ["/etc/passwd", "../a.bin", "a/../../b.bin", "%2Fetc%2Fpasswd", "%2E%2E/a", ".", ""] {
            let error = told(&format!(r#"{{"byteLength":1,"uri":"{uri}"}}"#), Some(folder.path()));
            assert!(error.contains("relative path"), "{uri}: {error}");
        }
        assert!(told(r#"{"byteLength":1,"uri":"a.bin"}"#, None).contains("relative path"));
        assert!(told(r#"{"byteLength":1,"uri":"a.bin"}"#, Some(folder.path())).contains("a.bin"));
    }

    #[test]
    fn short_and_broken_buffers_are_told() {
        let error = "buffers[0]: found 3 bytes, expected byteLength 18446744073709551615";
        let huge = r#"{"byteLength":18446744073709551615,"uri":"data:;base64,AAEC"}"#;
        assert_eq!(told(huge, None), error);
        assert!(
            told(r#"{"byteLength":1,"uri":"data:;base64,A"}"#, None).starts_with("buffers[0]: found a data")
        );
        assert!(told(r#"{"byteLength":1}"#, None).starts_with("buffers[0]: found no uri"));
    }
}
