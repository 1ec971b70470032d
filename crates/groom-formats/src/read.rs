//! From a path or a stream to a groom.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::{Format, FormatError, Loaded, ReadOptions};

/// Reads the groom at `path`, in the format its ending names.
///
/// # Errors
/// [`FormatError`], which names the file and the place in it.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let name = path.display().to_string();
    let format = Format::from_path(path)
        .ok_or_else(|| FormatError::UnknownFormat { file: name.clone(), expected: readable() })?;
    refuse_unreadable(format, &name)?;
    let file = File::open(path).map_err(|e| FormatError::io(&name, e))?;
    // The length of a pipe or device is 0 or a guess; only a plain file's can be relied on.
    let length = file.metadata().ok().filter(|m| m.is_file()).map(|m| m.len());
    let options = ReadOptions { known_len: options.known_len.or(length), ..options.clone() };
    read_from(format, file, &name, &options)
}

/// Reads a groom of `format` from a stream; `name` stands for it in messages.
///
/// The stream need not be buffered.
///
/// # Errors
/// [`FormatError`], which names the place in the stream.
#[cfg_attr(not(any(feature = "hair", feature = "text")), allow(unused_variables))]
pub fn read_from(
    format: Format,
    stream: impl Read,
    name: &str,
    options: &ReadOptions,
) -> Result<Loaded, FormatError> {
    refuse_unreadable(format, name)?;
    match format {
        #[cfg(feature = "hair")]
        Format::Hair => crate::hair::read(stream, name, options),
        #[cfg(feature = "text")]
        Format::Text => crate::text::read(stream, name, options),
        #[allow(unreachable_patterns)] // reached when features are off
        _ => Err(unreadable(format, name)),
    }
}

fn refuse_unreadable(format: Format, name: &str) -> Result<(), FormatError> {
    if format.can_read() { Ok(()) } else { Err(unreadable(format, name)) }
}

fn unreadable(format: Format, name: &str) -> FormatError {
    let what = match format {
        Format::Hair | Format::Text => "is not built into this program (a cargo feature is off)",
        Format::Gltf | Format::Glb | Format::Usda => "can be written but not yet read; use .hair or .txt",
    };
    FormatError::Unsupported { file: name.to_owned(), format, what }
}

fn readable() -> String {
    endings(Format::can_read)
}

pub(crate) fn endings(which: fn(Format) -> bool) -> String {
    let names = Format::ALL.into_iter().filter(|&format| which(format)).map(|format| format!(".{format}"));
    names.collect::<Vec<_>>().join(", ")
}
