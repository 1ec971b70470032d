//! A document with its bytes.

use std::path::Path;

use gltf::Document;

use crate::{Buffers, GltfError, container, document};

/// A glTF file that was opened: its document, indices checked, and its buffers.
#[derive(Debug)]
pub struct Asset<'a> {
    /// The document. Its extensions are no longer required of anybody, and the bounds of its positions are
    /// not those of the file: neither is to be relied on.
    pub document: Document,
    /// The buffers.
    pub buffers: Buffers<'a>,
}

impl<'a> Asset<'a> {
    /// Opens a `.gltf` or `.glb` from its bytes; `folder` is where its other files are.
    ///
    /// # Errors
    /// [`GltfError`]: a broken container, document or buffer, a required extension that changes geometry and
    /// is not read here, or a file of bytes that cannot be read.
    pub fn open(bytes: &'a [u8], folder: Option<&Path>) -> Result<Self, GltfError> {
        let (json, binary) = container::split(bytes)?;
        let document = document::parse(json)?;
        let buffers = Buffers::load(&document, binary, folder)?;
        Ok(Asset { document, buffers })
    }
}
