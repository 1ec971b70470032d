//! A text as a tree of values that know where they were written.

use std::cell::{Cell, RefCell};

use serde::de::{DeserializeSeed, Deserializer, EnumAccess, MapAccess, SeqAccess, Visitor};

use crate::fault::{Place, YamlFault, place_of};
use crate::letters;
use crate::read::{check_nesting, in_words, says_nothing};
use crate::tree::{Map, Node, Origin, Value};

/// A document of more values than this is taken for an attack; aliases and variables count as often as
/// they are used.
pub(crate) const MOST_VALUES: usize = 50_000;

/// Reads `text`, the source of that index, as a tree. Refuses keys that are there twice, tags, and texts
/// that unfold to too much.
pub(crate) fn tree(text: &str, source: usize) -> Result<Node, YamlFault> {
    let origin = Origin::of(source);
    if says_nothing(text) {
        return Ok(Node { value: Value::Null, origin });
    }
    check_nesting(text)?;
    let (left, own) = (Cell::new(MOST_VALUES), RefCell::new(None));
    let build = Build { origin, left: &left, own: &own };
    let read = build.deserialize(serde_yaml::Deserializer::from_str(text)).map_err(|error| {
        let place = place_of(&error);
        let message = own.take().unwrap_or_else(|| in_words(&error) + bare_name(text, place));
        YamlFault { place, message }
    });
    let mut node = read?;
    letters::note(text, &mut node);
    Ok(node)
}

/// A hint, where a `${name}` stands bare within brackets: its brace opens a mapping there.
fn bare_name(text: &str, place: Option<Place>) -> &'static str {
    let line = place.and_then(|place| text.lines().nth(place.line.saturating_sub(1))).unwrap_or_default();
    let bare = line.find("${").is_some_and(|at| line.get(..at).is_some_and(|b| b.contains(['[', '{'])));
    if bare { "; within brackets a `${name}` is written in quotes" } else { "" }
}

struct Build<'b> {
    origin: Origin,
    /// How many values may still come.
    left: &'b Cell<usize>,
    /// The words of a fault that is ours: the library adds its own to what passes through it.
    own: &'b RefCell<Option<String>>,
}

impl Build<'_> {
    fn refuse<E: serde::de::Error>(&self, words: &str) -> E {
        self.own.replace(Some(format!("{}{words}", self.prefix())));
        E::custom("")
    }

    /// The way to it, as the library tells it before its own messages.
    fn prefix(&self) -> String {
        let path = self.origin.path().join(".");
        if path.is_empty() { path } else { path + ": " }
    }

    fn node<E: serde::de::Error>(self, value: Value) -> Result<Node, E> {
        let Some(left) = self.left.get().checked_sub(1) else {
            return Err(self.refuse(&format!("comes to more than {MOST_VALUES} values")));
        };
        self.left.set(left);
        Ok(Node { value, origin: self.origin })
    }

    fn below(&self, step: String) -> Self {
        Build { origin: self.origin.below(step), left: self.left, own: self.own }
    }
}

impl<'de> DeserializeSeed<'de> for Build<'_> {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Build<'_> {
    type Value = Node;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Node, A::Error> {
        let mut map = Map::new();
        while let Some(key) = entries.next_key_seed(NewKey { seen: &map, of: &self })? {
            let node = entries.next_value_seed(self.below(key.clone()))?;
            map.insert(key, node);
        }
        self.node(Value::Map(map))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Node, A::Error> {
        let mut list = Vec::new();
        while let Some(node) = entries.next_element_seed(self.below(list.len().to_string()))? {
            list.push(node);
        }
        self.node(Value::List(list))
    }

    fn visit_enum<A: EnumAccess<'de>>(self, _: A) -> Result<Node, A::Error> {
        Err(self.refuse("tags (`!name`) mean nothing here"))
    }

    fn visit_bool<E: serde::de::Error>(self, value: bool) -> Result<Node, E> {
        self.node(Value::Bool(value))
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Node, E> {
        self.node(u64::try_from(value).map_or(Value::Negative(value), Value::Whole))
    }

    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<Node, E> {
        self.node(Value::Whole(value))
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Node, E> {
        self.node(Value::Number(value))
    }

    fn visit_str<E: serde::de::Error>(self, value: &str) -> Result<Node, E> {
        self.node(Value::Text(value.to_owned()))
    }

    fn visit_unit<E: serde::de::Error>(self) -> Result<Node, E> {
        self.node(Value::Null)
    }

    fn visit_none<E: serde::de::Error>(self) -> Result<Node, E> {
        self.node(Value::Null)
    }
}

/// A key, if its mapping does not have it yet.
struct NewKey<'s> {
    seen: &'s Map,
    of: &'s Build<'s>,
}

impl<'de> DeserializeSeed<'de> for NewKey<'_> {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for NewKey<'_> {
    type Value = String;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<String, E> {
        if self.seen.contains_key(key) {
            return Err(self.of.refuse(&format!("the key `{key}` is there twice")));
        }
        Ok(key.to_owned())
    }
}
