//! Digests: what a step's output depends on, in 32 letters.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::TurntableError;
use crate::stamp::Stamp;

/// A digest of everything one output depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Digest(String);

impl Digest {
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Back from [`Digest::as_str`].
    pub fn from_text(text: &str) -> Option<Digest> {
        (text.len() == 32 && text.bytes().all(|b| b.is_ascii_hexdigit())).then(|| Digest(text.to_owned()))
    }

    /// A number that follows from the digest.
    pub fn number(&self) -> u64 {
        u64::from_str_radix(&self.0[..16], 16).unwrap_or_default()
    }
}

/// Gathers what an output depends on.
pub(crate) struct Ingredients(blake3::Hasher);

impl Ingredients {
    /// Begins a digest for a kind of step; the program's version is part of every one, and so are the
    /// sources it was built from: pictures of yesterday's renderer must not pass for today's. Builds
    /// of the same sources agree, on whatever machine, so that a farm may mix them.
    pub fn of(step: &str) -> Self {
        let hasher = Ingredients(blake3::Hasher::new());
        hasher.word(env!("CARGO_PKG_VERSION")).word(env!("TURNTABLE_SOURCES")).word(step)
    }

    /// Adds a word; its length keeps neighbours apart.
    pub fn word(mut self, word: &str) -> Self {
        self.0.update(&(word.len() as u64).to_le_bytes());
        self.0.update(word.as_bytes());
        self
    }

    /// Adds settings. Defaults are spelled out, so that stating one changes nothing.
    pub fn settings(self, settings: &impl Serialize) -> Self {
        // Plain structs of numbers and strings always serialise; a failure would only re-make too much.
        let words = serde_json::to_string(settings).unwrap_or_else(|error| error.to_string());
        self.word(&words)
    }

    /// Adds another output's digest.
    pub fn digest(self, digest: &Digest) -> Self {
        self.word(digest.as_str())
    }

    /// Adds the bytes of a file; its name and time do not count.
    pub fn file(self, path: &Path) -> Result<Self, TurntableError> {
        Ok(self.digest(&input(path)?))
    }

    /// Adds the bytes of some files, in their order.
    pub fn files(self, paths: &[PathBuf]) -> Result<Self, TurntableError> {
        paths.iter().try_fold(self, |digest, path| digest.file(path))
    }

    pub fn finish(self) -> Digest {
        Digest(self.0.finalize().to_hex()[..32].to_owned())
    }
}

thread_local! {
    static MEMORY: RefCell<Option<HashMap<PathBuf, (Stamp, Digest)>>> = const { RefCell::new(None) };
}

/// While it lives, inputs whose size and times are known are not read: those that it was given, and those that were
/// read since. All variants of a pipeline lean on the same files.
pub(crate) struct Memory(());

impl Memory {
    pub fn of(known: impl Iterator<Item = (PathBuf, Stamp, Digest)>) -> Memory {
        let known = known.map(|(path, stamp, digest)| (path, (stamp, digest))).collect();
        MEMORY.set(Some(known));
        Memory(())
    }

    /// Everything that is known by now.
    pub fn inputs(&self) -> Vec<(PathBuf, Stamp, Digest)> {
        let known = MEMORY.with_borrow(|memory| memory.clone().unwrap_or_default());
        known.into_iter().map(|(path, (stamp, digest))| (path, stamp, digest)).collect()
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        MEMORY.set(None);
    }
}

/// The digest of an input's bytes, read or remembered.
fn input(path: &Path) -> Result<Digest, TurntableError> {
    let Some(stamp) = Stamp::of(path) else { return content(path) };
    let full = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let known = MEMORY.with_borrow(|memory| memory.as_ref()?.get(&full).cloned());
    if let Some((_, digest)) = known.filter(|(seen, _)| *seen == stamp) {
        return Ok(digest);
    }
    let digest = content(path)?;
    MEMORY.with_borrow_mut(|memory| memory.as_mut()?.insert(full, (stamp, digest.clone())));
    Ok(digest)
}

/// The digest of a file's bytes.
pub(crate) fn content(path: &Path) -> Result<Digest, TurntableError> {
    let fault = |e| TurntableError::io(path, "read", e);
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(File::open(path).map_err(fault)?).map_err(fault)?;
    Ok(Digest(hasher.finalize().to_hex()[..32].to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sources_were_found() {
        let sources = env!("TURNTABLE_SOURCES");
        assert_eq!(sources.len(), 16);
        assert_ne!(sources, "cbf29ce484222325", "the hash of nothing");
    }

    #[test]
    fn every_ingredient_counts_and_neighbours_stay_apart() {
        let of = |words: &[&str]| words.iter().fold(Ingredients::of("x"), |i, w| i.word(w)).finish();
        let all = [of(&[]), of(&["a"]), of(&["ab"]), of(&["a", "b"]), of(&["b", "a"]), of(&["", "ab"])];
        for (i, a) in all.iter().enumerate() {
            assert_eq!(a.as_str().len(), 32);
            assert!(all.iter().skip(i + 1).all(|b| a != b));
        }
        assert_eq!(of(&["a", "b"]), of(&["a", "b"]));
    }
}
