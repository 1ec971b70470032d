//! A stage as a crate.

use std::io::{Seek, Write};

use usd_layer::write::{Attribute, CrateWriter, Prim, Stored, Value, WriteError};

use crate::usd::write::array::{Array, Rows};
use crate::usd::write::sink::{Content, Declaration, Head, Single, Sink};

/// Writes into a crate, which the caller finishes.
pub(super) struct CrateSink<'a, W> {
    layer: &'a mut CrateWriter<W>,
    /// The prims that are open, and their paths.
    open: Vec<(Prim, String)>,
}

impl<'a, W: Write + Seek> CrateSink<'a, W> {
    pub fn new(layer: &'a mut CrateWriter<W>) -> Self {
        CrateSink { layer, open: Vec::new() }
    }

    fn innermost(&self) -> Result<Prim, WriteError> {
        self.open.last().map(|(prim, _)| *prim).ok_or(WriteError::UnknownPrim { index: 0 })
    }
}

impl<W: Write + Seek> Sink for CrateSink<'_, W> {
    type Stored = Stored;

    fn store(&mut self, array: &Array<'_>) -> Result<Stored, WriteError> {
        match array.rows {
            Rows::Floats(values) => self.layer.store(Value::Floats(&array.whole(values))),
            Rows::Float2s(values) => self.layer.store(Value::Float2s(&array.whole(values))),
            Rows::Float3s(values) => self.layer.store(Value::Float3s(&array.whole(values))),
            Rows::Ints(values) => self.layer.store(Value::Ints(&array.whole(values))),
        }
    }

    fn layer(&mut self, metadata: &[(&str, Single<'_>)]) -> Result<(), WriteError> {
        for &(name, value) in metadata {
            // Text has a short word for it.
            let name = if name == "doc" { "documentation" } else { name };
            self.layer.metadata(name, single(value))?;
        }
        Ok(())
    }

    fn begin(&mut self, prim: &Head<'_>) -> Result<(), WriteError> {
        let parent = self.open.last().map_or("", |(_, path)| path);
        let path = format!("{parent}/{}", prim.name);
        let number = self.layer.prim(&path, prim.type_name)?;
        if !prim.apis.is_empty() {
            self.layer.api_schemas(number, prim.apis)?;
        }
        if prim.is_component {
            self.layer.prim_metadata(number, "kind", Value::Token("component"))?;
        }
        self.open.push((number, path));
        Ok(())
    }

    fn attribute(
        &mut self,
        attribute: Declaration<'_>,
        content: Content<'_, Stored>,
    ) -> Result<(), WriteError> {
        use usd_layer::write::Content as Held;
        let held = match content {
            Content::Nothing => Held::Nothing,
            Content::Single(value) => Held::Value(self.layer.store(single(value))?),
            Content::Array(array) => Held::Value(self.store(array)?),
            Content::Samples(samples) => Held::Samples(self.layer.time_samples(samples)?),
            Content::Moving(samples) => {
                let mut stored = Vec::with_capacity(samples.len());
                for &(time, value) in samples {
                    stored.push((time, self.layer.store(single(value))?));
                }
                Held::Samples(self.layer.time_samples(&stored)?)
            }
            Content::Connection(source) => Held::Connection(source),
        };
        let Declaration { name, type_name, uniform, interpolation, element_size } = attribute;
        let prim = self.innermost()?;
        let content = held;
        let attribute = Attribute { name, type_name, uniform, interpolation, element_size, content };
        self.layer.attribute(prim, attribute)
    }

    fn relationship(&mut self, name: &str, target: &str) -> Result<(), WriteError> {
        let prim = self.innermost()?;
        self.layer.relationship(prim, name, &[target])
    }

    fn end(&mut self) -> Result<(), WriteError> {
        self.open.pop();
        Ok(())
    }
}

fn single(value: Single<'_>) -> Value<'_> {
    match value {
        Single::Token(word) => Value::Token(word),
        Single::Text(text) => Value::String(text),
        Single::Float(value) => Value::Float(value),
        Single::Double(value) => Value::Double(value),
        Single::Float2(value) => Value::Float2(value),
        Single::Float3(value) => Value::Float3(value),
        Single::Double3(value) => Value::Double3(value),
        Single::Matrix4(value) => Value::Matrix4(value),
        Single::Tokens(words) => Value::Tokens(words),
        Single::Float3s(values) => Value::Float3s(values),
        Single::Half3s(values) => Value::Half3s(values),
        Single::Quaternions(values) => Value::Quaternions(values),
        Single::Matrix4s(values) => Value::Matrix4s(values),
    }
}
