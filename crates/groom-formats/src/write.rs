//! From a groom to a path or a stream.

use std::io::{BufWriter, Write};
use std::path::Path;

use groom::Groom;

use crate::{Format, FormatError, Output, Warning, WriteOptions, check, read};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 20;

/// Writes `groom` to `path` in the format its ending names: the whole file or nothing ([`Output`]).
///
/// Returns what the format could not hold. `NAME.gltf` writes its bytes to `NAME.bin` beside it. Both
/// are finished before the first takes its place, the bytes first: only a process killed between the
/// two renames leaves new bytes with an old document.
///
/// # Errors
/// [`FormatError`]; the old file at `path`, if any, is then untouched.
pub fn write(groom: &Groom, path: &Path, options: &WriteOptions) -> Result<Vec<Warning>, FormatError> {
    let name = path.display().to_string();
    let format = Format::from_path(path).ok_or_else(|| FormatError::UnknownFormat {
        file: name.clone(),
        expected: read::endings(Format::can_write),
    })?;
    if format == Format::Gltf {
        return write_gltf(groom, path, &name);
    }
    let (output, warnings) = filled(path, &name, |stream| write_to(format, groom, stream, &name, options))?;
    output.commit()?;
    Ok(warnings)
}

/// Writes `groom` to a stream; `name` stands for it in messages.
///
/// The stream need not be buffered; what is written before an error stays written.
///
/// # Errors
/// [`FormatError`], also for a format that is more than one stream ([`Format::streams`]).
#[cfg_attr(not(feature = "hair"), allow(unused_variables))] // only HAIR has options
#[cfg_attr(
    not(any(feature = "hair", feature = "text", feature = "gltf", feature = "usda")),
    allow(unreachable_code, unused_mut)
)]
pub fn write_to(
    format: Format,
    groom: &Groom,
    stream: impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    check::values(groom, name)?;
    let mut stream = BufWriter::with_capacity(BUFFER, stream);
    let warnings = match format {
        #[cfg(feature = "hair")]
        Format::Hair => crate::hair::write(groom, &mut stream, name, options)?,
        #[cfg(feature = "text")]
        Format::Text => crate::text::write(groom, &mut stream, name)?,
        #[cfg(feature = "gltf")]
        Format::Glb => crate::gltf::write_glb(groom, &mut stream, name)?,
        #[cfg(feature = "usda")]
        Format::Usda => crate::usda::write(groom, &mut stream, name)?,
        other => return Err(unwritable(other, name)),
    };
    stream.flush().map_err(|e| FormatError::io(name, e))?;
    Ok(warnings)
}

#[cfg(feature = "gltf")]
fn write_gltf(groom: &Groom, path: &Path, name: &str) -> Result<Vec<Warning>, FormatError> {
    check::values(groom, name)?;
    let bytes_path = path.with_extension("bin");
    let bytes_name = bytes_path.file_name().unwrap_or_default().as_encoded_bytes();
    let plan = crate::gltf::Plan::new(groom, Format::Gltf, name)?;
    let bytes_file = bytes_path.display().to_string();
    let (bytes, ()) = filled(&bytes_path, &bytes_file, |stream| {
        plan.write_bytes(stream).map_err(|e| FormatError::io(&bytes_file, e))
    })?;
    let (document, ()) = filled(path, name, |stream| {
        let json = plan.json(Some(bytes_name)).map_err(|e| FormatError::io(name, e))?;
        stream.write_all(&json).map_err(|e| FormatError::io(name, e))
    })?;
    bytes.commit()?;
    document.commit()?;
    Ok(plan.into_warnings())
}

#[cfg(not(feature = "gltf"))]
fn write_gltf(_: &Groom, _: &Path, name: &str) -> Result<Vec<Warning>, FormatError> {
    Err(unwritable(Format::Gltf, name))
}

/// Runs `body` on a buffered output; what comes back is written but not yet in its place.
fn filled<T>(
    path: &Path,
    name: &str,
    body: impl FnOnce(&mut BufWriter<Output>) -> Result<T, FormatError>,
) -> Result<(Output, T), FormatError> {
    let mut stream = BufWriter::with_capacity(BUFFER, Output::create(path)?);
    let done = body(&mut stream)?;
    let output = stream.into_inner().map_err(|e| FormatError::io(name, e.into_error()))?;
    Ok((output, done))
}

fn unwritable(format: Format, name: &str) -> FormatError {
    let what = match format {
        Format::Gltf if format.can_write() => "is two files and fits in no stream; use glb",
        _ => "is not built into this program (a cargo feature is off)",
    };
    FormatError::Unsupported { file: name.to_owned(), format, what }
}
