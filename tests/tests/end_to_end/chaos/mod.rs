//! Renderers that are killed at any moment, many in one folder; disks that are full or may not be written.

#[cfg(target_os = "linux")]
mod disks;
#[cfg(unix)]
mod storm;
mod watcher;
