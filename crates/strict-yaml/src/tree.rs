//! Values that know where they were written.

use std::sync::Arc;

use indexmap::IndexMap;

/// A value and where it was written.
#[derive(Clone, Debug)]
pub struct Node {
    pub(crate) value: Value,
    pub(crate) origin: Origin,
}

/// What YAML can say. Keys stay in the order they were written.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// Nothing, `null` or `~`.
    Null,
    Bool(bool),
    /// A whole number below 0.
    Negative(i64),
    /// A whole number of at least 0.
    Whole(u64),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Map(Map),
}

/// Keys and values.
pub(crate) type Map = IndexMap<String, Node>;

/// Where a value was written: a text and the way down to it. Line and column are looked up only when a
/// fault is told, so that a value without faults costs next to nothing.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    /// Index in the document's sources.
    pub(crate) source: usize,
    pub(crate) trail: Option<Arc<Trail>>,
    /// Where a variable was used that brought the value there: its name and the place of the use.
    pub(crate) used: Option<Arc<(String, Origin)>>,
    /// A number's or a yes-or-no's letters, as they were written.
    pub(crate) letters: Option<Arc<str>>,
}

/// The last step of a way down and the way before it.
#[derive(Debug)]
pub(crate) struct Trail {
    pub(crate) before: Option<Arc<Trail>>,
    /// A key, or an index in digits.
    pub(crate) step: String,
}

impl Origin {
    pub(crate) fn of(source: usize) -> Origin {
        Origin { source, trail: None, used: None, letters: None }
    }

    pub(crate) fn below(&self, step: String) -> Origin {
        let trail = Some(Arc::new(Trail { before: self.trail.clone(), step }));
        Origin { source: self.source, trail, used: None, letters: None }
    }

    /// The steps from the top of the text.
    pub(crate) fn path(&self) -> Vec<&str> {
        let mut path = Vec::new();
        let mut here = self.trail.as_deref();
        while let Some(Trail { before, step }) = here {
            path.push(step.as_str());
            here = before.as_deref();
        }
        path.reverse();
        path
    }
}

impl Node {
    /// The keys of a mapping in their order; none for anything else.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.map().into_iter().flat_map(|map| map.keys().map(String::as_str))
    }

    /// What is below a key of a mapping or an index (in digits) of a list.
    #[must_use]
    pub fn child(&self, step: &str) -> Option<&Node> {
        match &self.value {
            Value::Map(map) => map.get(step),
            Value::List(list) => list.get(step.parse::<usize>().ok()?),
            _ => None,
        }
    }

    /// What is at the end of a way as `render.spp`; of an empty one the node itself.
    #[must_use]
    pub fn at(&self, path: &str) -> Option<&Node> {
        path.split('.').filter(|step| !step.is_empty()).try_fold(self, |node, step| node.child(step))
    }

    pub(crate) fn child_mut(&mut self, step: &str) -> Option<&mut Node> {
        match &mut self.value {
            Value::Map(map) => map.get_mut(step),
            Value::List(list) => list.get_mut(step.parse::<usize>().ok()?),
            _ => None,
        }
    }

    /// The entries of a list; `None` for anything else.
    #[must_use]
    pub fn entries(&self) -> Option<&[Node]> {
        match &self.value {
            Value::List(list) => Some(list),
            _ => None,
        }
    }

    /// The text, where it is text.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Whether there are keys below it.
    #[must_use]
    pub fn is_map(&self) -> bool {
        matches!(self.value, Value::Map(_))
    }

    /// Whether nothing was written, `null` or `~`.
    #[must_use]
    pub fn is_null(&self) -> bool {
        matches!(self.value, Value::Null)
    }

    /// A single value letter by letter as it was written: `0.10` stays that. `None` for lists and mappings.
    #[must_use]
    pub fn written(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            Value::List(_) | Value::Map(_) => None,
            Value::Null => Some(""),
            _ => self.origin.letters.as_deref(),
        }
    }

    /// Whether it is a single value other than text, which has letters of its own.
    pub(crate) fn is_number_or_bool(&self) -> bool {
        matches!(self.value, Value::Bool(_) | Value::Negative(_) | Value::Whole(_) | Value::Number(_))
    }

    pub(crate) fn map(&self) -> Option<&Map> {
        match &self.value {
            Value::Map(map) => Some(map),
            _ => None,
        }
    }

    /// What it is, in the words of a message.
    #[must_use]
    pub fn words(&self) -> String {
        match &self.value {
            Value::Null => "empty".to_owned(),
            Value::Bool(value) => format!("a yes-or-no `{value}`"),
            Value::Negative(value) => format!("a whole number `{value}`"),
            Value::Whole(value) => format!("a whole number `{value}`"),
            Value::Number(value) => format!("a number `{value}`"),
            Value::Text(text) => {
                let short: String = text.chars().take(40).collect();
                format!("text {:?}", if short.len() < text.len() { short + "..." } else { short })
            }
            Value::List(_) => "a list".to_owned(),
            Value::Map(_) => "keys and values".to_owned(),
        }
    }

    /// Goes down the way, making mappings of what is empty or not there, and puts `value` at its end.
    pub(crate) fn put(&mut self, path: &[&str], value: Node) -> Result<(), String> {
        let Some((first, rest)) = path.split_first() else {
            *self = value;
            return Ok(());
        };
        if self.is_null() {
            self.value = Value::Map(Map::new());
        }
        let origin = value.origin.clone();
        match &mut self.value {
            Value::Map(map) => {
                let child = map.entry((*first).to_owned());
                child.or_insert_with(|| Node { value: Value::Null, origin }).put(rest, value)
            }
            Value::List(list) => {
                let count = list.len();
                let child = first.parse::<usize>().ok().and_then(|index| list.get_mut(index));
                child.ok_or_else(|| none_of(first, count))?.put(rest, value)
            }
            _ => Err(format!("there are no keys below the one before `{first}`")),
        }
    }
}

fn none_of(index: &str, count: usize) -> String {
    format!("`{index}` is none of the {count} entries (0, 1, ...)")
}

/// `over` laid over `base`: keys of mappings one by one, anything else in place of what was there.
pub(crate) fn merge(base: &mut Node, over: Node) {
    match (&mut base.value, over.value) {
        (Value::Map(base), Value::Map(over)) => {
            for (key, node) in over {
                match base.get_mut(&key) {
                    Some(there) => merge(there, node),
                    None => {
                        base.insert(key, node);
                    }
                }
            }
        }
        (_, value) => *base = Node { value, origin: over.origin },
    }
}
