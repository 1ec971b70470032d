//! Reading the input.

use std::fs::File;
use std::io;
use std::path::Path;

use anyhow::{Context, Result};
use command_line::progress_bar;
use groom_formats::{Format, Loaded, ReadOptions, read, read_from};

use crate::args::{Args, is_stream};
use crate::counted::Counted;

/// An input that was read.
pub(crate) struct Input {
    pub(crate) name: String,
    pub(crate) format: Format,
    pub(crate) bytes: u64,
    pub(crate) loaded: Loaded,
}

/// Reads the input as it was named.
pub(crate) fn load(args: &Args) -> Result<Input> {
    load_from(args.input(), args)
}

/// Reads `path` with the options of the input.
pub(crate) fn load_from(path: &Path, args: &Args) -> Result<Input> {
    let format = args.input_format()?;
    let options = args.reading.options();
    if is_stream(path) {
        let name = "standard input".to_owned();
        let mut stream = Counted::new(io::stdin().lock(), progress_bar(0, "reading"));
        let loaded = read_from(format, &mut stream, &name, &options)?;
        return Ok(Input { name, format: loaded.format.unwrap_or(format), bytes: stream.finish().1, loaded });
    }
    let name = path.display().to_string();
    let file = File::open(path).with_context(|| name.clone())?;
    // A pipe's or a device's length says nothing.
    let known_len = file.metadata().ok().filter(|m| m.is_file()).map(|m| m.len());
    let options = ReadOptions { known_len, ..options };
    if format == Format::Gltf && Format::from_path(path) == Some(format) {
        // Its bytes are in a file beside it, which a stream would not find.
        let loaded = read(path, &options)?;
        return Ok(Input {
            name,
            format: loaded.format.unwrap_or(format),
            bytes: known_len.unwrap_or(0),
            loaded,
        });
    }
    let mut stream = Counted::new(file, progress_bar(known_len.unwrap_or(0), "reading"));
    let loaded = read_from(format, &mut stream, &name, &options)?;
    Ok(Input { name, format: loaded.format.unwrap_or(format), bytes: stream.finish().1, loaded })
}
