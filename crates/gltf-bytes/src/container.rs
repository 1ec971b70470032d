//! The binary container: a header and chunks (glTF 2.0, section 4).

use crate::GltfError;

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// JSON text and the binary chunk of a `.glb`; a file without the container's magic is all JSON.
///
/// Chunks after the binary one, which the format reserves for extensions, are passed over.
///
/// # Errors
/// [`GltfError::Invalid`] for lengths and types of chunks that are not as they should be,
/// [`GltfError::Unsupported`] for glTF 1.
pub fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let version = word(bytes, 4)?;
    if version != 2 {
        return Err(GltfError::Unsupported {
            what: format!("GLB version {version}"),
            remedy: "convert the file to glTF 2.0",
        });
    }
    let length = word(bytes, 8)? as usize;
    let Some(body) = bytes.get(HEADER..length) else {
        let expected = format!("{HEADER} to the file's {}", bytes.len());
        return Err(GltfError::invalid("GLB byte 8", format!("length {length}"), expected));
    };
    let (json, rest) = chunk(body, HEADER, b"JSON")?;
    let binary = if rest.is_empty() { None } else { Some(chunk(rest, length - rest.len(), b"BIN\0")?.0) };
    Ok((json, binary))
}

/// The first chunk of `body`, which starts at file offset `at`, and what follows it.
fn chunk<'a>(body: &'a [u8], at: usize, kind: &[u8; 4]) -> Result<(&'a [u8], &'a [u8]), GltfError> {
    let place = || format!("GLB byte {at}");
    let Some((header, content)) = body.split_first_chunk::<CHUNK_HEADER>() else {
        let found = format!("{} bytes", body.len());
        return Err(GltfError::invalid(place(), found, "a chunk's header of 8 bytes"));
    };
    let [a, b, c, d, found @ ..] = *header;
    if found != *kind {
        let words = |kind: &[u8]| format!("chunk type {:?}", String::from_utf8_lossy(kind));
        return Err(GltfError::invalid(format!("GLB byte {}", at + 4), words(&found), words(kind)));
    }
    let length = u32::from_le_bytes([a, b, c, d]) as usize;
    content.split_at_checked(length).ok_or_else(|| {
        GltfError::invalid(place(), format!("chunk length {length}"), format!("at most {}", content.len()))
    })
}

fn word(bytes: &[u8], at: usize) -> Result<u32, GltfError> {
    match bytes.get(at..).and_then(<[u8]>::first_chunk::<4>) {
        Some(&word) => Ok(u32::from_le_bytes(word)),
        None => Err(GltfError::invalid(format!("GLB byte {at}"), "the end of the file", "4 more bytes")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
        let words = |n: usize| (n as u32).to_le_bytes();
        let length = words(12 + 8 + json.len() + 8 + binary.len());
        [
            b"glTF",
            &words(2)[..],
            &length,
            &words(json.len()),
            b"JSON",
            json,
            &words(binary.len()),
            b"BIN\0",
            binary,
        ]
        .concat()
    }

    #[test]
    fn chunks_are_found_and_every_truncation_is_told() {
        let whole = glb(b"{}  ", b"1234");
        assert_eq!(split(&whole).unwrap(), (&b"{}  "[..], Some(&b"1234"[..])));
        assert_eq!(split(b"{}").unwrap(), (&b"{}"[..], None));
        for length in 4..whole.len() {
            let error = split(&whole[..length]).unwrap_err();
            assert!(error.to_string().starts_with("GLB byte"), "{error}");
        }
    }

    #[test]
    fn lengths_and_types_that_lie_are_told() {
        let whole = glb(b"{}  ", b"1234");
        for (at, value, told) in [
            (4, 1, "GLB version 1"),
            (8, 41, "GLB byte 8: found length 41, expected 12 to the file's 36"),
            (8, 11, "GLB byte 8"),
            (12, 21, "GLB byte 12: found chunk length 21, expected at most 16"),
            (16, 0, "GLB byte 16"),
            (24, 5, "GLB byte 24: found chunk length 5"),
            (28, 1, "GLB byte 28"),
        ] {
            let mut bytes = whole.clone();
            bytes[at..at + 4].copy_from_slice(&u32::to_le_bytes(value));
            let error = split(&bytes).unwrap_err().to_string();
            assert!(error.starts_with(told), "{error}");
        }
    }
}
