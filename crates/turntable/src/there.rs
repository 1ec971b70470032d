//! Which frames are in an output folder, and which of them are sound.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use hair_render::{Frame, FrameHeader};

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
    /// Of a frame whose size and times are those that were written down the header is read. Others are read whole and
    /// compared with what was written down; those that nobody wrote down are unpacked, which takes longest.
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

/// The digest of a frame that is whole and undamaged: the one in its header, with which what is written down must agree.
fn sound(output: &Path, file: &Path, manifest: &Manifest) -> Option<String> {
    let path = output.join(file);
    let digest = FrameHeader::read(&path).ok()?.digest;
    let is_sound = match manifest.digest_of(file) {
        Some(written_down) => written_down == digest,
        // Written down, and its bytes are others: damaged.
        None => !manifest.knows(file, &digest) && Frame::read_exr(&path).is_ok(),
    };
    is_sound.then_some(digest)
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

#[cfg(test)]
mod tests {
    use hair_render::Metadata;

    use super::*;
    use crate::digest::Ingredients;

    const FILE: &str = "frames/frame.0001.exr";

    /// A folder with one frame, of the digest in its header.
    fn folder(digest: &str) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("frames")).unwrap();
        let metadata = Metadata { digest: digest.to_owned(), ..Metadata::default() };
        let mut frame = Frame::empty(40, 30);
        frame.alpha.iter_mut().enumerate().for_each(|(i, alpha)| *alpha = (i * 7919 % 31) as f32);
        frame.write_exr(&folder.path().join(FILE), &metadata).unwrap();
        folder
    }

    fn found(folder: &Path) -> Option<String> {
        let manifest = Manifest::open(folder, false);
        There::look(folder, &manifest).digest(Path::new(FILE)).map(str::to_owned)
    }

    #[test]
    fn frames_nobody_wrote_down_are_read_and_cut_ones_refused() {
        let folder = folder("abc");
        assert_eq!(found(folder.path()).as_deref(), Some("abc"));
        let path = folder.path().join(FILE);
        let bytes = std::fs::read(&path).unwrap();
        let mut flipped = bytes.clone();
        flipped[bytes.len() * 3 / 4] ^= 0x10;
        std::fs::write(&path, &flipped).unwrap();
        assert_eq!(found(folder.path()), None, "a flipped bit in the compressed pixels");
        for cut in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
            std::fs::write(&path, &bytes[..cut]).unwrap();
            assert_eq!(found(folder.path()), None, "cut at {cut} of {}", bytes.len());
        }
    }

    /// Two runs with other settings in one folder: the one that was overtaken writes down the other's bytes as its own.
    #[test]
    fn what_is_written_down_must_agree_with_the_header() {
        let [one, other] = ["1", "2"].map(|word| Ingredients::of(word).finish());
        let folder = folder(other.as_str());
        let write_down = |digest| {
            let mut manifest = Manifest::open(folder.path(), false);
            manifest.record(Path::new(FILE), digest).unwrap();
            manifest.close().unwrap();
        };
        write_down(&one);
        assert_eq!(found(folder.path()), None, "the header says something else");
        std::fs::remove_file(folder.path().join(crate::manifest::FILE)).unwrap();
        write_down(&other);
        assert_eq!(found(folder.path()).as_deref(), Some(other.as_str()));
    }
}
