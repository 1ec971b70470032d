//! Layers from bytes.
//!
//! What a file promises is checked against its bytes before memory is taken for it, arrays stay in the file
//! until they are asked for, and what has to be unpacked may take four times the size of the file and a
//! megabyte, not more. Errors say where: line and column in a text, the byte in a crate.
//!
//! A layer is one file: references, payloads and sublayers are kept as metadata and not followed. Of variants,
//! those that the prim itself selects become part of it.

pub(crate) mod arrays;
pub(crate) mod budget;
mod crate_file;
pub(crate) mod error;
mod number;
mod package;
mod text;
mod variants;

pub use error::{Place, ReadError};
pub use number::Number;

use crate::Layer;

impl<B: AsRef<[u8]>> Layer<B> {
    /// Reads a layer: a text (`.usda`), a crate (`.usdc`) or a package (`.usdz`), told apart by their first
    /// bytes. Of a package the first file is read.
    ///
    /// # Errors
    /// [`ReadError`] with the place, what is there and what would be right.
    pub fn read(bytes: B) -> Result<Self, ReadError> {
        let all = bytes.as_ref();
        if all.starts_with(b"PK\x03\x04") {
            let (range, name) = package::first(all)?;
            if all[range.clone()].starts_with(b"PK\x03\x04") {
                return Err(ReadError::byte(
                    range.start as u64,
                    format!("a package in a package, {name}"),
                    "a layer",
                ));
            }
            let moved = |mut error: ReadError| {
                error.found = format!("{} (in {name})", error.found);
                error
            };
            return read_at(bytes, range.start, range.end).map_err(moved);
        }
        let end = all.len();
        read_at(bytes, 0, end)
    }
}

fn read_at<B: AsRef<[u8]>>(bytes: B, start: usize, end: usize) -> Result<Layer<B>, ReadError> {
    let all = bytes.as_ref().get(start..end).unwrap_or_default();
    let mut layer = if all.starts_with(b"PXR-USDC") {
        let parts = crate_file::read(all)?;
        parts.into_layer(bytes, start, end)
    } else {
        let (metadata, prims) = text::read(all)?;
        Layer { bytes, start, end, tokens: Vec::new(), strings: Vec::new(), metadata, prims }
    };
    variants::select(&mut layer.prims);
    Ok(layer)
}
