//! Reading the input.

use std::fs::File;
use std::io;

use anyhow::{Context, Result};
use command_line::progress_bar;
use groom_formats::{Format, Loaded, ReadOptions, read_from};

use crate::args::{Args, is_stream};
use crate::counted::Counted;

/// An input that was read.
pub(crate) struct Input {
    pub(crate) name: String,
    pub(crate) format: Format,
    pub(crate) bytes: u64,
    pub(crate) loaded: Loaded,
}

pub(crate) fn load(args: &Args) -> Result<Input> {
    let format = args.input_format()?;
    let mut options = ReadOptions {
        up_axis: args.input_up.map(Into::into),
        meters_per_unit: args.meters_per_unit,
        repair: args.repair,
        ..ReadOptions::default()
    };
    let (name, loaded, bytes) = if is_stream(&args.input) {
        let name = "standard input".to_owned();
        let mut stream = Counted::new(io::stdin().lock(), progress_bar(0, "reading"));
        let loaded = read_from(format, &mut stream, &name, &options)?;
        (name, loaded, stream.finish().1)
    } else {
        let name = args.input.display().to_string();
        let file = File::open(&args.input).with_context(|| name.clone())?;
        // A pipe's or a device's length says nothing.
        options.known_len = file.metadata().ok().filter(|m| m.is_file()).map(|m| m.len());
        let mut stream = Counted::new(file, progress_bar(options.known_len.unwrap_or(0), "reading"));
        let loaded = read_from(format, &mut stream, &name, &options)?;
        (name, loaded, stream.finish().1)
    };
    Ok(Input { name, format, bytes, loaded })
}
