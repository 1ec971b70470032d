//! Packages: a ZIP whose files are stored as they are, the first of them the layer.

use std::ops::Range;

use crate::read::ReadError;

/// Bytes of a file's header before its name.
const HEADER: usize = 30;

/// Where the first file of the package is, and its name.
pub(super) fn first(all: &[u8]) -> Result<(Range<usize>, String), ReadError> {
    let Some(header) = all.get(..HEADER) else {
        return Err(ReadError::byte(0, format!("{} bytes", all.len()), "a package, 30 bytes at least"));
    };
    let u16_at = |at: usize| usize::from(u16::from_le_bytes([header[at], header[at + 1]]));
    let u32_at = |at: usize| u16_at(at) | u16_at(at + 2) << 16;
    if !header.starts_with(b"PK\x03\x04") {
        return Err(ReadError::byte(
            0,
            crate::read::error::quoted(&header[..4]),
            "the start of a ZIP, PK 3 4",
        ));
    }
    if u16_at(6) & 0b1001 != 0 {
        return Err(ReadError::byte(
            6,
            format!("flags {}", u16_at(6)),
            "a file that is not encrypted or streamed",
        ));
    }
    if u16_at(8) != 0 {
        return Err(ReadError::byte(
            8,
            format!("compression {}", u16_at(8)),
            "0: packages store files as they are",
        ));
    }
    let (size, name, extra) = (u32_at(18), u16_at(26), u16_at(28));
    let start = HEADER + name + extra;
    let end = start + size;
    if end > all.len() {
        let found = format!("a file of {size} bytes");
        return Err(ReadError::byte(18, found, format!("{} at most", all.len().saturating_sub(start))));
    }
    let name = String::from_utf8_lossy(&all[HEADER..HEADER + name]).into_owned();
    Ok((start..end, name))
}
