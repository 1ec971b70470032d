//! The GLB container: a header and chunks.

use crate::error::Fault;

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// JSON text and, for a GLB, its binary chunk.
pub(crate) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let version = word(bytes, 4)?;
    if version != 2 {
        return Err(Fault::Unsupported {
            what: format!("GLB version {version}"),
            remedy: "convert the file to glTF 2.0",
        });
    }
    let length = word(bytes, 8)? as usize;
    let Some(body) = bytes.get(HEADER..length) else {
        let found = bytes.len();
        return Err(Fault::invalid(
            "GLB byte 8",
            format!("length {length}, expected {HEADER} to the file's {found}"),
        ));
    };
    let (json, rest) = chunk(body, HEADER, b"JSON")?;
    let binary = if rest.is_empty() { None } else { Some(chunk(rest, length - rest.len(), b"BIN\0")?.0) };
    Ok((json, binary))
}

/// The first chunk of `body`, which starts at file offset `at`, and what follows it.
fn chunk<'a>(body: &'a [u8], at: usize, kind: &[u8; 4]) -> Result<(&'a [u8], &'a [u8]), Fault> {
    let length =
        word(body, 0).map_err(|_| Fault::invalid(format!("GLB byte {at}"), "no room for a chunk"))? as usize;
    let found = body.get(4..8).unwrap_or_default();
    if found != kind {
        let (found, kind) = (String::from_utf8_lossy(found), String::from_utf8_lossy(kind));
        return Err(Fault::invalid(
            format!("GLB byte {}", at + 4),
            format!("chunk type {found:?}, expected {kind:?}"),
        ));
    }
    match body[CHUNK_HEADER..].split_at_checked(length) {
        Some(parts) => Ok(parts),
        None => Err(Fault::invalid(
            format!("GLB byte {at}"),
            format!("chunk length {length}, expected at most {}", body.len() - CHUNK_HEADER),
        )),
    }
}

fn word(bytes: &[u8], at: usize) -> Result<u32, Fault> {
    match bytes.get(at..).and_then(<[u8]>::first_chunk::<4>) {
        Some(&word) => Ok(u32::from_le_bytes(word)),
        None => Err(Fault::invalid(format!("GLB byte {at}"), "the file ends, expected 4 more bytes")),
    }
}
