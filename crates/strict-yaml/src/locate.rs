//! Where a value stands in a text.

use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::fault::{Place, place_of};

/// Where the value at `path` (keys and list indices) stands in `text`.
///
/// The parser itself is asked: it is sent down the path and refused there, and it says where.
#[must_use]
pub fn locate(text: &str, path: &[&str]) -> Option<Place> {
    descend(text, path, End::Value)
}

/// Where the key at the end of `path` stands.
pub(crate) fn locate_key(text: &str, path: &[&str]) -> Option<Place> {
    descend(text, path, End::Key)
}

fn descend(text: &str, path: &[&str], end: End) -> Option<Place> {
    let error = Descent { path, end }.deserialize(serde_yaml::Deserializer::from_str(text)).err()?;
    let arrived = error.to_string().contains(ARRIVED);
    place_of(&error).filter(|_| arrived)
}

pub(crate) const ARRIVED: &str = "\u{1}arrived";

/// What is asked at the end of the way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    /// Where the value is.
    Value,
    /// Where its key is.
    Key,
}

/// Goes down one path, fails at its end and ignores everything else.
#[derive(Clone, Copy)]
struct Descent<'p> {
    path: &'p [&'p str],
    end: End,
}

impl<'de> DeserializeSeed<'de> for Descent<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Descent<'_> {
    type Value = ();

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(if self.path.is_empty() { ARRIVED } else { "a key or entry on the way" })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Some((first, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        let refuse = rest.is_empty() && self.end == End::Key;
        while let Some(here) = map.next_key_seed(Key { wanted: first, refuse })? {
            if here {
                map.next_value_seed(Descent { path: rest, end: self.end })?;
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Some((first, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        let wanted = first.parse::<usize>().unwrap_or(usize::MAX);
        let mut index = 0;
        loop {
            let more = if index == wanted {
                list.next_element_seed(Descent { path: rest, end: self.end })?.is_some()
            } else {
                list.next_element::<IgnoredAny>()?.is_some()
            };
            if !more {
                return Ok(());
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
