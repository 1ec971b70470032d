//! Where a file goes.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use whole_file::WholeFile;

use crate::FormatError;

/// A path being written: a file takes its name only when it is whole, a device or a named pipe is
/// written to as it stands (replacing `/dev/null` by a file would take it from everybody).
///
/// Unbuffered.
#[derive(Debug)]
pub struct Output(Kind);

#[derive(Debug)]
enum Kind {
    Whole(WholeFile),
    Device(File),
}

impl Output {
    /// Opens `path` for writing; a file there stays untouched until [`Output::commit`].
    ///
    /// # Errors
    /// [`FormatError::WholeFile`] or [`FormatError::Io`], which name the path.
    pub fn create(path: &Path) -> Result<Self, FormatError> {
        if is_device(path) {
            let file = OpenOptions::new().write(true).open(path);
            return file
                .map(|file| Output(Kind::Device(file)))
                .map_err(|e| FormatError::io(&path.display().to_string(), e));
        }
        let file = WholeFile::create(path).map_err(|source| FormatError::WholeFile { source })?;
        Ok(Output(Kind::Whole(file)))
    }

    /// Whether the file can go back: a device or a named pipe cannot.
    #[must_use]
    pub fn can_seek(&self) -> bool {
        matches!(self.0, Kind::Whole(_))
    }

    /// Puts the finished file in its place.
    ///
    /// # Errors
    /// [`FormatError::WholeFile`]; the old file is then untouched.
    pub fn commit(self) -> Result<(), FormatError> {
        match self.0 {
            Kind::Whole(file) => file.commit().map_err(|source| FormatError::WholeFile { source }),
            Kind::Device(_) => Ok(()),
        }
    }
}

/// Whether there is something at `path` that a file must not take the place of.
pub(crate) fn is_device(path: &Path) -> bool {
    path.metadata().is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.0 {
            Kind::Whole(file) => file.write(bytes),
            Kind::Device(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.0 {
            Kind::Whole(file) => file.flush(),
            Kind::Device(file) => file.flush(),
        }
    }
}

impl Seek for Output {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match &mut self.0 {
            Kind::Whole(file) => file.seek(to),
            Kind::Device(file) => file.seek(to),
        }
    }
}
