//! Whose a temporary file is, as its name tells.

use std::ffi::OsString;
use std::fs::{self, DirEntry};
use std::path::Path;
use std::time::{Duration, SystemTime};

use crate::host::host;

/// A file nobody wrote to for so long is nobody's, whichever machine began it: no clock of a farm is off by a day.
pub(crate) const LONG_AGO: Duration = Duration::from_secs(24 * 60 * 60);

/// Temporary names under which other processes are writing the file at `path`, in no order.
///
/// A hint and no lock: they may have ended since, of processes on other machines nothing is known but that they wrote
/// within a day, and others may begin at any time.
pub fn other_writers(path: impl AsRef<Path>) -> Vec<OsString> {
    let others = temporaries_of(path.as_ref()).into_iter();
    let others = others.filter(|(owner, entry)| !owner.is_this_process() && !owner.is_gone(entry));
    others.map(|(_, entry)| entry.file_name()).collect()
}

/// All temporary files that are to become the file at `path`.
pub(crate) fn temporaries_of(path: &Path) -> Vec<(Owner, DirEntry)> {
    // As when it was created: beside the file a link points at.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { return Vec::new() };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let prefix = format!(".{}.", name.to_string_lossy());
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let owned = |entry: DirEntry| Some((Owner::of(&entry.file_name().to_string_lossy(), &prefix)?, entry));
    entries.filter_map(owned).collect()
}

/// What stands before host, process and random letters in the temporary name of any file.
pub(crate) fn prefix_of(file_name: &str) -> Option<&str> {
    let stem = file_name.strip_suffix(".tmp").filter(|stem| stem.starts_with('.'))?;
    let (at, _) = stem.rmatch_indices('.').nth(2).filter(|(at, _)| *at > 1)?;
    file_name.get(..=at)
}

/// Who began a temporary file.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Owner {
    /// Whether it is this machine; never in names of earlier versions, `.NAME.PID.RANDOM.tmp`.
    is_here: bool,
    process: u32,
}

impl Owner {
    /// As `.NAME.HOST.PID.RANDOM.tmp` says it; `None` for all other names.
    pub fn of(file_name: &str, prefix: &str) -> Option<Self> {
        let words: Vec<&str> = file_name.strip_prefix(prefix)?.strip_suffix(".tmp")?.split('.').collect();
        let (found, process, random) = match words[..] {
            [host, process, random] => (Some(host), process, random),
            [process, random] => (None, process, random),
            _ => return None,
        };
        let process = process.parse().ok().filter(|_| !random.is_empty())?;
        Some(Owner { is_here: found.is_some() && found == host(), process })
    }

    fn is_this_process(&self) -> bool {
        self.is_here && self.process == std::process::id()
    }

    /// Whether its process is gone, or has not written to this file for so long that it may be taken for gone.
    pub fn is_gone(&self, entry: &DirEntry) -> bool {
        if self.is_here && Path::new("/proc/self").exists() {
            return !Path::new("/proc").join(self.process.to_string()).exists();
        }
        let written = entry.metadata().and_then(|found| found.modified());
        let age = written.ok().and_then(|written| SystemTime::now().duration_since(written).ok());
        age.is_some_and(|age| age > LONG_AGO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WholeFile;

    #[test]
    fn only_living_others_are_writers() {
        let Some(host) = host() else { return };
        if !Path::new("/proc/self").exists() {
            return;
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        assert!(other_writers(&path).is_empty());
        let _own = WholeFile::create(&path).unwrap();
        // The first process of the machine lives as long as this test.
        let living = format!(".a.exr.{host}.1.aBc123.tmp");
        let elsewhere = ".a.exr.other-host.1.aBc123.tmp".to_owned();
        let others = [
            format!(".a.exr.{host}.4294967295.aBc123.tmp"),
            format!(".b.exr.{host}.1.aBc123.tmp"),
            ".a.exr.tmp".to_owned(),
        ];
        for name in others.iter().chain([&living, &elsewhere]) {
            fs::write(folder.path().join(name), b"").unwrap();
        }
        let mut found = other_writers(&path);
        found.sort();
        let mut wanted = vec![OsString::from(living), elsewhere.into()];
        wanted.sort();
        assert_eq!(found, wanted);
    }
}
