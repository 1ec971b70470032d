//! Alembic as a groom.

mod curves;
mod frames;
mod gather;
mod guides;
mod params;
mod scene;
mod time;
mod tree;
mod values;
mod xform;

use ogawa::{Archive, OgawaError};

use self::scene::Scene;
use crate::polylines::Polylines;
use crate::{FormatError, Loaded, ReadOptions};

pub(crate) use self::frames::read as read_moving;

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    Ok(load(bytes, name, options, options.time)?.0)
}

/// The groom at a time, and how its curves were cut.
fn load(
    bytes: &[u8],
    name: &str,
    options: &ReadOptions,
    time: Option<f64>,
) -> Result<(Loaded, Vec<Polylines>), FormatError> {
    let archive = Archive::new(bytes).map_err(|error| fault(name, "", error))?;
    let mut scene = Scene::new(&archive, name, bytes.len(), time)?;
    if options.keep_origin {
        scene.keep_origin()?;
    }
    scene.load(options)
}

/// An archive's error as this crate tells it; `path` is the object's.
fn fault(file: &str, path: &str, error: OgawaError) -> FormatError {
    match error {
        OgawaError::Io { source } => FormatError::io(file, source),
        OgawaError::Invalid { offset, what, found, expected } => {
            FormatError::invalid(file, format!("byte {offset}, {what}"), found, expected)
        }
        OgawaError::Property { name, found, expected } => {
            let dot = if path.is_empty() || name.starts_with(['.', '/']) { "" } else { "." };
            FormatError::invalid(file, format!("{path}{dot}{name}"), found, expected)
        }
        other => FormatError::invalid(file, path, other.to_string(), "what Alembic holds"),
    }
}
