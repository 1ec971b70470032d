//! Texts: the grammar of `.usda` as OpenUSD's `textFileFormatParser.h` has it.

pub(crate) mod array;
mod cursor;
mod numbers;
mod parser;
mod value;

use crate::layer::{Metadata, Prim};
use crate::read::ReadError;
use crate::read::error::quoted;

/// What the first line starts with; `#sdf 1.4.32` is what it was once.
const MAGIC: [&[u8]; 2] = [b"#usda ", b"#sdf "];

pub(super) fn read(bytes: &[u8]) -> Result<(Metadata, Vec<Prim>), ReadError> {
    if !MAGIC.iter().any(|magic| bytes.starts_with(magic)) {
        return Err(ReadError::text(bytes, 0, quoted(bytes), "a USD layer: #usda, PXR-USDC or a package"));
    }
    parser::Parser::new(bytes, 0).layer()
}
