//! A tree of values as a plain struct; every fault in it, not only the first.

use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess, SeqAccess,
    VariantAccess, Visitor,
};

use crate::fault::Fault;
use crate::source::{Part, Sources};
use crate::tree::{Map, Node, Value};
use crate::words;

/// More faults than this are not told at once.
const MOST_FAULTS: usize = 100;

/// A struct read from a tree as far as that was possible.
#[derive(Clone, Debug)]
pub struct Reading<T> {
    /// What was read; keys with a fault are as if they were not there. `None` where not even that can be
    /// had: the struct has no defaults for them.
    pub value: Option<T>,
    /// The faults, in the order they were met.
    pub faults: Vec<Fault>,
    /// The keys that were left out of `value` for their faults, as `render.spp`.
    pub left_out: Vec<String>,
}

/// Reads a `T`. What cannot be read is told and left out, and the rest read again, until it can be.
pub(crate) fn read<T: DeserializeOwned>(sources: &Sources, root: &Node) -> Reading<T> {
    let mut tree = root.clone();
    let (mut faults, mut left_out) = (Vec::new(), Vec::new());
    loop {
        let mut error = match T::deserialize(Typed { node: &tree, sources }) {
            Ok(value) => return Reading { value: Some(value), faults, left_out },
            Err(error) => error,
        };
        error.path.reverse();
        let steps: Vec<&str> = error.path.iter().map(String::as_str).collect();
        // That a key is missing which was left out is no fault of its own.
        let missed = error.message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`'));
        let follows = missed.is_some_and(|name| {
            let key: Vec<&str> = steps.iter().copied().chain([name]).collect();
            left_out.contains(&key.join("."))
        });
        if !follows {
            faults.push(told(sources, &tree, &steps, &error));
        }
        let out = remove(&mut tree, &steps);
        let stuck = out.is_none() || faults.len() >= MOST_FAULTS;
        left_out.extend(out);
        if stuck {
            return Reading { value: None, faults, left_out };
        }
    }
}

fn told(sources: &Sources, tree: &Node, steps: &[&str], error: &Error) -> Fault {
    let key = if error.at_key { &steps[..steps.len().saturating_sub(1)] } else { steps };
    let part = if error.at_key { Part::Key } else { Part::Value };
    let node = steps.iter().try_fold(tree, |node, step| node.child(step)).unwrap_or(tree);
    sources.fault(&node.origin, part, &key.join("."), words::plain(&error.message))
}

/// Takes out of the tree the innermost key of a mapping on the way; which one that was.
fn remove(tree: &mut Node, steps: &[&str]) -> Option<String> {
    let inner = (0..steps.len()).rev().find(|&i| {
        let above = steps.get(..i).unwrap_or_default();
        above.iter().try_fold(&*tree, |node, step| node.child(step)).is_some_and(Node::is_map)
    })?;
    let (above, rest) = steps.split_at(inner);
    let node = above.iter().try_fold(tree, |node, step| node.child_mut(step))?;
    let Value::Map(map) = &mut node.value else { return None };
    map.shift_remove(*rest.first()?)?;
    Some(steps.get(..=inner)?.join("."))
}

/// What serde says, and where.
#[derive(Debug)]
pub(crate) struct Error {
    message: String,
    /// The steps, the innermost first.
    path: Vec<String>,
    /// The last key is at fault, not what it holds.
    at_key: bool,
}

impl Error {
    fn below(mut self, step: &str) -> Self {
        self.path.push(step.to_owned());
        self
    }
}

impl serde::de::Error for Error {
    fn custom<T: std::fmt::Display>(message: T) -> Self {
        Error { message: message.to_string(), path: Vec::new(), at_key: false }
    }
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// Hands a node to serde.
#[derive(Clone, Copy)]
struct Typed<'t> {
    node: &'t Node,
    sources: &'t Sources,
}

impl<'t> Typed<'t> {
    fn of(self, node: &'t Node) -> Self {
        Typed { node, sources: self.sources }
    }

    /// The scalar's letters: a name may look like a number.
    fn letters(self) -> Option<String> {
        match &self.node.value {
            Value::Bool(_) | Value::Negative(_) | Value::Whole(_) | Value::Number(_) => {
                self.sources.written(&self.node.origin)
            }
            _ => None,
        }
    }
}

macro_rules! as_any {
    ($($method:ident),+) => {
        $( fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
            self.deserialize_any(visitor)
        } )+
    };
}

impl<'de> Deserializer<'de> for Typed<'_> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.node.value {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Negative(value) => visitor.visit_i64(*value),
            Value::Whole(value) => visitor.visit_u64(*value),
            Value::Number(value) => visitor.visit_f64(*value),
            Value::Text(text) => visitor.visit_str(text),
            Value::List(list) => {
                let mut entries = Entries { of: self, list, next: 0 };
                let value = visitor.visit_seq(&mut entries)?;
                if entries.next < list.len() {
                    let (count, read) = (list.len(), entries.next);
                    let message = format!("is a list of {count}, expected {read} entries");
                    return Err(serde::de::Error::custom(message));
                }
                Ok(value)
            }
            Value::Map(map) => visitor.visit_map(Keys { of: self, map, next: 0 }),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.letters() {
            Some(letters) => visitor.visit_string(letters),
            None => self.deserialize_any(visitor),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if self.node.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.node.value {
            Value::Null => visitor.visit_seq(Entries { of: self, list: &[], next: 0 }),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.node.value {
            Value::Null => visitor.visit_map(Keys { of: self, map: &Map::new(), next: 0 }),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_map(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        match &self.node.value {
            Value::Map(map) => match map.first() {
                Some((name, node)) if map.len() == 1 => {
                    visitor.visit_enum(Variant { name, content: Some(self.of(node)) })
                }
                _ => Err(serde::de::Error::custom("is keys and values, expected one word")),
            },
            Value::Text(text) => visitor.visit_enum(Variant { name: text, content: None }),
            _ => match self.letters() {
                Some(letters) => visitor.visit_enum(Variant { name: &letters, content: None }),
                None => self.deserialize_any(visitor),
            },
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_unit()
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_any(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_any(visitor)
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_any(visitor)
    }

    as_any!(
        deserialize_bool,
        deserialize_i8,
        deserialize_i16,
        deserialize_i32,
        deserialize_i64,
        deserialize_u8,
        deserialize_u16,
        deserialize_u32,
        deserialize_u64,
        deserialize_f32,
        deserialize_f64,
        deserialize_char,
        deserialize_bytes,
        deserialize_byte_buf,
        deserialize_unit,
        deserialize_identifier
    );
}

/// The entries of a list.
struct Entries<'t> {
    of: Typed<'t>,
    list: &'t [Node],
    next: usize,
}

impl<'de> SeqAccess<'de> for Entries<'_> {
    type Error = Error;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Error> {
        let Some(node) = self.list.get(self.next) else { return Ok(None) };
        let index = self.next;
        self.next += 1;
        seed.deserialize(self.of.of(node)).map(Some).map_err(|error| error.below(&index.to_string()))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.list.len() - self.next)
    }
}

/// The keys of a mapping with what they hold.
struct Keys<'t> {
    of: Typed<'t>,
    map: &'t Map,
    next: usize,
}

impl<'de> MapAccess<'de> for Keys<'_> {
    type Error = Error;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Error> {
        let Some((key, _)) = self.map.get_index(self.next) else { return Ok(None) };
        let name: StrDeserializer<Error> = key.as_str().into_deserializer();
        seed.deserialize(name).map(Some).map_err(|error| Error { at_key: true, ..error.below(key) })
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Error> {
        let entry = self.map.get_index(self.next);
        let (key, node) = entry.ok_or_else(|| serde::de::Error::custom("a key without a value"))?;
        self.next += 1;
        seed.deserialize(self.of.of(node)).map_err(|error| error.below(key))
    }
}

/// A word out of several, or a word with what belongs to it.
struct Variant<'t> {
    name: &'t str,
    content: Option<Typed<'t>>,
}

impl<'de, 't> EnumAccess<'de> for Variant<'t> {
    type Error = Error;
    type Variant = Content<'t>;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Content<'t>), Error> {
        let name: StrDeserializer<Error> = self.name.into_deserializer();
        let at_key = |error: Error| match self.content {
            Some(_) => Error { at_key: true, ..error.below(self.name) },
            None => error,
        };
        let content = self.content.map(|typed| (self.name.to_owned(), typed));
        Ok((seed.deserialize(name).map_err(at_key)?, Content(content)))
    }
}

/// What belongs to a word.
struct Content<'t>(Option<(String, Typed<'t>)>);

impl<'t> Content<'t> {
    fn with<T>(self, read: impl FnOnce(Typed<'t>) -> Result<T, Error>) -> Result<T, Error> {
        let needs = || serde::de::Error::custom("is one word, expected it with keys and values of its own");
        let (name, typed) = self.0.ok_or_else(needs)?;
        read(typed).map_err(|error| error.below(&name))
    }
}

impl<'de> VariantAccess<'de> for Content<'_> {
    type Error = Error;

    fn unit_variant(self) -> Result<(), Error> {
        match self.0 {
            Some((name, typed)) if !typed.node.is_null() => {
                let error: Error = serde::de::Error::custom("stands alone, expected nothing below it");
                Err(error.below(&name))
            }
            _ => Ok(()),
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Error> {
        self.with(|typed| seed.deserialize(typed))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Error> {
        self.with(|typed| typed.deserialize_any(visitor))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.with(|typed| typed.deserialize_map(visitor))
    }
}
