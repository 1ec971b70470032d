//! Writing the output.

use std::io;
use std::path::Path;

use anyhow::Result;
use command_line::progress_bar;
use groom::Groom;
use groom_formats::{Format, Output, Warning, WriteOptions, write, write_seekable, write_to};
use whole_file::clear_stale;

use crate::args::is_stream;
use crate::counted::Counted;

/// Writes the groom, and clears away what a killed run left beside it; returns what the format could not
/// hold and how many bytes were written.
pub(crate) fn store(
    groom: &Groom,
    output: &Path,
    format: Format,
    options: &WriteOptions,
) -> Result<(Vec<Warning>, u64)> {
    let bar = progress_bar(groom.point_count() as u64 * bytes_a_point(format), "writing");
    if is_stream(output) {
        let mut stream = Counted::new(io::stdout().lock(), bar);
        let warnings = write_to(format, groom, &mut stream, "standard output", options)?;
        return Ok((warnings, stream.finish().1));
    }
    clear(output, format);
    if !format.streams() {
        let warnings = write(groom, output, options)?;
        return Ok((warnings, size(output) + size(&output.with_extension("bin"))));
    }
    let name = output.display().to_string();
    let file = Output::create(output)?;
    let goes_back = file.can_seek();
    let mut stream = Counted::new(file, bar);
    let warnings = if goes_back {
        write_seekable(format, groom, &mut stream, &name, options)?
    } else {
        write_to(format, groom, &mut stream, &name, options)?
    };
    let (file, bytes) = stream.finish();
    file.commit()?;
    // What was gone back to was counted twice.
    Ok((warnings, if goes_back { size(output) } else { bytes }))
}

/// Clears away what killed runs left beside the output.
pub(crate) fn clear(output: &Path, format: Format) {
    clear_stale(output);
    if !format.streams() {
        clear_stale(output.with_extension("bin"));
    }
}

/// Bytes of a finished file.
pub(crate) fn size(path: &Path) -> u64 {
    path.metadata().map_or(0, |m| m.len())
}

/// About how many bytes a point takes, for the bar.
fn bytes_a_point(format: Format) -> u64 {
    match format {
        Format::Hair | Format::Gltf | Format::Glb | Format::Usdc | Format::Usdz | Format::Alembic => 28,
        Format::Data | Format::Ply => 16,
        Format::Usda => 70,
        Format::Pbrt => 150,
        _ => 60,
    }
}
