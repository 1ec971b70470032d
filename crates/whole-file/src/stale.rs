//! Temporary files of processes that were killed.

use std::fs::{self, DirEntry};
use std::path::Path;

use crate::owner::{Owner, prefix_of, temporaries_of};

/// Removes temporary files that killed processes left beside `path`; returns how many.
///
/// A file counts as stale when it carries `path`'s temporary name and its process, on this machine, is gone. Of a
/// process on another machine, which may share the folder, nothing is known here: its files are stale when nobody
/// wrote to them for a day, and so are those of this machine where it cannot be told whether a process lives (no
/// `/proc`).
pub fn clear_stale(path: impl AsRef<Path>) -> usize {
    let stale = temporaries_of(path.as_ref()).into_iter().filter(|(owner, entry)| owner.is_gone(entry));
    stale.filter(|(_, entry)| fs::remove_file(entry.path()).is_ok()).count()
}

/// Removes temporary files that killed processes left in `folder`, whatever they were to become; returns how many.
///
/// For folders that a program looks after as a whole: one look where [`clear_stale`] takes one for every file. What
/// counts as stale is the same.
pub fn clear_stale_in(folder: impl AsRef<Path>) -> usize {
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    let stale = |entry: &DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        prefix_of(&name).and_then(|prefix| Owner::of(&name, prefix)).is_some_and(|owner| owner.is_gone(entry))
    };
    entries.flatten().filter(stale).filter(|entry| fs::remove_file(entry.path()).is_ok()).count()
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;
    use std::time::{Duration, SystemTime};

    use super::*;
    use crate::host::host;
    use crate::owner::LONG_AGO;

    fn put(path: &PathBuf, age: Duration) {
        fs::write(path, b"x").unwrap();
        let file = fs::File::options().write(true).open(path).unwrap();
        file.set_modified(SystemTime::now() - age).unwrap();
    }

    #[test]
    fn a_folder_is_swept_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let Some(host) = host() else { return };
        let at = |name: &str| folder.path().join(name);
        let gone = [
            format!(".frame.0001.exr.{host}.4294967295.aBc123.tmp"),
            format!("..frame.0001.part.exr.{host}.4294967295.aBc123.tmp"),
            format!(".x.{host}.4294967295.aBc123.tmp"),
        ];
        let kept = [
            format!(".frame.exr.{host}.{}.aBc123.tmp", std::process::id()),
            ".frame.exr.other-host.4294967295.aBc123.tmp".to_owned(),
            format!("frame.exr.{host}.4294967295.aBc123.tmp"),
            format!(".{host}.4294967295.aBc123.tmp"),
            ".a.tmp".to_owned(),
            ".tmp".to_owned(),
            "....tmp".to_owned(),
        ];
        gone.iter().chain(&kept).for_each(|name| put(&at(name), Duration::ZERO));
        let cleared = clear_stale_in(folder.path());
        assert!(kept.iter().all(|name| at(name).exists()));
        if Path::new("/proc/self").exists() {
            assert_eq!(cleared, gone.len());
            assert!(gone.iter().all(|name| !at(name).exists()));
        }
        assert_eq!(clear_stale_in(folder.path().join("none")), 0);
    }

    #[test]
    fn only_the_dead_processes_files_go() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: String| folder.path().join(name);
        let Some(host) = host() else { return };
        let me = std::process::id();
        let day = LONG_AGO + Duration::from_secs(60);
        let kept = [
            // This process's, however old; other hosts' and nobody's of late.
            (format!(".frame.exr.{host}.{me}.aBc123.tmp"), day),
            (".frame.exr.other-host.4294967295.aBc123.tmp".into(), Duration::ZERO),
            (".frame.exr.other-host.1.aBc123.tmp".into(), LONG_AGO - Duration::from_secs(60)),
            (".frame.exr.4294967295.aBc123.tmp".into(), Duration::ZERO),
            // Others' names.
            (".frame.exr.txt".into(), day),
            (".frame.exr.tmp".into(), day),
            (format!(".other.exr.{host}.4294967295.aBc123.tmp"), day),
            (".frame.exr.a.b.4294967295.aBc123.tmp".into(), day),
        ];
        let gone = [
            (format!(".frame.exr.{host}.4294967295.aBc123.tmp"), Duration::ZERO),
            (".frame.exr.other-host.4294967295.xYz123.tmp".into(), day),
            (".frame.exr.4294967295.xYz123.tmp".into(), day),
        ];
        for (name, age) in kept.iter().chain(&gone) {
            put(&at(name.clone()), *age);
        }
        let cleared = clear_stale(at("frame.exr".into()));
        assert!(kept.iter().all(|(name, _)| at(name.clone()).exists()));
        if Path::new("/proc/self").exists() {
            assert_eq!(cleared, 3);
            assert!(gone.iter().all(|(name, _)| !at(name.clone()).exists()));
        }
    }
}
