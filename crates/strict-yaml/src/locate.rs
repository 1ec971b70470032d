//! Where a value stands in a text.

use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::fault::{Place, place_of};

/// Where the value at `path` (keys and list indices) stands in `text`.
///
/// The parser itself is asked: it is sent down the path and refused there, and it says where.
#[must_use]
pub fn locate(text: &str, path: &[&str]) -> Option<Place> {
    let error = Descent { path }.deserialize(serde_yaml::Deserializer::from_str(text)).err()?;
    let arrived = error.to_string().contains(ARRIVED);
    place_of(&error).filter(|_| arrived)
}

pub(crate) const ARRIVED: &str = "\u{1}arrived";

/// Goes down one path, fails at its end and ignores everything else.
struct Descent<'p> {
    path: &'p [&'p str],
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
        while let Some(key) = map.next_key::<String>()? {
            if key == *first {
                map.next_value_seed(Descent { path: rest })?;
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
            if index == wanted {
                if list.next_element_seed(Descent { path: rest })?.is_none() {
                    return Ok(());
                }
            } else if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(());
            }
            index += 1;
        }
    }
}
