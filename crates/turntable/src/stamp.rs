//! Whether a file is still the one that was seen, without reading it.

use std::fs::Metadata;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

/// Size and times of a file: as long as they stay, so do its bytes, unless the disk itself fails.
///
/// The time of the last change of anything about the file counts where there is one (Unix): no program can set it back,
/// as it can the time of the last write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Stamp {
    pub size: u64,
    /// Nanoseconds since 1970.
    pub modified: u64,
    /// Nanoseconds since 1970; 0 where the system does not tell.
    pub changed: u64,
}

impl Stamp {
    /// None where there is no file, or its times cannot be told.
    pub fn of(path: &Path) -> Option<Stamp> {
        Stamp::from(&path.metadata().ok()?)
    }

    pub fn from(metadata: &Metadata) -> Option<Stamp> {
        let modified = metadata.modified().ok()?;
        metadata.is_file().then_some(Stamp {
            size: metadata.len(),
            modified: nanoseconds(modified)?,
            changed: changed(metadata),
        })
    }

    /// Whether the file has rested long enough that whoever writes it anew gives it another stamp: clocks of file
    /// systems tick every 2 seconds at worst.
    pub fn is_settled(&self) -> bool {
        let now = nanoseconds(SystemTime::now()).unwrap_or_default();
        now.saturating_sub(self.modified.max(self.changed)) > 2_500_000_000
    }
}

fn nanoseconds(time: SystemTime) -> Option<u64> {
    u64::try_from(time.duration_since(UNIX_EPOCH).ok()?.as_nanos()).ok()
}

#[cfg(unix)]
fn changed(metadata: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    let seconds = u64::try_from(metadata.ctime()).unwrap_or_default();
    seconds
        .saturating_mul(1_000_000_000)
        .saturating_add(u64::try_from(metadata.ctime_nsec()).unwrap_or_default())
}

#[cfg(not(unix))]
fn changed(_metadata: &Metadata) -> u64 {
    0
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn every_change_shows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        assert_eq!(Stamp::of(&path), None);
        assert_eq!(Stamp::of(folder.path()), None);
        std::fs::write(&path, "one").unwrap();
        let first = Stamp::of(&path).unwrap();
        assert_eq!(Stamp::of(&path), Some(first));
        assert!(!first.is_settled(), "just written");
        assert!(Stamp { modified: 1, changed: 1, ..first }.is_settled());
        std::fs::write(&path, "three").unwrap();
        assert_ne!(Stamp::of(&path), Some(first), "the size");
        let file = std::fs::File::options().write(true).open(&path).unwrap();
        let before = Stamp::of(&path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(60)).unwrap();
        assert_ne!(Stamp::of(&path), Some(before), "the time");
    }

    #[test]
    #[cfg(unix)]
    fn a_time_that_was_set_back_shows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "one").unwrap();
        let first = Stamp::of(&path).unwrap();
        let modified = path.metadata().unwrap().modified().unwrap();
        std::thread::sleep(Duration::from_millis(30)); // clocks of file systems tick every 10 ms at worst here
        std::fs::write(&path, "two").unwrap();
        std::fs::File::options().write(true).open(&path).unwrap().set_modified(modified).unwrap();
        let second = Stamp::of(&path).unwrap();
        assert_eq!((first.size, first.modified), (second.size, second.modified));
        assert_ne!(first, second);
    }
}
