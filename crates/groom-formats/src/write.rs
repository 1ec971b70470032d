//! From a groom to a path or a stream.

use std::io::{BufWriter, Cursor, Seek, Write};
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
        return write_gltf(groom, path, &name, options);
    }
    let mut output = Output::create(path)?;
    let warnings = if output.can_seek() {
        write_seekable(format, groom, &mut output, &name, options)?
    } else {
        write_to(format, groom, &mut output, &name, options)?
    };
    output.commit()?;
    Ok(warnings)
}

/// Writes `groom` to a stream; `name` stands for it in messages.
///
/// The stream need not be buffered; what is written before an error stays written. Formats that go
/// back to fill in what they learn at the end (`.usdc`, `.usdz`, `.abc`) are put together in memory first;
/// [`write_seekable`] spares that.
///
/// # Errors
/// [`FormatError`], also for a format that is more than one stream ([`Format::streams`]).
pub fn write_to(
    format: Format,
    groom: &Groom,
    stream: impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut stream = BufWriter::with_capacity(BUFFER, stream);
    let warnings = if goes_back(format) {
        let mut file = Cursor::new(Vec::new());
        let warnings = fill_going_back(format, groom, &mut file, name, options)?;
        stream.write_all(file.get_ref()).map_err(|e| FormatError::io(name, e))?;
        warnings
    } else {
        fill(format, groom, &mut stream, name, options)?
    };
    stream.flush().map_err(|e| FormatError::io(name, e))?;
    Ok(warnings)
}

/// As [`write_to`], to a file that can go back.
///
/// # Errors
/// As [`write_to`].
pub fn write_seekable(
    format: Format,
    groom: &Groom,
    stream: impl Write + Seek,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut stream = BufWriter::with_capacity(BUFFER, stream);
    let warnings = if goes_back(format) {
        fill_going_back(format, groom, &mut stream, name, options)?
    } else {
        fill(format, groom, &mut stream, name, options)?
    };
    stream.flush().map_err(|e| FormatError::io(name, e))?;
    Ok(warnings)
}

fn goes_back(format: Format) -> bool {
    matches!(format, Format::Usdc | Format::Usdz | Format::Alembic)
}

#[allow(unused_variables, unreachable_code)] // with features off
fn fill(
    format: Format,
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    refuse_unwritable(format, name)?;
    check::values(groom, name)?;
    match format {
        #[cfg(feature = "hair")]
        Format::Hair => crate::hair::write(groom, stream, name, options),
        #[cfg(feature = "text")]
        Format::Text => crate::text::write(groom, stream, name),
        #[cfg(feature = "gltf")]
        Format::Glb => crate::gltf::write_glb(groom, stream, name, options),
        #[cfg(feature = "usda")]
        Format::Usda => crate::usd::write::write_usda(groom, stream, name, options),
        #[cfg(feature = "ply")]
        Format::Ply => crate::ply::write(groom, stream, name, options),
        #[cfg(feature = "data")]
        Format::Data => crate::data::write(groom, stream, name, options),
        #[cfg(feature = "obj")]
        Format::Obj => crate::obj::write(groom, stream, name, options),
        #[cfg(feature = "pbrt")]
        Format::Pbrt => crate::pbrt::write(groom, stream, name, options),
        other => Err(unwritable(other, name)),
    }
}

#[allow(unused_variables, unreachable_code)] // with features off
fn fill_going_back(
    format: Format,
    groom: &Groom,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    refuse_unwritable(format, name)?;
    check::values(groom, name)?;
    match format {
        #[cfg(any(feature = "usdc", feature = "usdz"))]
        Format::Usdc | Format::Usdz => crate::usd::write::write_crate(groom, format, stream, name, options),
        #[cfg(feature = "alembic")]
        Format::Alembic => crate::alembic::write(groom, stream, name, options),
        other => Err(unwritable(other, name)),
    }
}

#[cfg(feature = "gltf")]
fn write_gltf(
    groom: &Groom,
    path: &Path,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    check::values(groom, name)?;
    let plan = crate::gltf::Plan::new(groom, Format::Gltf, name, options)?;
    crate::gltf::write_files(plan, Format::Gltf, path, name)
}

#[cfg(not(feature = "gltf"))]
fn write_gltf(_: &Groom, _: &Path, name: &str, _: &WriteOptions) -> Result<Vec<Warning>, FormatError> {
    Err(unwritable(Format::Gltf, name))
}

fn refuse_unwritable(format: Format, name: &str) -> Result<(), FormatError> {
    if format.can_write() { Ok(()) } else { Err(unwritable(format, name)) }
}

fn unwritable(format: Format, name: &str) -> FormatError {
    let what = match format {
        Format::Gltf if format.can_write() => "is two files and fits in no stream; use glb",
        other if other.is_built() => "can be read and not written",
        _ => "is not built into this program (a cargo feature is off)",
    };
    FormatError::Unsupported { file: name.to_owned(), format, what }
}
