//! A groom as Alembic.

use std::io::{Seek, Write};

use groom::Groom;

use crate::animation::Motion;
use crate::{Format, FormatError, Warning, WriteOptions};

pub(crate) fn write(
    groom: &Groom,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let _ = (groom, stream, options);
    Err(FormatError::Unsupported {
        file: name.to_owned(),
        format: Format::Alembic,
        what: "cannot be written yet",
    })
}

pub(crate) fn write_animation(
    motion: Motion<'_>,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let Motion { groom, frames, frame_rate } = motion;
    let _ = (groom, frames, frame_rate, stream, options);
    Err(FormatError::Unsupported {
        file: name.to_owned(),
        format: Format::Alembic,
        what: "cannot be written yet",
    })
}
