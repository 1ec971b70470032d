//! What is read is not written over.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::args::{Args, is_stream};
use crate::numbered::Numbered;
use crate::target::Target;
use crate::timeline::Timeline;

/// Refuses to write over the groom, the mesh, or one file twice.
pub(crate) fn refuse(args: &Args, target: Option<&Target>, timeline: &Timeline) -> Result<()> {
    let mesh = args.mesh()?;
    let outputs = target.into_iter().flat_map(|target| target.files(timeline.frames()));
    let report = args.report.clone().filter(|report| !is_stream(report));
    if let (Some(target), Some(report)) = (target, &report)
        && target.files(timeline.frames()).any(|output| is_same(&output, report))
    {
        bail!("{} would be both the output and the report; name another file", report.display());
    }
    for output in outputs.chain(report) {
        if is_same(&output, args.groom()) {
            bail!("{} is the groom and would be written over; name another output", output.display());
        }
        if is_same(&output, mesh) || is_of_sequence(&output, mesh) {
            bail!("{} is the mesh and would be written over; name another output", output.display());
        }
    }
    Ok(())
}

/// Whether two paths are one file, there or yet to be.
fn is_same(a: &Path, b: &Path) -> bool {
    place(a).is_some_and(|a| Some(a) == place(b))
}

/// A path without detours; `None` when its folder is not there.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(path) = path.canonicalize() {
        return Some(path);
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Some(folder.canonicalize().ok()?.join(path.file_name()?))
}

/// Whether a path belongs to the sequence `pattern`.
fn is_of_sequence(path: &Path, pattern: &Path) -> bool {
    let Some(numbered) = Numbered::of(pattern) else { return false };
    let name = path.file_name().and_then(|name| name.to_str());
    let beside = name.is_some_and(|name| is_same(&pattern.with_file_name(name), path));
    beside && name.is_some_and(|name| numbered.matches(name))
}
