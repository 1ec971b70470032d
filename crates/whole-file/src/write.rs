//! Write to a temporary name, then rename.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use crate::host::host;
use crate::{WholeFileError, live};

/// A file being written under a temporary name beside its target.
///
/// Unbuffered: wrap it in a [`std::io::BufWriter`] for small writes, and take it back out with
/// `into_inner` before [`WholeFile::commit`].
#[derive(Debug)]
pub struct WholeFile {
    temporary: NamedTempFile,
    registration: Registration,
    target: PathBuf,
}

impl WholeFile {
    /// Opens a temporary file in the folder of `path`, which must exist.
    ///
    /// # Errors
    /// [`WholeFileError`] when the path names no file (but a folder, a device, a pipe) or the folder
    /// cannot be written.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, WholeFileError> {
        let asked = path.as_ref();
        let fault = |action, source| WholeFileError { path: asked.to_owned(), action, source };
        // Through a symbolic link the file it points at is replaced, not the link.
        let target = asked.canonicalize().unwrap_or_else(|_| asked.to_owned());
        let Some(name) = target.file_name() else {
            return Err(fault("name the file", io::Error::from(io::ErrorKind::InvalidInput)));
        };
        if target.is_dir() {
            return Err(fault("replace a folder by a file", io::Error::from(io::ErrorKind::IsADirectory)));
        }
        // Renamed over, `/dev/null` would be an ordinary file for everybody.
        if target.metadata().is_ok_and(|old| !old.is_file()) {
            return Err(fault("replace what is no file", io::Error::from(io::ErrorKind::InvalidInput)));
        }
        let host = host().map_or_else(String::new, |host| format!("{host}."));
        let prefix = format!(".{}.{host}{}.", name.to_string_lossy(), std::process::id());
        let mut builder = Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        #[cfg(unix)]
        builder.permissions(permissions_like(&target));
        let temporary =
            builder.tempfile_in(folder_of(&target)).map_err(|e| fault("create a temporary file", e))?;
        let registration = Registration::of(temporary.path());
        Ok(WholeFile { temporary, registration, target })
    }

    /// Where the bytes are until [`WholeFile::commit`], for another program that is to write them.
    #[must_use]
    pub fn temporary_path(&self) -> &Path {
        self.temporary.path()
    }

    /// Flushes the bytes to the disk and renames the file into place.
    ///
    /// # Errors
    /// [`WholeFileError`]; the temporary file is then removed and the old file untouched.
    pub fn commit(self) -> Result<(), WholeFileError> {
        let WholeFile { temporary, registration, target } = self;
        let result = sync_and_rename(temporary, &target);
        drop(registration);
        result.map_err(|(action, source)| WholeFileError { path: target, action, source })
    }
}

fn sync_and_rename(mut temporary: NamedTempFile, target: &Path) -> Result<(), (&'static str, io::Error)> {
    temporary.flush().and_then(|()| temporary.as_file().sync_all()).map_err(|e| ("flush", e))?;
    temporary.persist(target).map_err(|e| ("rename into place", e.error))?;
    sync_folder(target).map_err(|e| ("flush the folder", e))
}

/// Makes the rename itself last; folders cannot be opened for this on Windows.
fn sync_folder(target: &Path) -> io::Result<()> {
    if cfg!(unix) { File::open(folder_of(target))?.sync_all() } else { Ok(()) }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The old file's mode, or what a plain `create` asks for (the umask applies to both).
#[cfg(unix)]
fn permissions_like(target: &Path) -> std::fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    target.metadata().map_or_else(|_| std::fs::Permissions::from_mode(0o666), |old| old.permissions())
}

/// Keeps a temporary path known to [`crate::abandon_all`] for as long as the file lives.
#[derive(Debug)]
struct Registration(PathBuf);

impl Registration {
    fn of(path: &Path) -> Self {
        live::enter(path);
        Registration(path.to_owned())
    }
}

impl Drop for Registration {
    fn drop(&mut self) {
        live::leave(&self.0);
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.temporary.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.temporary.as_file_mut().flush()
    }
}

impl Seek for WholeFile {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.temporary.as_file_mut().seek(position)
    }
}

/// Writes `bytes` to `path`, whole or not at all.
///
/// # Errors
/// [`WholeFileError`]; the old file is then untouched.
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), WholeFileError> {
    let path = path.as_ref();
    let mut file = WholeFile::create(path)?;
    file.write_all(bytes).map_err(|source| WholeFileError {
        path: path.to_owned(),
        action: "write",
        source,
    })?;
    file.commit()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn old_file_stays_until_the_commit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        drop(file);
        assert_eq!((fs::read(&path).unwrap(), names(folder.path()).len()), (b"old".to_vec(), 1));
        write_whole(&path, b"new").unwrap();
        assert_eq!((fs::read(&path).unwrap(), names(folder.path()).len()), (b"new".to_vec(), 1));
    }

    #[test]
    fn bad_targets_are_named() {
        let folder = tempfile::tempdir().unwrap();
        let mut paths =
            vec![folder.path().join("no/such/folder.txt"), folder.path().to_owned(), PathBuf::from("/")];
        #[cfg(unix)]
        {
            // Never a real device here: a broken check would replace it.
            paths.push(folder.path().join("socket"));
            let _socket = std::os::unix::net::UnixListener::bind(&paths[3]).unwrap();
        }
        for path in paths {
            let error = WholeFile::create(&path).unwrap_err();
            assert!(error.to_string().contains(&*path.to_string_lossy()), "{error}");
        }
    }

    #[test]
    fn the_temporary_name_says_whose_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let _file = WholeFile::create(folder.path().join("a.exr")).unwrap();
        let (name, process) = (names(folder.path()).remove(0), std::process::id());
        let host = host().map_or_else(String::new, |host| format!("{host}."));
        assert!(name.starts_with(&format!(".a.exr.{host}{process}.")) && name.ends_with(".tmp"), "{name}");
    }

    /// What is written in bits and pieces arrives whole; a writer may take less than it is given.
    #[test]
    fn short_writes_add_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bin");
        let bytes: Vec<u8> = (0..100_000u32).map(|i| ((i * 31) >> 3) as u8).collect();
        let mut file = io::BufWriter::with_capacity(7, WholeFile::create(&path).unwrap());
        for (i, piece) in bytes.chunks(13).enumerate() {
            file.write_all(piece).unwrap();
            if i % 100 == 0 {
                file.flush().unwrap();
            }
        }
        file.into_inner().unwrap().commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), bytes);
    }

    /// Not even root may write there.
    #[cfg(target_os = "linux")]
    #[test]
    fn folders_that_cannot_be_written_to_are_named() {
        for path in ["/sys/frame.exr", "/proc/self/frame.exr"] {
            let error = WholeFile::create(path).unwrap_err().to_string();
            assert!(error.contains(path) && error.contains("could not create a temporary file"), "{error}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_modes_kept() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert!(link.symlink_metadata().unwrap().file_type().is_symlink());
        assert_eq!(path.metadata().unwrap().permissions().mode() & 0o777, 0o640);
    }
}
