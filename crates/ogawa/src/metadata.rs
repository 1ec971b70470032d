//! Words about an object or a property: keys and values.

use crate::OgawaError;

/// Keys and values, in the order of the keys; in the file `key=value;key=value`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata(Vec<(String, String)>);

impl Metadata {
    /// No words.
    #[must_use]
    pub fn new() -> Self {
        Metadata::default()
    }

    /// Adds or replaces a key, for building in one expression.
    #[must_use]
    pub fn with(mut self, key: &str, value: &str) -> Self {
        self.set(key, value);
        self
    }

    /// Adds or replaces a key.
    pub fn set(&mut self, key: &str, value: &str) {
        match self.0.binary_search_by(|(other, _)| other.as_str().cmp(key)) {
            Ok(place) => self.0[place].1 = value.to_owned(),
            Err(place) => self.0.insert(place, (key.to_owned(), value.to_owned())),
        }
    }

    /// The value of a key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&str> {
        let place = self.0.binary_search_by(|(other, _)| other.as_str().cmp(key)).ok()?;
        Some(&self.0[place].1)
    }

    /// Whether there are no words.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Keys and values, in the order of the keys.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> + '_ {
        self.0.iter().map(|(key, value)| (key.as_str(), value.as_str()))
    }

    /// As it stands in the file.
    pub(crate) fn to_text(&self) -> Result<String, OgawaError> {
        for text in self.0.iter().flat_map(|(key, value)| [key, value]) {
            // `=` too: readers split at the first one, and writers refuse it in both.
            if text.contains([';', '=', '\0']) {
                let (what, expected) = ("metadata", "no `;`, `=` or 0 byte");
                return Err(OgawaError::Unwritable { what, found: text.clone(), expected });
            }
        }
        let pairs = self.0.iter().map(|(key, value)| format!("{key}={value}"));
        Ok(pairs.collect::<Vec<_>>().join(";"))
    }
}

/// Keys and values as they stand in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MetadataText<'a>(pub(crate) &'a str);

impl<'a> MetadataText<'a> {
    /// The value of a key, the first where there are several.
    #[must_use]
    pub fn get(self, key: &str) -> Option<&'a str> {
        self.iter().find_map(|(other, value)| (other == key).then_some(value))
    }

    /// Keys and values, in the order of the file.
    pub fn iter(self) -> impl Iterator<Item = (&'a str, &'a str)> {
        self.0.split(';').filter_map(|pair| pair.split_once('='))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_go_there_and_back_in_the_order_of_their_keys() {
        let words = Metadata::new().with("podName", "float32_t").with("geoScope", "vtx").with("x", "");
        let text = words.to_text().unwrap();
        assert_eq!(text, "geoScope=vtx;podName=float32_t;x=");
        let read = MetadataText(&text);
        assert!(read.iter().eq(words.iter()));
        assert_eq!((read.get("geoScope"), read.get("scope"), words.get("x")), (Some("vtx"), None, Some("")));
        assert_eq!(MetadataText(";;no pair;").iter().count() + MetadataText("").iter().count(), 0);
        assert!(Metadata::new().with("a", "b;c").to_text().is_err());
    }
}
