//! A groom as Alembic.

mod attributes;
mod curves;
mod guides;
mod motion;
mod origin;
mod space;
mod spread;

use std::io::{Seek, Write};

use glam::DVec3;
use groom::Groom;
use ogawa::OgawaError;

use self::curves::CurvesWriter;
use crate::{FormatError, Warning, WriteOptions};

pub(crate) use self::motion::write_animation;

pub(crate) fn write(
    groom: &Groom,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut curves = CurvesWriter::new(groom, stream, name, options, DVec3::ZERO, true)?;
    curves.positions(groom.positions())?;
    curves.finish(None)
}

/// An archive's error as this crate tells it.
fn fault(file: &str, error: OgawaError) -> FormatError {
    match error {
        OgawaError::Io { source } => FormatError::io(file, source),
        other => FormatError::invalid(file, "archive", other.to_string(), "what Alembic can hold"),
    }
}
