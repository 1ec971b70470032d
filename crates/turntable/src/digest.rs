//! Digests: what a step's output depends on, in 32 letters.

use std::fs::File;
use std::path::Path;

use serde::Serialize;

use crate::TurntableError;

/// A digest of everything one output depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Digest(String);

impl Digest {
    pub fn as_str(&self) -> &str {
        &self.0
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
        Ok(self.digest(&content(path)?))
    }

    pub fn finish(self) -> Digest {
        Digest(self.0.finalize().to_hex()[..32].to_owned())
    }
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
