//! A layer in crate form, prim by prim.

use std::collections::{HashMap, HashSet};
use std::io::{Seek, Write};

use crate::write::arrays::{packed_floats, packed_ints};
use crate::write::heap::Heap;
use crate::write::paths::Paths;
use crate::write::records::{Field, Records, SpecKind};
use crate::write::tokens::Tokens;
use crate::write::value::Type;
use crate::write::{Stored, Value, WriteError, sections};

/// Writes one layer to a stream that can go back. Values go to the stream as they are stored; prims,
/// properties and metadata follow with [`CrateWriter::finish`], without which the bytes are no layer.
#[derive(Debug)]
pub struct CrateWriter<W> {
    heap: Heap<W>,
    tokens: Tokens,
    paths: Paths,
    records: Records,
    metadata: Vec<Field>,
    prims: Vec<PrimRecord>,
    taken: HashSet<u32>,
}

/// A prim of a layer being written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Prim(usize);

#[derive(Debug)]
struct PrimRecord {
    path: String,
    number: u32,
    fields: Vec<Field>,
    /// Names of its properties, in their order.
    properties: Vec<String>,
}

/// An attribute, ready to be written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attribute<'a> {
    /// The name with its namespaces: `primvars:st`.
    pub name: &'a str,
    /// The type as USD spells it: `point3f[]`.
    pub type_name: &'a str,
    /// Whether it may not change over time.
    pub uniform: bool,
    /// What one value belongs to: `constant`, `uniform`, `vertex`.
    pub interpolation: Option<&'a str>,
    /// How many values of the array make one; `None` is 1.
    pub element_size: Option<i32>,
    /// What it holds.
    pub content: Content<'a>,
}

/// What an attribute holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Content<'a> {
    /// Nothing: it is declared.
    Nothing,
    /// One value for all times.
    Value(Stored),
    /// A value a time, from [`CrateWriter::time_samples`].
    Samples(Stored),
    /// What another attribute holds, by its path.
    Connection(&'a str),
}

impl<'a> Attribute<'a> {
    /// An attribute that may change over time, with no interpolation.
    #[must_use]
    pub fn new(name: &'a str, type_name: &'a str, content: Content<'a>) -> Self {
        Attribute { name, type_name, uniform: false, interpolation: None, element_size: None, content }
    }
}

impl<W: Write + Seek> CrateWriter<W> {
    /// A layer that starts where `stream` stands.
    ///
    /// # Errors
    /// When the stream refuses.
    pub fn new(stream: W) -> Result<Self, WriteError> {
        Ok(Self::on(Heap::new(stream, sections::HEAD, false)?))
    }

    pub(super) fn with_checksum(stream: W) -> Result<Self, WriteError> {
        Ok(Self::on(Heap::new(stream, sections::HEAD, true)?))
    }

    fn on(heap: Heap<W>) -> Self {
        CrateWriter {
            heap,
            tokens: Tokens::new(),
            paths: Paths::new(),
            records: Records::default(),
            metadata: Vec::new(),
            prims: Vec::new(),
            taken: HashSet::new(),
        }
    }

    /// Puts a value into the layer; the same value twice takes the room of one.
    ///
    /// # Errors
    /// When the stream refuses or the layer grows over 2^48 bytes.
    pub fn store(&mut self, value: Value<'_>) -> Result<Stored, WriteError> {
        match value {
            Value::Bool(value) => Ok(Stored::in_place(Type::Bool, value.into())),
            Value::Int(value) => Ok(Stored::in_place(Type::Int, value.cast_unsigned())),
            Value::Float(value) => Ok(Stored::in_place(Type::Float, value.to_bits())),
            Value::Token(word) => Ok(Stored::in_place(Type::Token, self.tokens.token(word))),
            Value::String(text) => Ok(Stored::in_place(Type::String, self.tokens.string(text))),
            Value::Double(value) => self.single(Type::Double, &[&value.to_le_bytes()]),
            Value::Float2(value) => self.single(Type::Float2, &[bytemuck::cast_slice(&value)]),
            Value::Float3(value) => self.single(Type::Float3, &[bytemuck::cast_slice(&value)]),
            Value::Double3(value) => self.single(Type::Double3, &[bytemuck::cast_slice(&value)]),
            Value::Matrix4(value) => self.single(Type::Matrix4, &[bytemuck::cast_slice(&value)]),
            Value::Half3s(values) => {
                self.array(Type::Half3, values.len(), bytemuck::cast_slice(values), false)
            }
            Value::Quaternions(values) => {
                // A crate has the real part last.
                let turned: Vec<[f32; 4]> = values.iter().map(|&[w, x, y, z]| [x, y, z, w]).collect();
                self.array(Type::Quaternion, values.len(), bytemuck::cast_slice(&turned), false)
            }
            Value::Matrix4s(values) => {
                self.array(Type::Matrix4, values.len(), bytemuck::cast_slice(values), false)
            }
            Value::Ints(values) => match packed_ints(values)? {
                Some(packed) => self.array(Type::Int, values.len(), &packed, true),
                None => self.array(Type::Int, values.len(), bytemuck::cast_slice(values), false),
            },
            Value::Floats(values) => match packed_floats(values)? {
                Some(packed) => self.array(Type::Float, values.len(), &packed, true),
                None => self.array(Type::Float, values.len(), bytemuck::cast_slice(values), false),
            },
            Value::Float2s(values) => {
                self.array(Type::Float2, values.len(), bytemuck::cast_slice(values), false)
            }
            Value::Float3s(values) => {
                self.array(Type::Float3, values.len(), bytemuck::cast_slice(values), false)
            }
            Value::Tokens(words) => {
                let numbers: Vec<u32> = words.iter().map(|word| self.tokens.token(word)).collect();
                self.array(Type::Token, words.len(), bytemuck::cast_slice(&numbers), false)
            }
            Value::Strings(texts) => {
                let numbers: Vec<u32> = texts.iter().map(|text| self.tokens.string(text)).collect();
                self.array(Type::String, texts.len(), bytemuck::cast_slice(&numbers), false)
            }
        }
    }

    /// Values over time, in the order of their times.
    ///
    /// # Errors
    /// As [`CrateWriter::store`].
    pub fn time_samples(&mut self, samples: &[(f64, Stored)]) -> Result<Stored, WriteError> {
        let times: Vec<u8> = samples.iter().flat_map(|(time, _)| time.to_le_bytes()).collect();
        let times = self.single(Type::DoubleVector, &[&count(samples.len()), &times])?;
        // Both parts may lie elsewhere, so each starts with how far on it is.
        let mut record = 8_i64.to_le_bytes().to_vec();
        record.extend(times.0.to_le_bytes());
        record.extend(8_i64.to_le_bytes());
        record.extend(count(samples.len()));
        record.extend(samples.iter().flat_map(|(_, value)| value.0.to_le_bytes()));
        self.single(Type::TimeSamples, &[&record])
    }

    /// Sets metadata of the layer: `defaultPrim`, `upAxis`, `metersPerUnit`, `timeCodesPerSecond`.
    ///
    /// # Errors
    /// As [`CrateWriter::store`].
    pub fn metadata(&mut self, name: &str, value: Value<'_>) -> Result<(), WriteError> {
        let field = (self.tokens.token(name), self.store(value)?);
        self.metadata.push(field);
        Ok(())
    }

    /// Defines a prim, `/Name/Name`; prims may come in any order, all their ancestors must come at some time.
    ///
    /// # Errors
    /// [`WriteError::Path`], [`WriteError::Twice`].
    pub fn prim(&mut self, path: &str, type_name: &str) -> Result<Prim, WriteError> {
        let number = self.paths.prim(path)?;
        if number == 0 || !self.taken.insert(number) {
            return Err(WriteError::Twice { path: path.to_owned() });
        }
        let fields = vec![
            (self.tokens.token("specifier"), Stored::in_place(Type::Specifier, 0)),
            (self.tokens.token("typeName"), self.store(Value::Token(type_name))?),
        ];
        self.prims.push(PrimRecord { path: path.to_owned(), number, fields, properties: Vec::new() });
        Ok(Prim(self.prims.len() - 1))
    }

    /// Sets metadata of a prim: `kind`.
    ///
    /// # Errors
    /// As [`CrateWriter::store`]; [`WriteError::UnknownPrim`].
    pub fn prim_metadata(&mut self, prim: Prim, name: &str, value: Value<'_>) -> Result<(), WriteError> {
        let field = (self.tokens.token(name), self.store(value)?);
        self.record(prim)?.fields.push(field);
        Ok(())
    }

    /// Applies schemas to a prim, before those it gets from weaker layers.
    ///
    /// # Errors
    /// As [`CrateWriter::prim_metadata`].
    pub fn api_schemas(&mut self, prim: Prim, schemas: &[&str]) -> Result<(), WriteError> {
        let numbers: Vec<u32> = schemas.iter().map(|schema| self.tokens.token(schema)).collect();
        let list = self.list(Type::TokenListOp, PREPENDED, &numbers)?;
        let field = (self.tokens.token("apiSchemas"), list);
        self.record(prim)?.fields.push(field);
        Ok(())
    }

    /// Gives a prim an attribute.
    ///
    /// # Errors
    /// As [`CrateWriter::store`]; [`WriteError::Path`], [`WriteError::Twice`], [`WriteError::UnknownPrim`].
    pub fn attribute(&mut self, prim: Prim, attribute: Attribute<'_>) -> Result<(), WriteError> {
        let path = self.property(prim, attribute.name)?;
        let mut fields =
            vec![(self.tokens.token("typeName"), self.store(Value::Token(attribute.type_name))?)];
        if attribute.uniform {
            fields.push(self.uniform());
        }
        if let Some(interpolation) = attribute.interpolation {
            fields.push((self.tokens.token("interpolation"), self.store(Value::Token(interpolation))?));
        }
        if let Some(size) = attribute.element_size {
            fields.push((self.tokens.token("elementSize"), self.store(Value::Int(size))?));
        }
        match attribute.content {
            Content::Nothing => {}
            Content::Value(value) => fields.push((self.tokens.token("default"), value)),
            Content::Samples(samples) => fields.push((self.tokens.token("timeSamples"), samples)),
            Content::Connection(source) => {
                let source = self.paths.property(source)?;
                let list = self.list(Type::PathListOp, EXPLICIT, &[source])?;
                fields.push((self.tokens.token("connectionPaths"), list));
            }
        }
        self.records.spec(path, SpecKind::Attribute, &fields);
        Ok(())
    }

    /// Gives a prim a relationship to the prims or properties at `targets`.
    ///
    /// # Errors
    /// As [`CrateWriter::attribute`].
    pub fn relationship(&mut self, prim: Prim, name: &str, targets: &[&str]) -> Result<(), WriteError> {
        let path = self.property(prim, name)?;
        let targets = targets.iter().map(|target| self.paths.any(target)).collect::<Result<Vec<_>, _>>()?;
        let list = self.list(Type::PathListOp, EXPLICIT, &targets)?;
        let fields = [self.uniform(), (self.tokens.token("targetPaths"), list)];
        self.records.spec(path, SpecKind::Relationship, &fields);
        Ok(())
    }

    /// Writes what is left and gives the stream back, standing behind the layer.
    ///
    /// # Errors
    /// [`WriteError::NoParent`]; as [`CrateWriter::store`].
    pub fn finish(self) -> Result<W, WriteError> {
        Ok(self.finish_counted()?.0)
    }

    /// As [`CrateWriter::finish`], with the layer's length and its checksum.
    pub(super) fn finish_counted(mut self) -> Result<(W, u64, Option<u32>), WriteError> {
        self.prim_specs()?;
        let head = sections::write(&mut self.heap, &mut self.tokens, &self.paths, &self.records)?;
        self.heap.finish(&head)
    }

    /// The specs of the layer and the prims, now that all children are known.
    fn prim_specs(&mut self) -> Result<(), WriteError> {
        let prims = std::mem::take(&mut self.prims);
        let mut children: HashMap<u32, Vec<&str>> = HashMap::new();
        for prim in &prims {
            let (parent, name) = prim.path.rsplit_once('/').unwrap_or_default();
            children.entry(self.parent(parent, &prim.path)?).or_default().push(name);
        }
        let children_of = |number| children.get(&number).map_or(&[][..], Vec::as_slice);
        let mut fields = std::mem::take(&mut self.metadata);
        self.names("primChildren", children_of(0), &mut fields)?;
        self.records.spec(0, SpecKind::Layer, &fields);
        for prim in &prims {
            let mut fields = prim.fields.clone();
            let properties: Vec<&str> = prim.properties.iter().map(String::as_str).collect();
            self.names("properties", &properties, &mut fields)?;
            self.names("primChildren", children_of(prim.number), &mut fields)?;
            self.records.spec(prim.number, SpecKind::Prim, &fields);
        }
        Ok(())
    }

    /// The number of the prim at `parent`, which is that of `path`.
    fn parent(&mut self, parent: &str, path: &str) -> Result<u32, WriteError> {
        let number = self.paths.prim(if parent.is_empty() { "/" } else { parent })?;
        let known = number == 0 || self.taken.contains(&number);
        if known { Ok(number) } else { Err(WriteError::NoParent { path: path.to_owned() }) }
    }

    /// A field with names, if there are any.
    fn names(&mut self, field: &str, names: &[&str], fields: &mut Vec<Field>) -> Result<(), WriteError> {
        if !names.is_empty() {
            let numbers: Vec<u32> = names.iter().map(|name| self.tokens.token(name)).collect();
            let numbers: &[u8] = bytemuck::cast_slice(&numbers);
            let list = self.single(Type::TokenVector, &[&count(names.len()), numbers])?;
            fields.push((self.tokens.token(field), list));
        }
        Ok(())
    }

    fn uniform(&mut self) -> Field {
        (self.tokens.token("variability"), Stored::in_place(Type::Variability, 1))
    }

    fn record(&mut self, prim: Prim) -> Result<&mut PrimRecord, WriteError> {
        self.prims.get_mut(prim.0).ok_or(WriteError::UnknownPrim { index: prim.0 })
    }

    /// The path of a new property of `prim`.
    fn property(&mut self, prim: Prim, name: &str) -> Result<u32, WriteError> {
        let path = format!("{}.{name}", self.record(prim)?.path);
        let number = self.paths.property(&path)?;
        if !self.taken.insert(number) {
            return Err(WriteError::Twice { path });
        }
        self.record(prim)?.properties.push(name.to_owned());
        Ok(number)
    }

    fn list(&mut self, kind: Type, operation: u8, numbers: &[u32]) -> Result<Stored, WriteError> {
        self.single(kind, &[&[operation], &count(numbers.len()), bytemuck::cast_slice(numbers)])
    }

    fn single(&mut self, kind: Type, parts: &[&[u8]]) -> Result<Stored, WriteError> {
        self.heap.store(kind as u16, parts, |offset| Stored::at(kind, offset))
    }

    fn array(&mut self, kind: Type, length: usize, bytes: &[u8], packed: bool) -> Result<Stored, WriteError> {
        // What is an array, and a packed one, is another value than the same bytes as something else.
        let identity = kind as u16 | 1 << 8 | u16::from(packed) << 9;
        let refer = |offset| Stored::array(kind, offset, packed);
        self.heap.store(identity, &[&count(length), bytes], refer)
    }
}

/// Bits of a list operation: the list is the whole list.
const EXPLICIT: u8 = 0x03;
/// Bits of a list operation: the list goes before what is there.
const PREPENDED: u8 = 0x20;

fn count(length: usize) -> [u8; 8] {
    (length as u64).to_le_bytes()
}
