//! A HAIR file mapped into memory: the only unsafe code of the workspace.

use std::path::{Path, PathBuf};

use memmap2::Mmap;

use crate::file::open_file;
use crate::{HairError, HairView};

/// A file mapped into memory, to be looked at with a [`HairView`].
///
/// The map shows the file itself: when another program cuts or rewrites the file in place while it
/// is mapped, values change under the reader, and reading beyond a cut ends the program (SIGBUS).
/// Map files that are replaced whole, as groomkit's own writers do, or read them instead.
#[derive(Debug)]
pub struct MappedHair {
    map: Mmap,
    path: PathBuf,
}

impl MappedHair {
    /// Maps the file at `path`. Nothing is read or checked until [`MappedHair::view`].
    ///
    /// # Errors
    /// [`HairError::Open`].
    pub fn open(path: impl AsRef<Path>) -> Result<Self, HairError> {
        let path = path.as_ref().to_owned();
        let (file, _) = open_file(&path)?;
        // SAFETY: the map is read-only and private to this value, and every view of it borrows this
        // value, so no view outlives the map. Every byte pattern is a valid `u8`, and values are made
        // from bytes by copies or by checked casts. What cannot be ruled out, a file changed in place
        // by somebody else, is the caller's to avoid and said in the type's documentation.
        #[allow(unsafe_code)]
        let map = unsafe { Mmap::map(&file) };
        match map {
            Ok(map) => Ok(MappedHair { map, path }),
            Err(source) => Err(HairError::Open { path, source }),
        }
    }

    /// The bytes of the file.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.map
    }

    /// Checks the file and gives its arrays in place.
    ///
    /// # Errors
    /// Those of [`HairView::new`], as the source of a [`HairError::File`] that names the path.
    pub fn view(&self) -> Result<HairView<'_>, HairError> {
        HairView::new(&self.map).map_err(|error| error.of_file(&self.path))
    }
}
