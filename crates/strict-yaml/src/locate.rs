//! Where a value stands in a text.

use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::fault::{Place, place_of};

/// Where the value at `path` (keys and list indices) stands in `text`.
///
/// The parser itself is asked: it is sent down the path and refused there, and it says where.
#[must_use]
pub fn locate(text: &str, path: &[&str]) -> Option<Place> {
    descend(text, path, End::Value).1
}

/// Where the key at the end of `path` stands.
pub(crate) fn locate_key(text: &str, path: &[&str]) -> Option<Place> {
    descend(text, path, End::Key).1
}

/// The scalar at the end of `path`, letter by letter.
pub(crate) fn scalar(text: &str, path: &[&str]) -> Option<String> {
    descend(text, path, End::Scalar).0
}

fn descend(text: &str, path: &[&str], end: End) -> (Option<String>, Option<Place>) {
    let descent = Descent { path, end };
    match descent.deserialize(serde_yaml::Deserializer::from_str(text)) {
        Ok(found) => (found, None),
        Err(error) => {
            let arrived = error.to_string().contains(ARRIVED);
            (None, place_of(&error).filter(|_| arrived))
        }
    }
}

pub(crate) const ARRIVED: &str = "\u{1}arrived";

/// What is asked at the end of the way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    /// Where the value is.
    Value,
    /// Where its key is.
    Key,
    /// What was written.
    Scalar,
}

/// Goes down one path, fails at its end (or reads it) and ignores everything else.
#[derive(Clone, Copy)]
struct Descent<'p> {
    path: &'p [&'p str],
    end: End,
}

impl<'de> DeserializeSeed<'de> for Descent<'_> {
    type Value = Option<String>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        if self.path.is_empty() && self.end == End::Scalar {
            deserializer.deserialize_str(self)
        } else {
            deserializer.deserialize_any(self)
        }
    }
}

impl<'de> Visitor<'de> for Descent<'_> {
    type Value = Option<String>;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(if self.path.is_empty() { ARRIVED } else { "a key or entry on the way" })
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Self::Value, E> {
        if self.path.is_empty() && self.end == End::Scalar {
            return Ok(Some(text.to_owned()));
        }
        Err(E::invalid_type(serde::de::Unexpected::Str(text), &self))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let Some((first, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        let refuse = rest.is_empty() && self.end == End::Key;
        let mut found = None;
        while let Some(here) = map.next_key_seed(Key { wanted: first, refuse })? {
            if here {
                found = map.next_value_seed(Descent { path: rest, end: self.end })?;
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(found)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let Some((first, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        let wanted = first.parse::<usize>().unwrap_or(usize::MAX);
        let mut index = 0;
        let mut found = None;
        loop {
            if index == wanted {
                match list.next_element_seed(Descent { path: rest, end: self.end })? {
                    Some(here) => found = here,
                    None => return Ok(found),
                }
            } else if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(found);
            }
            index += 1;
        }
    }
}

/// Whether a key is the one wanted; refused there where that is asked.
struct Key<'p> {
    wanted: &'p str,
    refuse: bool,
}

impl<'de> DeserializeSeed<'de> for Key<'_> {
    type Value = bool;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<bool, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for Key<'_> {
    type Value = bool;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<bool, E> {
        let here = key == self.wanted;
        if here && self.refuse { Err(E::custom(ARRIVED)) } else { Ok(here) }
    }
}
