//! glTF LINES as a groom.

use std::path::Path;

use crate::{Format, FormatError, Loaded, ReadOptions};

/// `folder` is where the document's other files are; a stream has none.
pub(crate) fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    name: &str,
    options: &ReadOptions,
) -> Result<Loaded, FormatError> {
    let _ = (bytes, folder, options);
    Err(FormatError::Unsupported { file: name.to_owned(), format: Format::Glb, what: "cannot be read yet" })
}
