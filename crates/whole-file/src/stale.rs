//! Temporary files of processes that were killed.

use std::fs;
use std::path::Path;

/// Removes temporary files that killed processes left beside `path`; returns how many.
///
/// A file counts as stale when it carries `path`'s temporary name and its process is gone. Where that
/// cannot be told (no `/proc`), nothing is removed.
pub fn clear_stale(path: impl AsRef<Path>) -> usize {
    // As when it was created: beside the file a link points at.
    let path = path.as_ref().canonicalize().unwrap_or_else(|_| path.as_ref().to_owned());
    let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { return 0 };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let prefix = format!(".{}.", name.to_string_lossy());
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    entries
        .flatten()
        .filter(|entry| process_of(&entry.file_name().to_string_lossy(), &prefix).is_some_and(is_gone))
        .filter(|entry| fs::remove_file(entry.path()).is_ok())
        .count()
}

/// The process id in `.NAME.PID.RANDOM.tmp`.
fn process_of(file_name: &str, prefix: &str) -> Option<u32> {
    let (pid, random) = file_name.strip_prefix(prefix)?.strip_suffix(".tmp")?.split_once('.')?;
    if random.is_empty() || random.contains('.') { None } else { pid.parse().ok() }
}

fn is_gone(process: u32) -> bool {
    Path::new("/proc/self").exists() && !Path::new("/proc").join(process.to_string()).exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_dead_processes_files_go() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("frame.exr");
        let dead = folder.path().join(".frame.exr.4294967295.aBc123.tmp");
        let kept = [
            folder.path().join(format!(".frame.exr.{}.aBc123.tmp", std::process::id())),
            folder.path().join(".frame.exr.txt"),
            folder.path().join(".frame.exr.tmp"),
            folder.path().join(".other.exr.4294967295.aBc123.tmp"),
        ];
        for path in kept.iter().chain([&dead]) {
            fs::write(path, b"x").unwrap();
        }
        let cleared = clear_stale(&target);
        if Path::new("/proc/self").exists() {
            assert_eq!(cleared, 1);
            assert!(!dead.exists());
        }
        assert!(kept.iter().all(|path| path.exists()));
    }
}
