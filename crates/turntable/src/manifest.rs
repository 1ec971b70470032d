//! What was made from what, for outputs that cannot carry a digest themselves.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::TurntableError;
use crate::digest::{self, Digest};

const SCHEMA: &str = "turntable-manifest/1";

/// A JSON file in the output folder. When it is lost or broken, its outputs are made again.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Manifest {
    schema: String,
    made: BTreeMap<String, Entry>,
    #[serde(skip)]
    folder: PathBuf,
}

#[derive(Debug, Serialize, Deserialize)]
struct Entry {
    /// What the output depends on.
    digest: String,
    /// The bytes of the output.
    content: String,
}

impl Manifest {
    fn path(folder: &Path) -> PathBuf {
        folder.join("manifest.json")
    }

    /// The manifest of an output folder; empty when there is none that can be read.
    pub fn open(folder: &Path) -> Manifest {
        let text = std::fs::read_to_string(Manifest::path(folder)).unwrap_or_default();
        let read = serde_json::from_str::<Manifest>(&text).ok().filter(|m| m.schema == SCHEMA);
        let empty = || Manifest { schema: SCHEMA.into(), made: BTreeMap::new(), folder: PathBuf::new() };
        Manifest { folder: folder.to_owned(), ..read.unwrap_or_else(empty) }
    }

    /// Whether `output` (inside the folder) was made from `digest` and still has the same bytes;
    /// `None` when it was never made.
    pub fn holds(&self, output: &Path, digest: &Digest) -> Option<bool> {
        let entry = self.made.get(&key(output))?;
        Some(entry.digest == digest.as_str() && self.is_as_written(output, entry))
    }

    fn is_as_written(&self, output: &Path, entry: &Entry) -> bool {
        content(&self.folder.join(output)).is_ok_and(|found| found == entry.content)
    }

    /// Whether `output` still has the bytes that were written for `digest`; `None` when nobody wrote
    /// down which those were.
    pub fn vouches(&self, output: &Path, digest: &str) -> Option<bool> {
        let entry = self.made.get(&key(output)).filter(|entry| entry.digest == digest)?;
        Some(self.is_as_written(output, entry))
    }

    /// Writes down that `output` was just made from `digest`.
    pub fn record(&mut self, output: &Path, digest: &Digest) -> Result<(), TurntableError> {
        let content = content(&self.folder.join(output))?;
        // Others may work in the same folder: what they wrote down since stays.
        *self = Manifest::open(&self.folder);
        self.made.insert(key(output), Entry { digest: digest.as_str().to_owned(), content });
        let path = Manifest::path(&self.folder);
        let text = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        whole_file::clear_stale(&path);
        Ok(whole_file::write_whole(path, text.as_bytes())?)
    }
}

fn key(output: &Path) -> String {
    output.to_string_lossy().replace('\\', "/")
}

/// The bytes of an output, with those of the file it leans on.
fn content(path: &Path) -> Result<String, TurntableError> {
    let own = digest::content(path)?;
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gltf")) {
        let buffer = digest::content(&path.with_extension("bin"))?;
        return Ok(format!("{} {}", own.as_str(), buffer.as_str()));
    }
    Ok(own.as_str().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::digest::Ingredients;

    #[test]
    fn two_runs_keep_each_others_entries() {
        let folder = tempfile::tempdir().unwrap();
        let digest = Ingredients::of("1").finish();
        let mut runs = [Manifest::open(folder.path()), Manifest::open(folder.path())];
        for (run, name) in runs.iter_mut().zip(["a.txt", "b.txt"]) {
            std::fs::write(folder.path().join(name), name).unwrap();
            run.record(Path::new(name), &digest).unwrap();
        }
        let both = Manifest::open(folder.path());
        assert!(["a.txt", "b.txt"].iter().all(|name| both.holds(Path::new(name), &digest) == Some(true)));
    }

    #[test]
    fn entries_answer_for_digest_and_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let (name, one, two) =
            (Path::new("a.txt"), Ingredients::of("1").finish(), Ingredients::of("2").finish());
        let write = |text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        assert_eq!(Manifest::open(folder.path()).holds(name, &one), None);
        write("x");
        Manifest::open(folder.path()).record(name, &one).unwrap();
        let again = || Manifest::open(folder.path());
        assert_eq!(again().holds(name, &one), Some(true));
        assert_eq!(again().holds(name, &two), Some(false));
        assert_eq!(again().vouches(name, one.as_str()), Some(true));
        assert_eq!(again().vouches(name, two.as_str()), None);
        write("xy");
        assert_eq!(again().vouches(name, one.as_str()), Some(false));
        assert_eq!(again().holds(name, &one), Some(false));
        std::fs::remove_file(folder.path().join(name)).unwrap();
        assert_eq!(again().holds(name, &one), Some(false));
        for broken in ["", "{", "{\"schema\": \"turntable-manifest/2\", \"made\": {}}"] {
            std::fs::write(folder.path().join("manifest.json"), broken).unwrap();
            assert_eq!(again().holds(name, &one), None);
        }
    }
}
