//! Where answers go: a file, written whole or not at all, or stdout.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, bail};

/// Refuses names that cannot be written, before any work is done.
pub fn check(path: &Path) -> anyhow::Result<()> {
    if is_stdout(path) {
        return Ok(());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        bail!("{}: there is no folder {}", path.display(), folder.display());
    }
    if path.is_dir() {
        bail!("{} is a folder", path.display());
    }
    Ok(())
}

/// Writes `text` to `path`; `-` is stdout.
pub fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    if is_stdout(path) {
        std::io::stdout().write_all(text.as_bytes())?;
        return Ok(());
    }
    whole_file::write_whole(path, text.as_bytes()).with_context(|| path.display().to_string())
}

fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Says a line on stderr; nobody reading it is no error.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
