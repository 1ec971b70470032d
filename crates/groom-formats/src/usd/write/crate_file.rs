//! A groom as a USD crate or package.

use std::io::{Seek, Write};

use groom::Groom;

use crate::animation::Motion;
use crate::{Format, FormatError, Warning, WriteOptions};

pub(crate) fn write(
    groom: &Groom,
    format: Format,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let _ = (groom, stream, options);
    Err(FormatError::Unsupported { file: name.to_owned(), format, what: "cannot be written yet" })
}

pub(crate) fn write_animation(
    motion: Motion<'_>,
    format: Format,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let Motion { groom, frames, frame_rate } = motion;
    let _ = (groom, frames, frame_rate, stream, options);
    Err(FormatError::Unsupported { file: name.to_owned(), format, what: "cannot be written yet" })
}
