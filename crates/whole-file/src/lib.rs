//! Files that are written whole or not at all.
//!
//! A [`WholeFile`] writes to a temporary name in the folder of its target, and [`WholeFile::commit`]
//! flushes it to the disk and renames it into place. Dropped without a commit, killed or out of disk
//! space, it leaves the old file as it was. A reader never sees part of a file.
//!
//! ```
//! use std::io::Write;
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("groom.txt");
//! let mut file = whole_file::WholeFile::create(&path)?;
//! file.write_all(b"0 0 0 0.1\n")?;
//! assert!(!path.exists());
//! file.commit()?;
//! assert_eq!(std::fs::read(&path)?, b"0 0 0 0.1\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Temporary names are `.NAME.HOST.PID.RANDOM.tmp`: several machines may write to a folder that they share. A
//! process that was killed leaves them behind; [`clear_stale`] removes those of one target, [`abandon_all`] those
//! of this process (for Ctrl-C). They tell other processes that somebody is at a file, too ([`other_writers`]).

mod error;
mod host;
mod live;
mod owner;
mod stale;
mod write;

pub use error::WholeFileError;
pub use live::abandon_all;
pub use owner::other_writers;
pub use stale::{clear_stale, clear_stale_in};
pub use write::{WholeFile, write_whole};
