//! The materials that come with the program, in words.

use std::io::Write;

use anyhow::Result;
use command_line::Outcome;
use fibre_material::Preset;

/// Prints every preset: its name, where its figures are from, and what a material file would say instead.
pub fn list() -> Result<Outcome> {
    let mut out = std::io::stdout().lock();
    for Preset { name, keys, source } in Preset::all() {
        writeln!(out, "{name}: {source}\n    {{{keys}}}")?;
    }
    Ok(Outcome::Good)
}
