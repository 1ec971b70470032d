//! Words on stderr, data on stdout.

use std::io::{self, Write};

use anyhow::{Context, Result};
use serde_json::Value;

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
