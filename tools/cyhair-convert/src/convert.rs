//! `cyhair-convert IN OUT`.

use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

use anyhow::Result;
use command_line::progress_bar;
use groom::{Groom, names};
use groom_formats::{Format, Output, Warning, WriteOptions, write, write_to};
use serde_json::json;
use whole_file::clear_stale;

use crate::args::{Args, is_stream};
use crate::counted::Counted;
use crate::edit::Edits;
use crate::load::{Input, load};
use crate::report;

pub(crate) fn run(args: &Args) -> Result<()> {
    let start = Instant::now();
    let (output, format) = args.target()?;
    let Input { name, format: input_format, bytes: input_bytes, loaded } = load(args)?;
    let mut warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    if !args.json {
        report::say_all("repaired", &loaded.repairs)?;
        report::say_all("warning", &warnings)?;
    }
    let had_ids = loaded.groom.attribute(names::ID).is_some();
    let mut edits = Edits::new(args);
    let groom = edits.apply(loaded.groom)?;
    let options =
        WriteOptions { hair: loaded.hair, quantize: args.strands.quantize, ..WriteOptions::default() };
    let (lost, output_bytes) = store(&groom, output, format, &options)?;
    // Thinning out gives the strands numbers; nobody misses those.
    let is_missed = |warning: &&Warning| had_ids || !is_about_ids(warning);
    let lost: Vec<String> = lost.iter().filter(is_missed).map(ToString::to_string).collect();
    let seconds = start.elapsed().as_secs_f64();
    if !args.json {
        report::say_all("warning", &lost)?;
        let target = if is_stream(output) { "standard output".into() } else { output.display().to_string() };
        writeln!(
            io::stderr().lock(),
            "{name} -> {target}: {} strands, {} points, {:.1} MB in {seconds:.2} s",
            groom.strand_count(),
            groom.point_count(),
            output_bytes as f64 / 1e6
        )?;
        return Ok(());
    }
    warnings.extend(lost);
    report::print_json(&json!({
        "input": name,
        "input_format": input_format.name(),
        "input_bytes": input_bytes,
        "output": output.display().to_string(),
        "output_format": format.name(),
        "output_bytes": output_bytes,
        "strands": groom.strand_count(),
        "points": groom.point_count(),
        "quantize_error": edits.quantize_error,
        "seconds": seconds,
        "warnings": warnings,
        "repairs": loaded.repairs,
    }))
}

fn is_about_ids(warning: &Warning) -> bool {
    matches!(warning, Warning::AttributeLeftOut { name, .. } if name == names::ID)
}

/// Writes the groom, and clears away what a killed run left beside it; returns what the format could not hold and how many bytes were written.
fn store(
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
    clear_stale(output);
    if !format.streams() {
        clear_stale(output.with_extension("bin"));
        let warnings = write(groom, output, options)?;
        let size = |path: &Path| path.metadata().map_or(0, |m| m.len());
        return Ok((warnings, size(output) + size(&output.with_extension("bin"))));
    }
    let mut stream = Counted::new(Output::create(output)?, bar);
    let warnings = write_to(format, groom, &mut stream, &output.display().to_string(), options)?;
    let (file, bytes) = stream.finish();
    file.commit()?;
    Ok((warnings, bytes))
}

/// About how many bytes a point takes, for the bar.
fn bytes_a_point(format: Format) -> u64 {
    match format {
        Format::Hair | Format::Gltf | Format::Glb => 28,
        Format::Usda => 70,
        _ => 60,
    }
}
