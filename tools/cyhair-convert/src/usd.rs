//! What is left to OpenUSD's own package.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use command_line::Outcome;
use groom_formats::Format;
use tempfile::TempDir;
use usd_core::{BakeOptions, Severity, UsdCore};

/// A stage that was baked; the file goes away with the value.
pub(crate) struct Baked {
    pub(crate) path: PathBuf,
    _folder: TempDir,
}

/// Flattens the stage `input` and bakes its animation.
pub(crate) fn bake(input: &Path, format: Format) -> Result<Baked> {
    if !is_usd(format) {
        bail!("--bake is for USD, and {} is {format}", input.display());
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("baked.usdc");
    UsdCore::find()?.bake(input, &path, BakeOptions::default())?;
    Ok(Baked { path, _folder: folder })
}

/// Refuses early what cannot be checked in the end.
pub(crate) fn checker(output: &Path, format: Format) -> Result<UsdCore> {
    if !is_usd(format) {
        bail!("--check is for USD, and {} is {format}", output.display());
    }
    Ok(UsdCore::find()?)
}

/// Judges a stage that was written, and says on stderr what was found.
pub(crate) fn check(checker: &UsdCore, output: &Path) -> Result<Outcome> {
    let findings = checker.check(output)?;
    let mut stderr = io::stderr().lock();
    for finding in &findings {
        writeln!(stderr, "check: {finding}")?;
    }
    let errors = findings.iter().filter(|finding| finding.severity == Severity::Error).count();
    writeln!(stderr, "check: {}: {errors} errors, {} findings", output.display(), findings.len())?;
    Ok(if errors > 0 { Outcome::Wanting } else { Outcome::Good })
}

fn is_usd(format: Format) -> bool {
    matches!(format, Format::Usda | Format::Usdc | Format::Usdz)
}
