//! What to measure of a reduced export.

use std::path::PathBuf;

use clap::{Args, value_parser};

use super::values::length;

/// Endings a report can have.
const ENDINGS: [&str; 3] = ["html", "csv", "json"];

/// Options that measure what --tolerance and --quantize cost and save; [`crate::reduction`] does it.
#[derive(Args, Debug)]
#[command(next_help_heading = "Error report")]
#[group(id = "measuring", multiple = true)]
pub(crate) struct Measuring {
    /// Write bytes and seconds of the export against its distance from the groom without --tolerance and
    /// --quantize; .html, .csv or .json
    #[arg(long, value_name = "FILE", value_parser = report_file)]
    pub(crate) report: Option<PathBuf>,

    /// Measure --quantize with each of these as well (4 to 24)
    #[arg(long, value_name = "BITS,...", value_delimiter = ',', requires = "report",
        value_parser = value_parser!(u32).range(4..=24))]
    pub(crate) sweep_quantize: Vec<u32>,

    /// Measure --tolerance with each of these as well (0 or more)
    #[arg(long, value_name = "DISTANCE,...", value_delimiter = ',', requires = "report", value_parser = length)]
    pub(crate) sweep_tolerance: Vec<f32>,
}

fn report_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension().and_then(|ending| ending.to_str()) {
        Some(ending) if ENDINGS.contains(&ending) => Ok(path),
        _ => Err(format!("expected an ending among .{}", ENDINGS.join(", ."))),
    }
}
