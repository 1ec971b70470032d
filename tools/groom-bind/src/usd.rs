//! What is left to OpenUSD's own package.

use std::io::{self, Write};
use std::path::Path;

use anyhow::Result;
use command_line::Outcome;
use usd_core::{Severity, UsdCore};

/// Refuses early what cannot be checked in the end.
pub(crate) fn checker() -> Result<UsdCore> {
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
