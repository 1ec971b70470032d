//! What was made from what, and whether it is still what was made.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::TurntableError;
use crate::digest::{self, Digest};
use crate::journal::{Entry, Journal};
use crate::stamp::Stamp;

/// The file in the output folder. When it is lost or broken, its outputs are made again; frames are read again.
pub(crate) const FILE: &str = "manifest.jsonl";

/// Two processes may make the same output at once, and each writes down the bytes it saw: so many are remembered.
const KEPT: usize = 4;

/// Clocks of Linux's file systems tick every 10 ms at worst: a file changed again within the same tick would keep its
/// stamp. What another run makes of other settings at once, on a disk with a coarser clock, its own lines give away.
const TICK: Duration = Duration::from_millis(20);

/// Before a name in the journal: an input, not an output.
const INPUT: &str = "input:";

/// What is written down about an output folder.
#[derive(Debug)]
pub(crate) struct Manifest {
    folder: PathBuf,
    journal: Journal,
    /// By output, newest last.
    known: HashMap<String, Vec<Entry>>,
    /// Written down without a stamp, for the file was too new for one.
    unsettled: Vec<(Entry, Instant)>,
    /// Whether stamps count.
    trusting: bool,
}

impl Manifest {
    /// The manifest of an output folder; empty when there is none that can be read. With `verify` every file is read,
    /// whatever its size and times.
    pub fn open(folder: &Path, verify: bool) -> Manifest {
        let (journal, entries) = Journal::open(folder.join(FILE));
        let mut manifest = Manifest {
            folder: folder.to_owned(),
            journal,
            known: HashMap::new(),
            unsettled: Vec::new(),
            trusting: !verify,
        };
        entries.into_iter().for_each(|entry| manifest.remember(entry));
        manifest
    }

    fn remember(&mut self, entry: Entry) {
        let known = self.known.entry(entry.file.clone()).or_default();
        // The same said again, now with a stamp.
        known.retain(|old| (&old.digest, &old.content) != (&entry.digest, &entry.content));
        known.push(entry);
        if known.len() > KEPT {
            known.remove(0);
        }
    }

    /// What `output` (inside the folder) was made from, if its bytes are those that were written; none when they are
    /// not, or when nothing is written down.
    pub fn digest_of(&self, output: &Path) -> Option<&str> {
        let known = self.known.get(&key(output))?;
        if self.trusting
            && let Some(stamps) = stamps(&self.folder.join(output))
        {
            let mut same = known.iter().filter(|entry| entry.stamps == stamps);
            if let Some(entry) = same.next_back() {
                // Two runs that made it from different things and saw the same file: one of them errs.
                return same.all(|other| other.digest == entry.digest).then_some(&entry.digest);
            }
        }
        let found = content(&self.folder.join(output)).ok()?;
        known.iter().rev().find(|entry| entry.content == found).map(|entry| entry.digest.as_str())
    }

    /// Whether it is written down that `output` was made from `digest`, whatever became of its bytes.
    pub fn knows(&self, output: &Path, digest: &str) -> bool {
        self.known.get(&key(output)).is_some_and(|known| known.iter().any(|entry| entry.digest == digest))
    }

    /// Whether `output` can only be told by reading it.
    pub fn has_to_read(&self, output: &Path) -> bool {
        let found = stamps(&self.folder.join(output));
        let known = self.known.get(&key(output)).map(Vec::as_slice).unwrap_or_default();
        !known.iter().any(|entry| !entry.stamps.is_empty() && Some(&entry.stamps) == found.as_ref())
    }

    /// Writes down that `output` was just made from `digest`.
    pub fn record(&mut self, output: &Path, digest: &Digest) -> Result<(), TurntableError> {
        self.write_down(output, digest.as_str())
    }

    /// Writes down what was found out by reading: that `output`, which nobody wrote down or which has other times than
    /// those written down, is sound and was made from `digest`.
    pub fn adopt(&mut self, output: &Path, digest: &str) -> Result<(), TurntableError> {
        self.write_down(output, digest)
    }

    fn write_down(&mut self, output: &Path, digest: &str) -> Result<(), TurntableError> {
        let path = self.folder.join(output);
        let entry = Entry {
            file: key(output),
            digest: digest.to_owned(),
            content: content(&path)?,
            stamps: Vec::new(),
        };
        let stamped = Entry { stamps: stamps(&path).unwrap_or_default(), ..entry.clone() };
        let mut lines = self.settled();
        if !stamped.stamps.is_empty() && stamped.stamps.iter().all(Stamp::is_settled) {
            lines.push(stamped);
        } else {
            lines.push(entry);
            self.unsettled.push((stamped, Instant::now()));
        }
        self.add(lines)
    }

    /// What by now can be written down with its stamp.
    fn settled(&mut self) -> Vec<Entry> {
        let (old, new) =
            std::mem::take(&mut self.unsettled).into_iter().partition(|(_, seen)| seen.elapsed() >= TICK);
        self.unsettled = new;
        let old: Vec<(Entry, Instant)> = old;
        // Only if nobody touched it since.
        let same = |entry: &Entry| {
            !entry.stamps.is_empty() && stamps(&self.folder.join(&entry.file)).as_ref() == Some(&entry.stamps)
        };
        old.into_iter().map(|(entry, _)| entry).filter(same).collect()
    }

    fn add(&mut self, lines: Vec<Entry>) -> Result<(), TurntableError> {
        self.journal.add(&lines)?;
        lines.into_iter().for_each(|entry| self.remember(entry));
        Ok(())
    }

    /// Writes down what is left to write down.
    pub fn close(&mut self) -> Result<(), TurntableError> {
        if let Some((_, last)) = self.unsettled.last() {
            std::thread::sleep(TICK.saturating_sub(last.elapsed()));
        }
        let lines = self.settled();
        self.add(lines)
    }

    /// Writes the file anew when it has grown far beyond what it says.
    pub fn tidy(&mut self) -> Result<(), TurntableError> {
        let needed = self.known.values().map(Vec::len).sum();
        if !self.journal.is_cluttered(needed) {
            return Ok(());
        }
        let mut names: Vec<&String> = self.known.keys().collect();
        names.sort_unstable();
        self.journal.rewrite(names.into_iter().flat_map(|name| &self.known[name]))
    }

    /// What is written down about inputs, for [`digest::Memory`].
    pub fn inputs(&self) -> impl Iterator<Item = (PathBuf, Stamp, Digest)> + '_ {
        let of = |entry: &Entry| {
            let path = PathBuf::from(entry.file.strip_prefix(INPUT)?);
            Some((path, *entry.stamps.first()?, Digest::from_text(&entry.content)?))
        };
        self.known.values().filter_map(move |entries| of(entries.last()?)).filter(|_| self.trusting)
    }

    /// Writes down what inputs hold, but for those changed so lately that their times say little.
    pub fn record_inputs(&mut self, inputs: &[(PathBuf, Stamp, Digest)]) -> Result<(), TurntableError> {
        let entry = |(path, stamp, content): &(PathBuf, Stamp, Digest)| Entry {
            file: format!("{INPUT}{}", path.display()),
            digest: String::new(),
            content: content.as_str().to_owned(),
            stamps: vec![*stamp],
        };
        let settled = inputs.iter().filter(|(path, stamp, _)| stamp.is_settled() && path.to_str().is_some());
        let new = settled
            .map(entry)
            .filter(|entry| self.known.get(&entry.file).and_then(|k| k.last()) != Some(entry));
        let new = new.collect();
        self.add(new)
    }
}

fn key(output: &Path) -> String {
    output.to_string_lossy().replace('\\', "/")
}

/// The files an output consists of.
fn parts(path: &Path) -> Vec<PathBuf> {
    let mut parts = vec![path.to_owned()];
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gltf")) {
        parts.push(path.with_extension("bin"));
    }
    parts
}

fn stamps(path: &Path) -> Option<Vec<Stamp>> {
    parts(path).iter().map(|part| Stamp::of(part)).collect()
}

/// The bytes of an output, with those of the file it leans on.
fn content(path: &Path) -> Result<String, TurntableError> {
    let parts: Vec<Digest> =
        parts(path).iter().map(|part| digest::content(part)).collect::<Result<_, _>>()?;
    Ok(parts.iter().map(Digest::as_str).collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests;
