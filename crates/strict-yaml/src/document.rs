//! A document put together from several texts.

use std::collections::BTreeSet;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::de::DeserializeOwned;

use crate::build::{MOST_VALUES, tree};
use crate::fault::{DocumentError, Fault};
use crate::include::{Gatherer, LONGEST, normal};
use crate::read::says_nothing;
use crate::reading::{self, Reading};
use crate::setting::Setting;
use crate::source::{Part, Source, Sources};
use crate::tree::{Map, Node, Value, merge};
use crate::variables::{Variables, count};

/// A document: a file with those it includes below it and settings over it. Every value knows where it was
/// written.
#[derive(Clone, Debug)]
pub struct Document {
    pub(crate) root: Node,
    pub(crate) sources: Arc<Sources>,
    files: Arc<[PathBuf]>,
}

impl Document {
    /// Reads `file` and those it includes.
    ///
    /// A file's key `include` names one path or a list of them, relative to the file. Mappings of the
    /// including file lie over those of the included ones key by key, a later included file over an
    /// earlier; lists and single values replace what was there, and so does nothing (`key:`).
    ///
    /// # Errors
    /// [`DocumentError`]: the file cannot be read, or what is wrong with it and those it includes.
    pub fn open(file: &Path) -> Result<Document, DocumentError> {
        Document::open_with(file, &read_file)
    }

    /// As [`Document::open`], with `load` giving the bytes of a file.
    ///
    /// # Errors
    /// As [`Document::open`].
    pub fn open_with(
        file: &Path,
        load: &dyn Fn(&Path) -> std::io::Result<Vec<u8>>,
    ) -> Result<Document, DocumentError> {
        let bytes = load(file).map_err(|source| DocumentError::Io { file: file.to_owned(), source })?;
        let (sources, faults, files) = (Sources::default(), Vec::new(), Vec::new());
        let values_left = Some(MOST_VALUES);
        let mut gatherer = Gatherer { load, sources, faults, files, values_left };
        let root = gatherer.gather(bytes, PathBuf::new(), &[normal(file)]);
        let Gatherer { sources, faults, files, .. } = gatherer;
        if !faults.is_empty() {
            return Err(DocumentError::Faults(faults));
        }
        Ok(Document { root, sources: Arc::new(sources), files: files.into() })
    }

    /// The file and those it includes, as they were opened.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// The whole tree.
    #[must_use]
    pub fn root(&self) -> &Node {
        &self.root
    }

    /// How many values it holds: mappings, lists and single ones.
    #[must_use]
    pub fn values(&self) -> usize {
        count(&self.root)
    }

    /// Takes a key with all below it out of the top of the document.
    pub fn take(&mut self, key: &str) -> Option<Node> {
        match &mut self.root.value {
            Value::Map(map) => map.shift_remove(key),
            _ => None,
        }
    }

    /// Lays a setting over the document.
    ///
    /// # Errors
    /// A [`Fault`] that names the setting: no `=`, no YAML, a remark (`#...`), no such entry, or keys below a single
    /// value.
    pub fn lay(&mut self, setting: &Setting) -> Result<(), Fault> {
        let file = self.sources.texts.first().map(|first| first.file.clone()).unwrap_or_default();
        let words = setting.words();
        let key = setting.parts().map_or_else(|_| String::new(), |(steps, _)| steps.join("."));
        let fault = |message: String| {
            let (file, key) = (file.clone(), key.clone());
            Fault { file, place: None, key, message: format!("{message} (from `{words}`)") }
        };
        let (steps, value) = setting.parts().map_err(fault)?;
        if steps.first() == Some(&"include") {
            return Err(fault("files are included by files alone".into()));
        }
        if says_nothing(value) && !value.trim().is_empty() {
            return Err(fault(format!("`{}` is a remark to YAML; put it in quotes", value.trim())));
        }
        let index = self.sources.texts.len();
        let node = tree(value, index).map_err(|found| fault(found.message))?;
        let source = Source {
            file: file.clone(),
            text: value.to_owned(),
            folder: PathBuf::new(),
            setting: Some(words.clone()),
        };
        Arc::make_mut(&mut self.sources).add(source);
        self.root.put(&steps, node).map_err(fault)?;
        if count(&self.root) > MOST_VALUES {
            return Err(fault(format!("comes to more than {MOST_VALUES} values")));
        }
        Ok(())
    }

    /// Lays a mapping that is part of this document over the top of it; one that holds nothing changes nothing.
    pub fn lay_over(&mut self, patch: &Node) {
        if !patch.is_null() {
            merge(&mut self.root, patch.clone());
        }
    }

    /// A mapping of one value at the way that `key`, a text as `render.spp`, says; to be laid over the document.
    #[must_use]
    pub fn patch(&self, key: &Node, value: &Node) -> Node {
        let steps: Vec<&str> = key.text().unwrap_or_default().split('.').collect();
        steps.into_iter().rev().fold(value.clone(), |node, step| Node {
            value: Value::Map(Map::from_iter([(step.to_owned(), node)])),
            origin: key.origin.clone(),
        })
    }

    /// The document with its `variables` put in for their names, and without them; and the names that were
    /// used.
    ///
    /// In any text `${name}` stands for the variable of that name, and `$${` for a plain `${`. A text that is
    /// nothing but `${name}` becomes what the variable is: a number, a list, anything. Variables may use
    /// each other, but not themselves.
    ///
    /// # Errors
    /// Every [`Fault`]: unknown names with the nearest right one, variables made from themselves, `${` that
    /// is not closed, texts that grow beyond bounds.
    pub fn with_variables(&self) -> Result<(Document, BTreeSet<String>), Vec<Fault>> {
        let mut document = self.clone();
        let told = document.take(VARIABLES);
        let mut faults = Vec::new();
        let none = Map::new();
        let told = match &told {
            None => &none,
            Some(node) => match &node.value {
                Value::Map(map) => map,
                Value::Null => &none,
                _ => {
                    let message = format!("is {}, expected names and values", node.words());
                    faults.push(self.sources.fault(&node.origin, Part::Value, VARIABLES, message));
                    &none
                }
            },
        };
        let mut variables = Variables::new(&self.sources, told);
        variables.all();
        let used_by_themselves = std::mem::take(&mut variables.used);
        variables.put_in(&mut document.root, "");
        let mut used = variables.used;
        used.extend(used_by_themselves);
        faults.extend(variables.faults);
        if faults.is_empty() { Ok((document, used)) } else { Err(faults) }
    }

    /// Reads a `T`, as far as that can be done: see [`Reading`].
    #[must_use]
    pub fn read<T: DeserializeOwned>(&self) -> Reading<T> {
        reading::read(&self.sources, &self.root)
    }

    /// A fault of what stands at `key` (as `render.spp`), told where that was written; where it is not
    /// there, where the innermost mapping on the way was.
    #[must_use]
    pub fn fault(&self, key: &str, message: String) -> Fault {
        let mut node = &self.root;
        let mut is_there = true;
        for step in key.split('.') {
            match node.child(step) {
                Some(child) => node = child,
                None => {
                    is_there = false;
                    break;
                }
            }
        }
        let mut fault = self.sources.fault(&node.origin, Part::Value, key, message);
        // What disagrees below a mapping may have come by a setting: the last one is named.
        let below = last_source(node);
        if is_there
            && below > node.origin.source
            && let Some(setting) = self.sources.texts.get(below).and_then(|source| source.setting.as_deref())
        {
            fault.message += &format!(" (from `{setting}`)");
        }
        fault
    }

    /// A fault of a node of this document, which is called `key`.
    #[must_use]
    pub fn fault_at(&self, node: &Node, key: &str, message: String) -> Fault {
        self.sources.fault(&node.origin, Part::Value, key, message)
    }

    /// As [`Document::fault_at`], told where the key before the node stands.
    #[must_use]
    pub fn fault_at_key(&self, node: &Node, key: &str, message: String) -> Fault {
        self.sources.fault(&node.origin, Part::Key, key, message)
    }
}

const VARIABLES: &str = "variables";

fn read_file(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(LONGEST + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The last of the texts that something below `node` comes from.
fn last_source(node: &Node) -> usize {
    let below: &mut dyn Iterator<Item = &Node> = match &node.value {
        Value::List(list) => &mut list.iter(),
        Value::Map(map) => &mut map.values(),
        _ => &mut std::iter::empty(),
    };
    below.map(last_source).max().unwrap_or_default().max(node.origin.source)
}
