//! `${name}` in texts, and what `variables` says it is.

use std::collections::{BTreeMap, BTreeSet};

use crate::build::MOST_VALUES;
use crate::fault::{Fault, MOST_FAULTS};
use crate::nearest::nearest;
use crate::pieces::{Piece, is_name, pieces};
use crate::source::{Part, Sources};
use crate::tree::{Map, Node, Origin, Value};

/// Texts that come to more letters than this by their variables are an attack.
const MOST_LETTERS: usize = 1 << 20;
/// Variables that use each other deeper than this are taken for a slip.
const DEEPEST: usize = 32;
/// Values below each other: as many as the YAML library itself takes.
const DEEPEST_VALUE: usize = 128;

/// The variables of a document while they are put in.
pub(crate) struct Variables<'v> {
    sources: &'v Sources,
    told: &'v Map,
    /// Those already worked out; `None` where that failed or is under way.
    known: BTreeMap<&'v str, Option<Node>>,
    under_way: Vec<String>,
    pub(crate) used: BTreeSet<String>,
    pub(crate) faults: Vec<Fault>,
    values_left: usize,
    letters_left: usize,
}

impl<'v> Variables<'v> {
    pub(crate) fn new(sources: &'v Sources, told: &'v Map) -> Self {
        let (known, used, faults) = (BTreeMap::new(), BTreeSet::new(), Vec::new());
        let under_way = Vec::new();
        let (values_left, letters_left) = (MOST_VALUES, MOST_LETTERS);
        let mut new = Variables { sources, told, known, under_way, used, faults, values_left, letters_left };
        for (name, node) in told {
            if !is_name(name) {
                let words = format!("`{name}` is no name for a variable: letters, digits, `_` and `-`");
                let fault = sources.fault(&node.origin, Part::Key, "variables", words);
                new.faults.push(fault);
            }
        }
        new
    }

    /// Works out every variable, so that faults in those nobody uses are told too.
    pub(crate) fn all(&mut self) {
        for name in self.told.keys() {
            if is_name(name) && !self.known.contains_key(name.as_str()) {
                self.work_out(name);
            }
        }
    }

    /// Puts values in place of names, in everything below `node`, which stands at `key`.
    pub(crate) fn put_in(&mut self, node: &mut Node, key: &str) {
        if self.faults.len() >= MOST_FAULTS {
            return;
        }
        let below = |step: &str| if key.is_empty() { step.to_owned() } else { format!("{key}.{step}") };
        match &mut node.value {
            Value::List(list) => {
                for (index, node) in list.iter_mut().enumerate() {
                    self.put_in(node, &below(&index.to_string()));
                }
            }
            Value::Map(map) => map.iter_mut().for_each(|(name, node)| self.put_in(node, &below(name))),
            Value::Text(text) if text.contains("${") => match self.text(text, node.origin.clone(), key) {
                Ok(new) => *node = new,
                Err(message) => {
                    self.fault(node, key, message);
                    node.value = Value::Null;
                }
            },
            _ => {}
        }
    }

    /// An empty message tells nothing: the fault is told where the variable is.
    fn fault(&mut self, node: &Node, key: &str, message: String) {
        if !message.is_empty() {
            self.faults.push(self.sources.fault(&node.origin, Part::Value, key, message));
        }
    }

    fn text(&mut self, text: &str, origin: Origin, key: &str) -> Result<Node, String> {
        let pieces = pieces(text)?;
        if let [Piece::Variable(name)] = *pieces {
            let mut node = self.value(name)?;
            if size(&node).depth + key.split('.').count() > DEEPEST_VALUE {
                return Err(format!("comes to more than {DEEPEST_VALUE} values below each other"));
            }
            node.origin.used = Some(std::sync::Arc::new((name.to_owned(), origin)));
            return Ok(node);
        }
        let mut whole = String::new();
        for piece in pieces {
            let part = match piece {
                Piece::Plain(part) => part.to_owned(),
                Piece::Variable(name) => self.letters(name)?,
            };
            self.letters_left = self
                .letters_left
                .checked_sub(part.len())
                .ok_or_else(|| format!("comes to more than {MOST_LETTERS} letters by its variables"))?;
            whole += &part;
        }
        Ok(Node { value: Value::Text(whole), origin })
    }

    /// What stands inside a text.
    fn letters(&mut self, name: &str) -> Result<String, String> {
        let node = self.value(name)?;
        let cannot = || format!("`${{{name}}}` is {} and cannot stand inside a text", node.words());
        node.written().map(str::to_owned).ok_or_else(cannot)
    }

    /// The value of a variable, a copy that is counted.
    fn value(&mut self, name: &str) -> Result<Node, String> {
        self.used.insert(name.to_owned());
        if self.under_way.iter().any(|other| other == name) {
            let way = self.under_way.join("` -> `");
            return Err(format!("the variable `{name}` is made from itself, by `{way}`"));
        }
        let Some((name, _)) = self.told.get_key_value(name) else {
            return Err(match nearest(name, self.told.keys().map(String::as_str)) {
                Some(meant) => format!("unknown variable `{name}`, did you mean `{meant}`?"),
                None if self.told.is_empty() => {
                    format!("unknown variable `{name}`; give it under `variables` or by `-D {name}=...`")
                }
                None => {
                    let known: Vec<&str> = self.told.keys().map(String::as_str).take(20).collect();
                    format!("unknown variable `{name}`, there are `{}`", known.join("`, `"))
                }
            });
        };
        if !self.known.contains_key(name.as_str()) {
            self.work_out(name);
        }
        // What failed there is told there.
        let Some(node) = self.known.get(name.as_str()).and_then(Option::as_ref) else {
            return Err(String::new());
        };
        let too_much = || format!("comes to more than {MOST_VALUES} values by its variables");
        let too_long = || format!("comes to more than {MOST_LETTERS} letters by its variables");
        let Size { values, letters, .. } = size(node);
        self.values_left = self.values_left.checked_sub(values).ok_or_else(too_much)?;
        self.letters_left = self.letters_left.checked_sub(letters).ok_or_else(too_long)?;
        Ok(node.clone())
    }

    fn work_out(&mut self, name: &'v str) {
        let Some(node) = self.told.get(name) else { return };
        let key = format!("variables.{name}");
        if self.under_way.len() >= DEEPEST {
            self.fault(node, &key, format!("variables use each other more than {DEEPEST} deep"));
            self.known.insert(name, None);
            return;
        }
        let faults = self.faults.len();
        self.under_way.push(name.to_owned());
        let mut node = node.clone();
        self.put_in(&mut node, &key);
        self.under_way.pop();
        let good = self.faults.len() == faults;
        self.known.insert(name, good.then_some(node));
    }
}

/// How much a tree holds.
#[derive(Clone, Copy, Default)]
struct Size {
    values: usize,
    letters: usize,
    depth: usize,
}

fn size(node: &Node) -> Size {
    let add = |a: Size, b: Size| Size {
        values: a.values + b.values,
        letters: a.letters + b.letters,
        depth: a.depth.max(b.depth + 1),
    };
    let one = Size { values: 1, letters: 0, depth: 1 };
    match &node.value {
        Value::Text(text) => Size { letters: text.len(), ..one },
        Value::List(list) => list.iter().map(size).fold(one, add),
        Value::Map(map) => map.values().map(size).fold(one, add),
        _ => one,
    }
}

/// How many values a tree holds.
pub(crate) fn count(node: &Node) -> usize {
    size(node).values
}
