//! The letters of numbers and of yes and no, which the tree holds as values.

use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::tree::{Node, Value};

/// Notes in `tree`, which was read from `text`, how every number and yes-or-no was written.
///
/// The text is read a second time, with the tree for a guide: the parser tells letters only where it is asked for
/// text. One reading for all of them, so that a long list takes no longer than its length.
pub(crate) fn note(text: &str, tree: &mut Node) {
    // It was read once without a fault; what is asked for differs in nothing but the letters.
    let _ = Guided(tree).deserialize(serde_yaml::Deserializer::from_str(text));
}

/// Goes where the tree goes.
struct Guided<'n>(&'n mut Node);

impl<'de> DeserializeSeed<'de> for Guided<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        match &self.0.value {
            Value::List(_) | Value::Map(_) => deserializer.deserialize_any(self),
            _ if self.0.is_number_or_bool() => deserializer.deserialize_str(self),
            _ => deserializer.deserialize_ignored_any(IgnoredAny).map(drop),
        }
    }
}

impl<'de> Visitor<'de> for Guided<'_> {
    type Value = ();

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("what was there before")
    }

    fn visit_str<E: serde::de::Error>(self, letters: &str) -> Result<(), E> {
        self.0.origin.letters = Some(letters.into());
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<(), A::Error> {
        while let Some(key) = entries.next_key::<String>()? {
            match self.0.child_mut(&key) {
                Some(child) => entries.next_value_seed(Guided(child))?,
                None => drop(entries.next_value::<IgnoredAny>()?),
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<(), A::Error> {
        if let Value::List(list) = &mut self.0.value {
            for child in list {
                entries.next_element_seed(Guided(child))?;
            }
        }
        while entries.next_element::<IgnoredAny>()?.is_some() {}
        Ok(())
    }
}
