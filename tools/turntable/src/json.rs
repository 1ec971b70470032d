//! Data for programs, on standard output.

use std::io::Write;

use anyhow::Context;

/// Prints a value as JSON.
pub fn print(value: &impl serde::Serialize) -> anyhow::Result<()> {
    let text = serde_json::to_string_pretty(value).context("writing JSON")?;
    Ok(writeln!(std::io::stdout().lock(), "{text}")?)
}
