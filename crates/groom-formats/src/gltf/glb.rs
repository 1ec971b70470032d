//! The binary container: header, document, buffer.

use std::io::{self, Write};

use groom::Groom;

use super::Plan;
use crate::{Format, FormatError, Warning, WriteOptions};

/// Writes a `.glb`.
pub(crate) fn write_glb(
    groom: &Groom,
    stream: &mut impl Write,
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let plan = Plan::new(groom, Format::Glb, file, options)?;
    self::write(&plan, stream).map_err(|e| FormatError::io(file, e))?;
    Ok(plan.into_warnings())
}

/// Writes all of the container.
pub(super) fn write(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    let mut json = plan.json(None)?;
    json.resize(json.len().next_multiple_of(4), b' ');
    // The plan saw to it that the sum fits.
    let buffer = plan.buffer_bytes() as u32;
    let document = json.len() as u32;
    stream.write_all(b"glTF")?;
    for word in [2, 12 + 8 + document + 8 + buffer, document] {
        stream.write_all(&word.to_le_bytes())?;
    }
    stream.write_all(b"JSON")?;
    stream.write_all(&json)?;
    stream.write_all(&buffer.to_le_bytes())?;
    stream.write_all(b"BIN\0")?;
    plan.write_bytes(stream)
}
