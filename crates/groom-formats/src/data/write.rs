//! A groom as USC hair data.

use std::io::Write;

use groom::Groom;

use crate::{Format, FormatError, Warning, WriteOptions};

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let _ = (groom, stream, options);
    Err(FormatError::Unsupported {
        file: name.to_owned(),
        format: Format::Data,
        what: "cannot be written yet",
    })
}
