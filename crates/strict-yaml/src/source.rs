//! The texts a document was put together from.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::fault::{Fault, Place};
use crate::locate::{locate, locate_key};
use crate::tree::Origin;

/// A text: a file's, or the value of a setting.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// What the file is called; for a setting the file it is laid over.
    pub(crate) file: PathBuf,
    pub(crate) text: String,
    /// The folder of an included file, from that of the first one; empty for the first one.
    pub(crate) folder: PathBuf,
    /// The words of a setting, as `--set render.spp=4`.
    pub(crate) setting: Option<String>,
}

impl Source {
    /// One that says nothing.
    pub(crate) fn empty() -> Source {
        Source { file: PathBuf::new(), text: String::new(), folder: PathBuf::new(), setting: None }
    }
}

/// Every place that is told takes another reading of its text. After as many bytes places are no longer looked up:
/// a text with that much wrong is an attack, and would take long.
const MOST_READ: usize = 1 << 22;

/// All texts of a document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sources {
    pub(crate) texts: Vec<Source>,
    /// Bytes that were read to look places up, by this document and those it was made into.
    read: Arc<AtomicUsize>,
}

/// Whether the place of a fault is that of a value or of the key before it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    Key,
    Value,
}

impl Sources {
    pub(crate) fn add(&mut self, source: Source) -> usize {
        self.texts.push(source);
        self.texts.len() - 1
    }

    /// Line and column, where the value was written in a file.
    fn place(&self, origin: &Origin, part: Part) -> Option<Place> {
        let source = self.texts.get(origin.source)?;
        if source.setting.is_some() || origin.trail.is_none() {
            return None;
        }
        if self.read.fetch_add(source.text.len(), Ordering::Relaxed) > MOST_READ {
            return None;
        }
        let path = origin.path();
        match part {
            Part::Key => locate_key(&source.text, &path).or_else(|| locate(&source.text, &path)),
            Part::Value => locate(&source.text, &path),
        }
    }

    fn file(&self, origin: &Origin) -> &Path {
        self.texts.get(origin.source).map_or(Path::new(""), |source| &source.file)
    }

    /// A fault of what was written at `origin`, which stands at `key` in the document.
    pub(crate) fn fault(&self, origin: &Origin, part: Part, key: &str, message: String) -> Fault {
        // A value that came by a variable is told where the variable is used, and then where it is from.
        let (told, from) = match &origin.used {
            Some(used) => (&used.1, Some((&used.0, origin))),
            None => (origin, None),
        };
        let mut message = message;
        if let Some((name, from)) = from {
            message += &format!(" (by `${{{name}}}`, {})", self.whence(from));
        }
        if let Some(setting) = self.texts.get(told.source).and_then(|source| source.setting.as_deref()) {
            message += &format!(" (from `{setting}`)");
        }
        let place = self.place(told, part).map(|place| (place.line, place.column));
        Fault { file: self.file(told).to_owned(), place, key: key.to_owned(), message }
    }

    /// Where something comes from, in words.
    fn whence(&self, origin: &Origin) -> String {
        if let Some(setting) = self.texts.get(origin.source).and_then(|source| source.setting.as_deref()) {
            return format!("from `{setting}`");
        }
        let file = self.file(origin).display();
        match self.place(origin, Part::Value) {
            Some(Place { line, column }) => format!("{file}:{line}:{column}"),
            None => file.to_string(),
        }
    }
}
