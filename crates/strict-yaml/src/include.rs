//! A text with those it includes below it.

use std::path::{Component, Path, PathBuf};

use crate::build::{MOST_VALUES, tree};
use crate::fault::Fault;
use crate::source::{Part, Source, Sources};
use crate::tree::{Map, Node, Origin, Value, merge};
use crate::variables::count;

/// The key by which a file names those it lies over.
const INCLUDE: &str = "include";
/// Files that include each other deeper than this are taken for a slip.
const DEEPEST: usize = 16;
/// More texts than this are taken for a slip; a file counts as often as it is included.
const MOST_FILES: usize = 128;
/// A longer text is none that somebody wrote.
pub(crate) const LONGEST: u64 = 1 << 20;

/// Gives the bytes of a file.
pub(crate) type Loader<'l> = dyn Fn(&Path) -> std::io::Result<Vec<u8>> + 'l;

/// Reads files and those they include.
pub(crate) struct Gatherer<'l> {
    pub(crate) load: &'l Loader<'l>,
    pub(crate) sources: Sources,
    pub(crate) faults: Vec<Fault>,
    /// Every file read, once.
    pub(crate) files: Vec<PathBuf>,
    /// How many values may still come; `None` when there were too many, and no more is read.
    pub(crate) values_left: Option<usize>,
}

impl Gatherer<'_> {
    /// The tree of a text that is there, with what it includes below it; `chain` are the files that led to
    /// it, itself the last.
    pub(crate) fn gather(&mut self, bytes: Vec<u8>, folder: PathBuf, chain: &[PathBuf]) -> Node {
        let file = chain.last().cloned().unwrap_or_default();
        if !self.files.contains(&file) {
            self.files.push(file.clone());
        }
        let mut plain = |place, message| {
            self.faults.push(Fault { file: file.clone(), place, key: String::new(), message });
        };
        let index = self.sources.texts.len();
        let mut text = String::new();
        match utf8(bytes) {
            Ok(good) => text = good,
            Err((place, message)) => plain(Some(place), message),
        }
        let mut node = match tree(&text, index) {
            Ok(node) => node,
            Err(fault) => {
                plain(fault.place.map(|p| (p.line, p.column)), fault.message);
                Node { value: Value::Null, origin: Origin::of(index) }
            }
        };
        if node.is_null() {
            node.value = Value::Map(Map::new());
        }
        if !node.is_map() {
            plain(Some((1, 1)), format!("is {}, expected keys and values", node.words()));
            node.value = Value::Map(Map::new());
        }
        self.values_left = self.values_left.and_then(|left| left.checked_sub(count(&node)));
        if self.values_left.is_none() {
            plain(
                None,
                format!("comes to more than {MOST_VALUES} values with the files that were read before it"),
            );
            node.value = Value::Map(Map::new());
        }
        self.sources.add(Source { file, text, folder: folder.clone(), setting: None });
        let included = match &mut node.value {
            Value::Map(map) => map.shift_remove(INCLUDE),
            _ => None,
        };
        let mut base = Node { value: Value::Map(Map::new()), origin: node.origin.clone() };
        for entry in included.iter().flat_map(entries) {
            if let Some(below) = self.include(entry, &folder, chain) {
                merge(&mut base, below);
            }
        }
        merge(&mut base, node);
        base
    }

    fn fault(&mut self, entry: &Node, message: String) {
        let fault = self.sources.fault(&entry.origin, Part::Value, INCLUDE, message);
        self.faults.push(fault);
    }

    fn include(&mut self, entry: &Node, folder: &Path, chain: &[PathBuf]) -> Option<Node> {
        let Some(name) = entry.text().filter(|name| !name.is_empty()) else {
            self.fault(entry, format!("is {}, expected a path or a list of paths", entry.words()));
            return None;
        };
        if name.contains("${") {
            self.fault(entry, format!("`{name}`: variables are known only when all files are read"));
            return None;
        }
        let name = Path::new(name);
        let above = chain.last().and_then(|file| file.parent()).unwrap_or(Path::new(""));
        let path = normal(&above.join(name));
        let shown = path.display();
        self.values_left?;
        if chain.contains(&path) {
            self.fault(entry, format!("`{shown}` includes itself, by {}", names(chain)));
            return None;
        }
        if chain.len() > DEEPEST {
            self.fault(entry, format!("files include each other more than {DEEPEST} deep"));
            return None;
        }
        if self.sources.texts.len() >= MOST_FILES {
            // Once is enough.
            if self.sources.texts.len() == MOST_FILES {
                self.fault(entry, format!("more than {MOST_FILES} files are included"));
                self.sources.add(Source::empty());
            }
            return None;
        }
        match (self.load)(&path) {
            Ok(bytes) => {
                let folder = folder.join(name.parent().unwrap_or(Path::new("")));
                let mut chain = chain.to_vec();
                chain.push(path);
                Some(self.gather(bytes, folder, &chain))
            }
            Err(error) => {
                self.fault(entry, format!("no file at `{shown}` ({error})"));
                None
            }
        }
    }
}

fn names(chain: &[PathBuf]) -> String {
    chain.iter().map(|file| format!("`{}`", file.display())).collect::<Vec<_>>().join(" -> ")
}

/// One path or a list of them.
fn entries(node: &Node) -> &[Node] {
    match &node.value {
        Value::List(list) => list,
        Value::Null => &[],
        _ => std::slice::from_ref(node),
    }
}

/// The path without `.` and, where a folder is left again, without `folder/..`.
pub(crate) fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(normal.components().next_back(), Some(Component::Normal(_))) => {
                normal.pop();
            }
            part => normal.push(part),
        }
    }
    normal
}

/// The text, or where and how it is none.
pub(crate) fn utf8(bytes: Vec<u8>) -> Result<String, ((usize, usize), String)> {
    if bytes.len() as u64 > LONGEST {
        return Err(((1, 1), format!("more than {LONGEST} bytes, which nobody writes")));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let lines = before.iter().filter(|&&b| b == b'\n').count() + 1;
        let last = before.rsplit(|&b| b == b'\n').next().unwrap_or_default();
        let column = String::from_utf8_lossy(last).chars().count() + 1;
        ((lines, column), format!("byte {} is not UTF-8, as YAML has to be", before.len()))
    })
}
