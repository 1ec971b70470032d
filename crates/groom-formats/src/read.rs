//! From a path or a stream to a groom.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use crate::{Format, FormatError, Loaded, ReadOptions};

/// As many bytes as tell formats of one ending apart.
pub(crate) const HEAD: u64 = 16;

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
    read_at(format, file, path.parent(), &name, &options)
}

/// Reads a groom of `format` from a stream; `name` stands for it in messages.
///
/// The stream need not be buffered. The first bytes have the last word on what the format is
/// ([`Format::sniff`]).
///
/// # Errors
/// [`FormatError`], which names the place in the stream.
pub fn read_from(
    format: Format,
    stream: impl Read,
    name: &str,
    options: &ReadOptions,
) -> Result<Loaded, FormatError> {
    read_at(format, stream, None, name, options)
}

/// Reads from a stream whose document may name other files, found in `folder`.
#[cfg_attr(not(feature = "gltf"), allow(unused_variables))]
fn read_at(
    format: Format,
    mut stream: impl Read,
    folder: Option<&Path>,
    name: &str,
    options: &ReadOptions,
) -> Result<Loaded, FormatError> {
    refuse_unreadable(format, name)?;
    let mut head = Vec::new();
    stream.by_ref().take(HEAD).read_to_end(&mut head).map_err(|e| FormatError::io(name, e))?;
    let format = format.sniff(&head);
    refuse_unreadable(format, name)?;
    let stream = Cursor::new(head).chain(stream);
    let loaded = match format {
        #[cfg(feature = "hair")]
        Format::Hair => crate::hair::read(stream, name, options),
        #[cfg(feature = "text")]
        Format::Text => crate::text::read(stream, name, options),
        #[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
        Format::Usda | Format::Usdc | Format::Usdz => {
            crate::usd::read::read(&whole(stream, name, options)?, format, name, options)
        }
        #[cfg(feature = "alembic")]
        Format::Alembic => crate::alembic::read(&whole(stream, name, options)?, name, options),
        #[cfg(feature = "gltf")]
        Format::Gltf | Format::Glb => {
            crate::gltf::read(&whole(stream, name, options)?, folder, name, options)
        }
        #[cfg(feature = "ply")]
        Format::Ply => crate::ply::read(&whole(stream, name, options)?, name, options),
        #[cfg(feature = "data")]
        Format::Data => crate::data::read(&whole(stream, name, options)?, name, options),
        #[cfg(feature = "obj")]
        Format::Obj => crate::obj::read(&whole(stream, name, options)?, name, options),
        #[cfg(feature = "tfx")]
        Format::Tfx => crate::tfx::read(&whole(stream, name, options)?, name, options),
        #[cfg(feature = "monohair")]
        Format::MonoHair => crate::monohair::read(&whole(stream, name, options)?, name, options),
        #[cfg(feature = "ct2hair")]
        Format::Ct2Hair => crate::ct2hair::read(&whole(stream, name, options)?, name, options),
        #[allow(unreachable_patterns)] // reached when features are off
        _ => Err(unreadable(format, name)),
    };
    loaded.map(|loaded| Loaded { format: Some(format), ..loaded })
}

/// Every byte of the stream, in one allocation where the length is known.
#[allow(dead_code)] // some formats read as they go
fn whole(mut stream: impl Read, name: &str, options: &ReadOptions) -> Result<Vec<u8>, FormatError> {
    let mut bytes = Vec::new();
    // One byte more lets the end be seen without growing; a length that lies costs nothing.
    let length = options.known_len.and_then(|length| usize::try_from(length + 1).ok()).unwrap_or(0);
    bytes.try_reserve_exact(length).map_err(|e| FormatError::io(name, e.into()))?;
    stream.read_to_end(&mut bytes).map_err(|e| FormatError::io(name, e))?;
    Ok(bytes)
}

fn refuse_unreadable(format: Format, name: &str) -> Result<(), FormatError> {
    if format.can_read() { Ok(()) } else { Err(unreadable(format, name)) }
}

fn unreadable(format: Format, name: &str) -> FormatError {
    let what = if format.is_built() {
        "can be written and not read"
    } else {
        "is not built into this program (a cargo feature is off)"
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
