//! A file that several processes add lines to, and what was written in it.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::TurntableError;
use crate::stamp::Stamp;

/// Says what the lines mean; those of other versions are passed over.
const SCHEMA: &str = "turntable-manifest/2";

/// Lines that are no longer needed are left standing until there are so many.
const CLUTTER: usize = 1000;

/// One line: an output that was made, or an input that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// The output, inside the folder; or the input, as it was named.
    pub file: String,
    /// What the output was made from; nothing for an input.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub digest: String,
    /// The bytes.
    pub content: String,
    /// Those of the file and of what it leans on; none when it had not rested yet.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stamps: Vec<Stamp>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    #[serde(flatten)]
    entry: Entry,
    /// Over everything before it.
    check: String,
}

impl Entry {
    /// The line, with a check: two processes on a network folder may write over each other's lines.
    fn line(&self) -> String {
        let line = Line { entry: self.clone(), check: self.check() };
        // Strings and numbers always serialise.
        serde_json::to_string(&line).unwrap_or_default() + "\n"
    }

    fn check(&self) -> String {
        let words = serde_json::to_string(self).unwrap_or_default();
        let mut hasher = blake3::Hasher::new();
        hasher.update(SCHEMA.as_bytes()).update(words.as_bytes());
        hasher.finalize().to_hex()[..8].to_owned()
    }

    fn parse(line: &str) -> Option<Entry> {
        let Line { entry, check } = serde_json::from_str(line).ok()?;
        (check == entry.check()).then_some(entry)
    }
}

/// The file, as it was when it was opened.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    /// Where the last line was cut short, the next must not be glued to it.
    is_cut: bool,
    lines: usize,
}

impl Journal {
    /// Reads all sound lines, oldest first. No file, and lines that were cut, mangled or are not ours, are no error:
    /// what they would tell is found out again.
    pub fn open(path: PathBuf) -> (Journal, Vec<Entry>) {
        let bytes = std::fs::read(&path).unwrap_or_default();
        let is_cut = bytes.last().is_some_and(|&last| last != b'\n');
        let lines = bytes.split(|&byte| byte == b'\n').filter_map(|line| std::str::from_utf8(line).ok());
        let entries: Vec<Entry> = lines.filter_map(Entry::parse).collect();
        let lines = bytes.iter().filter(|&&byte| byte == b'\n').count();
        (Journal { path, is_cut, lines }, entries)
    }

    /// Adds lines in one write.
    pub fn add(&mut self, entries: &[Entry]) -> Result<(), TurntableError> {
        if entries.is_empty() {
            return Ok(());
        }
        let mut text = String::from(if self.is_cut { "\n" } else { "" });
        text.extend(entries.iter().map(Entry::line));
        let fault = |error| TurntableError::io(&self.path, "write", error);
        let mut file = OpenOptions::new().create(true).append(true).open(&self.path).map_err(fault)?;
        file.write_all(text.as_bytes()).map_err(fault)?;
        self.is_cut = false;
        self.lines += entries.len();
        Ok(())
    }

    /// Whether most lines say what later ones say better.
    pub fn is_cluttered(&self, needed: usize) -> bool {
        self.lines > 2 * needed + CLUTTER
    }

    /// Writes the file anew with these lines only. A line that another process adds meanwhile is lost; what it told is
    /// found out again.
    pub fn rewrite<'a>(&mut self, entries: impl Iterator<Item = &'a Entry>) -> Result<(), TurntableError> {
        let lines: Vec<String> = entries.map(Entry::line).collect();
        whole_file::clear_stale(&self.path);
        whole_file::write_whole(&self.path, lines.concat().as_bytes())?;
        (self.is_cut, self.lines) = (false, lines.len());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(file: &str) -> Entry {
        let stamp = Stamp { size: 1, modified: 2, changed: 3 };
        Entry { file: file.into(), digest: "d".into(), content: "c".into(), stamps: vec![stamp] }
    }

    #[test]
    fn lines_come_back_and_damaged_ones_do_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("j");
        let read = || Journal::open(path.clone()).1;
        assert!(read().is_empty());
        let all = [entry("a"), entry("b\n\"ä"), Entry { stamps: vec![], ..entry("c") }];
        Journal::open(path.clone()).0.add(&all[..2]).unwrap();
        Journal::open(path.clone()).0.add(&all[2..]).unwrap();
        assert_eq!(read(), all);
        let whole = std::fs::read(&path).unwrap();
        for cut in 0..whole.len() {
            std::fs::write(&path, &whole[..cut]).unwrap();
            let found = read();
            assert_eq!(found, all[..found.len()], "cut at {cut}");
            // What is added behind a cut line is not lost with it.
            Journal::open(path.clone()).0.add(&[entry("z")]).unwrap();
            assert_eq!(read().last(), Some(&entry("z")), "cut at {cut}");
        }
        for at in 0..whole.len() {
            let mut flipped = whole.clone();
            flipped[at] ^= 0x02;
            std::fs::write(&path, &flipped).unwrap();
            assert!(read().iter().all(|found| all.contains(found)), "flipped at {at}: {:?}", read());
        }
    }

    #[test]
    fn clutter_goes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("j");
        let (mut journal, _) = Journal::open(path.clone());
        journal.add(&vec![entry("a"); CLUTTER + 3]).unwrap();
        assert!(journal.is_cluttered(1));
        journal.rewrite([entry("a")].iter()).unwrap();
        assert!(!journal.is_cluttered(1));
        assert_eq!(Journal::open(path).1, [entry("a")]);
    }
}
