//! Words on stderr, data on stdout.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result};
use groom_formats::{Format, Warning};
use serde_json::{Value, json};

use crate::args::is_stream;

/// What there is to say about a conversion that was done.
pub(crate) struct Done {
    pub(crate) input: String,
    input_format: Format,
    input_bytes: u64,
    output: String,
    output_format: Format,
    output_bytes: u64,
    strands: u64,
    points: u64,
    pub(crate) frames: Option<u64>,
    /// The farthest that quantizing moved a point.
    pub(crate) quantize_error: Option<f64>,
    pub(crate) seconds: f64,
    warnings: Vec<String>,
    repairs: Vec<String>,
    /// How many of the warnings were told already.
    told: usize,
}

impl Done {
    pub(crate) fn new(input: String, from: Format, input_bytes: u64, output: &Path, to: Format) -> Done {
        Done {
            input,
            input_format: from,
            input_bytes,
            output: if is_stream(output) { "standard output".into() } else { output.display().to_string() },
            output_format: to,
            output_bytes: 0,
            strands: 0,
            points: 0,
            frames: None,
            quantize_error: None,
            seconds: 0.0,
            warnings: Vec::new(),
            repairs: Vec::new(),
            told: 0,
        }
    }

    /// Says at once what was odd about the input, unless it all comes as JSON in the end.
    pub(crate) fn tell(&mut self, repairs: &[String], warnings: &[Warning], is_json: bool) -> Result<()> {
        self.repairs = repairs.to_owned();
        self.warnings = warnings.iter().map(ToString::to_string).collect();
        if !is_json {
            say_all("repaired", &self.repairs)?;
            say_all("warning", &self.warnings)?;
        }
        self.told = self.warnings.len();
        Ok(())
    }

    /// Something else to warn of, if there is.
    pub(crate) fn add(&mut self, warning: Option<String>) {
        self.warnings.extend(warning);
    }

    pub(crate) fn finish(&mut self, strands: u64, points: u64, output_bytes: u64, lost: &[Warning]) {
        (self.strands, self.points) = (strands, points);
        self.output_bytes = output_bytes;
        self.warnings.extend(lost.iter().map(ToString::to_string));
    }
}

/// Says what was done: a line on stderr, or JSON on stdout.
pub(crate) fn print_done(done: &Done, is_json: bool) -> Result<()> {
    if is_json {
        return print_json(&json!({
            "input": done.input,
            "input_format": done.input_format.name(),
            "input_bytes": done.input_bytes,
            "output": done.output,
            "output_format": done.output_format.name(),
            "output_bytes": done.output_bytes,
            "strands": done.strands,
            "points": done.points,
            "frames": done.frames,
            "quantize_error": done.quantize_error,
            "seconds": done.seconds,
            "warnings": done.warnings,
            "repairs": done.repairs,
        }));
    }
    say_all("warning", &done.warnings[done.told..])?;
    if let Some(moved) = done.quantize_error {
        let line = format!("--quantize moved points by up to {moved:.1e}, in the groom's units");
        say_all("rounded", &[line])?;
    }
    let frames = done.frames.map(|frames| format!("{frames} frames, ")).unwrap_or_default();
    writeln!(
        io::stderr().lock(),
        "{} -> {}: {frames}{} strands, {} points, {:.1} MB in {:.2} s",
        done.input,
        done.output,
        done.strands,
        done.points,
        done.output_bytes as f64 / 1e6,
        done.seconds
    )?;
    Ok(())
}

/// Says on stderr what was odd, lost or mended.
pub(crate) fn say_all(kind: &str, lines: &[String]) -> Result<()> {
    let mut stderr = io::stderr().lock();
    for line in lines {
        writeln!(stderr, "{kind}: {line}")?;
    }
    Ok(())
}

/// Prints a JSON value on stdout.
pub(crate) fn print_json(value: &Value) -> Result<()> {
    print(&serde_json::to_string_pretty(value)?)
}

/// Prints lines on stdout.
pub(crate) fn print(text: &str) -> Result<()> {
    writeln!(io::stdout().lock(), "{}", text.trim_end()).context("standard output")
}
