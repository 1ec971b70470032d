//! A tree of values as serde takes it.

use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};

use crate::tree::{Map, Node, Value};
use crate::variant::Variant;

/// What serde says, and where.
#[derive(Debug)]
pub(crate) struct Error {
    pub(crate) message: String,
    /// The steps, the innermost first.
    pub(crate) path: Vec<String>,
    /// The last key is at fault, not what it holds.
    pub(crate) at_key: bool,
}

impl Error {
    pub(crate) fn below(mut self, step: &str) -> Self {
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
pub(crate) struct Typed<'t>(pub(crate) &'t Node);

impl<'t> Typed<'t> {
    /// The letters of a number or yes-or-no: a name may look like one.
    fn letters(self) -> Option<&'t str> {
        self.0.written().filter(|_| self.0.is_number_or_bool())
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
        match &self.0.value {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Negative(value) => visitor.visit_i64(*value),
            Value::Whole(value) => visitor.visit_u64(*value),
            Value::Number(value) => visitor.visit_f64(*value),
            Value::Text(text) => visitor.visit_str(text),
            Value::List(list) => {
                let mut entries = Entries { list, next: 0 };
                let value = visitor.visit_seq(&mut entries)?;
                if entries.next < list.len() {
                    let (count, read) = (list.len(), entries.next);
                    let message = format!("is a list of {count}, expected {read} entries");
                    return Err(serde::de::Error::custom(message));
                }
                Ok(value)
            }
            Value::Map(map) => visitor.visit_map(Keys { map, next: 0 }),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.letters() {
            Some(letters) => visitor.visit_str(letters),
            None => self.deserialize_any(visitor),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if self.0.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.0.value {
            Value::Null => visitor.visit_seq(Entries { list: &[], next: 0 }),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.0.value {
            Value::Null => visitor.visit_map(Keys { map: &Map::new(), next: 0 }),
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
        match &self.0.value {
            Value::Map(map) => match map.first() {
                Some((name, node)) if map.len() == 1 => {
                    visitor.visit_enum(Variant { name, content: Some(Typed(node)) })
                }
                _ => Err(serde::de::Error::custom("is keys and values, expected one word")),
            },
            Value::Text(text) => visitor.visit_enum(Variant { name: text, content: None }),
            _ => match self.letters() {
                Some(letters) => visitor.visit_enum(Variant { name: letters, content: None }),
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
    list: &'t [Node],
    next: usize,
}

impl<'de> SeqAccess<'de> for Entries<'_> {
    type Error = Error;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Error> {
        let Some(node) = self.list.get(self.next) else { return Ok(None) };
        let index = self.next;
        self.next += 1;
        seed.deserialize(Typed(node)).map(Some).map_err(|error| error.below(&index.to_string()))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.list.len() - self.next)
    }
}

/// The keys of a mapping with what they hold.
struct Keys<'t> {
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
        seed.deserialize(Typed(node)).map_err(|error| error.below(key))
    }
}
