//! One word out of several, as serde takes it.

use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, VariantAccess, Visitor};

use crate::typed::{Error, Typed};

/// A word out of several, or a word with what belongs to it.
pub(crate) struct Variant<'t> {
    pub(crate) name: &'t str,
    pub(crate) content: Option<Typed<'t>>,
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
pub(crate) struct Content<'t>(Option<(String, Typed<'t>)>);

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
            Some((name, typed)) if !typed.0.is_null() => {
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
