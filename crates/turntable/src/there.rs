//! Which frames are in an output folder, and which of them are sound.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use crate::frame_file;
use crate::manifest::Manifest;

/// The frames that are there when a plan is made.
#[derive(Debug, Default)]
pub(crate) struct There {
    /// All of them, as paths inside the output folder.
    files: BTreeSet<PathBuf>,
    /// What the sound ones were made from.
    digests: BTreeMap<PathBuf, String>,
    /// The other way round; the first in order of names.
    places: HashMap<String, PathBuf>,
    /// Sound ones that had to be read to be sure.
    read: Vec<PathBuf>,
}

impl There {
    /// Looks at the folder `frames` and the folders in it.
    ///
    /// A frame whose size and times are those that were written down is taken for sound. Others are read and compared
    /// with what was written down; those that nobody wrote down are unpacked, which takes longest.
    pub fn look(output: &Path, manifest: &Manifest) -> There {
        let mut there = There { files: frame_files(output), ..There::default() };
        for file in &there.files {
            let Some(digest) = sound(output, file, manifest) else { continue };
            if manifest.has_to_read(file) {
                there.read.push(file.clone());
            }
            there.places.entry(digest.clone()).or_insert_with(|| file.clone());
            there.digests.insert(file.clone(), digest);
        }
        there
    }

    pub fn has_file(&self, file: &Path) -> bool {
        self.files.contains(file)
    }

    /// What a sound frame was made from.
    pub fn digest(&self, file: &Path) -> Option<&str> {
        self.digests.get(file).map(String::as_str)
    }

    /// Where a sound frame of this digest is.
    pub fn place(&self, digest: &str) -> Option<&Path> {
        self.places.get(digest).map(PathBuf::as_path)
    }

    /// Sound frames that had to be read, with what they were made from.
    pub fn read(&self) -> impl Iterator<Item = (PathBuf, String)> + '_ {
        self.read.iter().filter_map(|file| Some((file.clone(), self.digests.get(file)?.clone())))
    }

    /// All frames, sound or not.
    pub fn files(&self) -> &BTreeSet<PathBuf> {
        &self.files
    }
}

/// The digest of a frame that is whole and undamaged.
fn sound(output: &Path, file: &Path, manifest: &Manifest) -> Option<String> {
    if let Some(digest) = manifest.digest_of(file) {
        return Some(digest.to_owned());
    }
    let path = output.join(file);
    let digest = frame_file::whole_header(&path)?.digest;
    // Written down, and its bytes are others: damaged.
    (!manifest.knows(file, &digest) && frame_file::unpacks(&path)).then_some(digest)
}

fn frame_files(output: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut folders = vec![PathBuf::from("frames")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(output.join(&folder)).into_iter().flatten().flatten() {
            if entry.file_name().to_string_lossy().starts_with('.') {
                continue;
            }
            let path = folder.join(entry.file_name());
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "exr") {
                found.insert(path);
            }
        }
    }
    found
}
