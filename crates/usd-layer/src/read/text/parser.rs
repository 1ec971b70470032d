//! Prims and properties in a text.

use std::collections::HashMap;
use std::sync::Arc;

use super::cursor::Cursor;
use super::value;
use crate::layer::{Attribute, Metadata, Prim, Relationship, Samples, Specifier, VariantSet};
use crate::read::ReadError;
use crate::read::budget::{self, Budget};
use crate::{ListOp, Name, Value};

/// Prims in prims beyond this are refused.
const DEEPEST: u32 = 128;

/// Names up to this length are kept once for all who use them.
const SHARED: usize = 64;

/// What reads a layer.
pub(super) struct Parser<'a> {
    pub(super) cursor: Cursor<'a>,
    budget: Budget,
    names: HashMap<&'a [u8], Name>,
}

/// How a list edits weaker ones.
#[derive(Clone, Copy, PartialEq)]
enum Edit {
    Explicit,
    Prepend,
    Append,
    Add,
    Delete,
    Reorder,
}

/// What is in `{ }` of a prim or variant.
type Body = Prim;

impl<'a> Parser<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Parser { cursor: Cursor::new(bytes, at), budget: Budget::of(bytes.len()), names: HashMap::new() }
    }

    pub(super) fn charge(&mut self, bytes: usize) -> Result<(), ReadError> {
        let cursor = self.cursor;
        self.budget.take(bytes as u64, || {
            let found = "more prims, properties and names than so short a file should hold";
            ReadError::text(cursor.bytes, cursor.at, found, budget::EXPECTED)
        })
    }

    /// A word as a name, kept once.
    pub(super) fn name(&mut self, word: &'a [u8]) -> Result<Name, ReadError> {
        if let Some(name) = self.names.get(word) {
            return Ok(name.clone());
        }
        let name = self.text(word)?;
        if word.len() <= SHARED {
            self.charge(48)?;
            self.names.insert(word, name.clone());
        }
        Ok(name)
    }

    pub(super) fn text(&mut self, text: &[u8]) -> Result<Name, ReadError> {
        self.charge(text.len() + 16)?;
        Ok(String::from_utf8_lossy(text).into())
    }

    /// A text in quotes.
    pub(super) fn string(&mut self) -> Result<Name, ReadError> {
        let mut ahead = self.cursor;
        let written = ahead.string()?;
        if !written.contains(&b'\\') {
            self.cursor = ahead;
            return self.name(written);
        }
        let text = value::string(&mut self.cursor)?;
        self.charge(text.len() + 16)?;
        Ok(text.into())
    }

    /// A type: a word and maybe `[]`.
    pub(super) fn type_name(&mut self) -> Result<Name, ReadError> {
        let start = {
            self.cursor.skip();
            self.cursor.at
        };
        self.cursor.word();
        if self.cursor.rest().starts_with(b"[]") {
            self.cursor.at += 2;
        }
        let word = &self.cursor.bytes[start..self.cursor.at];
        self.name(word)
    }

    /// The whole layer behind its first line.
    pub(super) fn layer(&mut self) -> Result<(Metadata, Vec<Prim>), ReadError> {
        let mut metadata = Vec::new();
        if self.cursor.eat(b'(') {
            self.metadata_until_end(&mut metadata)?;
        }
        let mut prims = Vec::new();
        loop {
            self.cursor.skip();
            if self.cursor.here().is_none() {
                return Ok((metadata, prims));
            }
            let at = self.cursor.at;
            match self.cursor.word() {
                b"reorder" => {
                    self.cursor.word();
                    self.cursor.expect(b'=', "`=` and names")?;
                    value::untyped(self, 0)?;
                }
                word => match specifier(word) {
                    Some(specifier) => {
                        let prim = self.prim(specifier, 1)?;
                        prims.push(prim);
                    }
                    None => return Err(self.cursor.fault_at(at, "def, over or class")),
                },
            }
        }
    }

    fn prim(&mut self, specifier: Specifier, depth: u32) -> Result<Prim, ReadError> {
        self.charge(2 * size_of::<Prim>())?;
        if depth > DEEPEST {
            return Err(self.cursor.fault("prims fewer than 128 deep in each other"));
        }
        let mut prim = Prim { specifier, ..Prim::default() };
        let word = self.cursor.word();
        prim.type_name = self.name(word)?;
        prim.name = self.string()?;
        if self.cursor.eat(b'(') {
            self.metadata_until_end(&mut prim.metadata)?;
        }
        self.cursor.expect(b'{', "`(` and metadata, or `{` and what is in the prim")?;
        self.body(&mut prim, depth)?;
        Ok(prim)
    }

    fn body(&mut self, prim: &mut Body, depth: u32) -> Result<(), ReadError> {
        loop {
            if self.cursor.eat(b'}') {
                return Ok(());
            }
            let at = self.cursor.at;
            let mut ahead = self.cursor;
            match ahead.word() {
                b"variantSet" => {
                    self.cursor = ahead;
                    self.variant_set(prim, depth)?;
                }
                b"reorder" if matches!(ahead.word(), b"nameChildren" | b"properties") => {
                    self.cursor = ahead;
                    self.cursor.expect(b'=', "`=` and names")?;
                    value::untyped(self, 0)?;
                }
                b"" => return Err(self.cursor.fault_at(at, "a property, a prim or `}`")),
                word => match specifier(word) {
                    Some(specifier) => {
                        self.cursor = ahead;
                        let child = self.prim(specifier, depth + 1)?;
                        prim.children.push(child);
                    }
                    None => self.property(prim)?,
                },
            }
        }
    }

    fn variant_set(&mut self, prim: &mut Body, depth: u32) -> Result<(), ReadError> {
        if depth >= DEEPEST {
            return Err(self.cursor.fault("variants fewer than 128 deep in each other"));
        }
        let mut set = VariantSet { name: self.string()?, variants: Vec::new() };
        self.cursor.expect(b'=', "`=` and variants in { }")?;
        self.cursor.expect(b'{', "variants in { }")?;
        while !self.cursor.eat(b'}') {
            self.charge(2 * size_of::<Prim>())?;
            let mut variant = Prim { name: self.string()?, ..Prim::default() };
            if self.cursor.eat(b'(') {
                self.metadata_until_end(&mut variant.metadata)?;
            }
            self.cursor.expect(b'{', "`{` and what is in the variant")?;
            self.body(&mut variant, depth + 1)?;
            set.variants.push(variant);
        }
        prim.variant_sets.push(set);
        Ok(())
    }

    fn property(&mut self, prim: &mut Body) -> Result<(), ReadError> {
        let (mut edit, mut uniform, mut custom) = (Edit::Explicit, false, false);
        loop {
            let mut ahead = self.cursor;
            match ahead.word() {
                b"custom" => custom = true,
                b"uniform" => uniform = true,
                b"varying" | b"config" => {}
                b"rel" => {
                    self.cursor = ahead;
                    return self.relationship(prim, edit);
                }
                word => match edit_named(word) {
                    Some(named) => edit = named,
                    None => break,
                },
            }
            self.cursor = ahead;
        }
        let at = self.cursor.at;
        let type_name = self.type_name()?;
        let word = self.cursor.word();
        if type_name.is_empty() || word.is_empty() {
            return Err(self.cursor.fault_at(at, "a type and the name of a property"));
        }
        let name = self.name(word)?;
        let known = prim.attributes.iter().position(|attribute| attribute.name == name);
        let place = known.unwrap_or(prim.attributes.len());
        if known.is_none() {
            self.charge(2 * size_of::<Attribute>())?;
            prim.attributes.push(Attribute { name, type_name, uniform, ..Attribute::default() });
        }
        let Some(attribute) = prim.attributes.get_mut(place) else { return Ok(()) };
        attribute.uniform |= uniform;
        if custom && attribute.metadata("custom").is_none() {
            attribute.metadata.push(("custom".into(), Value::Bool(true)));
        }
        self.attribute(attribute, edit)
    }

    fn attribute(&mut self, attribute: &mut Attribute, edit: Edit) -> Result<(), ReadError> {
        let mut part: &[u8] = b"";
        if self.cursor.here() == Some(b'.') {
            self.cursor.at += 1;
            part = self.cursor.word();
        }
        let at = self.cursor.at;
        let assigned = self.cursor.eat(b'=');
        if assigned {
            match part {
                b"" | b"default" => {
                    let type_name = attribute.type_name.clone();
                    attribute.default = Some(value::typed(self, &type_name)?);
                }
                b"timeSamples" => {
                    attribute.samples = Some(Arc::new(self.samples(&attribute.type_name.clone())?))
                }
                b"connect" => self.list(&mut attribute.connections, edit)?,
                b"spline" => {
                    self.skip_braces()?;
                    attribute.metadata.push(("spline".into(), Value::Unsupported("spline".into())));
                }
                _ => {
                    return Err(self
                        .cursor
                        .fault_at(at, "timeSamples, connect, default or spline after `.`"));
                }
            }
        } else if !part.is_empty() {
            return Err(self.cursor.fault("`=` and a value"));
        }
        if self.cursor.eat(b'(') {
            self.metadata_until_end(&mut attribute.metadata)?;
        }
        Ok(())
    }

    fn relationship(&mut self, prim: &mut Body, edit: Edit) -> Result<(), ReadError> {
        let word = self.cursor.word();
        if word.is_empty() {
            return Err(self.cursor.fault("the name of a relationship"));
        }
        let name = self.name(word)?;
        let known = prim.relationships.iter().position(|relationship| relationship.name == name);
        let place = known.unwrap_or(prim.relationships.len());
        if known.is_none() {
            self.charge(2 * size_of::<Relationship>())?;
            prim.relationships.push(Relationship { name, ..Relationship::default() });
        }
        let Some(relationship) = prim.relationships.get_mut(place) else { return Ok(()) };
        if self.cursor.eat(b'=') {
            self.list(&mut relationship.targets, edit)?;
        }
        if self.cursor.eat(b'(') {
            self.metadata_until_end(&mut relationship.metadata)?;
        }
        Ok(())
    }

    /// `{ time: value, ... }`
    fn samples(&mut self, type_name: &str) -> Result<Samples, ReadError> {
        self.cursor.expect(b'{', "times and values in { }")?;
        let mut samples: Vec<(f64, Value)> = Vec::new();
        while !self.cursor.eat(b'}') {
            self.cursor.skip();
            let time = super::numbers::float(self.cursor.rest());
            let (time, len) =
                time.filter(|(time, _)| !time.is_nan()).ok_or_else(|| self.cursor.fault("a time"))?;
            self.cursor.at += len;
            self.cursor.expect(b':', "`:` and a value")?;
            let value = value::typed(self, type_name)?;
            // The list grows by doubling, then becomes two.
            self.charge(3 * size_of::<(f64, Value)>())?;
            samples.push((time, value));
            if !self.cursor.eat(b',') {
                self.cursor.expect(b'}', "`,` or `}`")?;
                break;
            }
        }
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        samples.dedup_by(|later, earlier| later.0 == earlier.0);
        let (times, values) = samples.into_iter().unzip();
        Ok(Samples { times, values })
    }

    fn list(&mut self, list: &mut Option<Arc<ListOp>>, edit: Edit) -> Result<(), ReadError> {
        let value = value::untyped(self, 0)?;
        let items = match value {
            Value::List(items) => Arc::unwrap_or_clone(items).explicit.unwrap_or_default(),
            Value::Blocked => Vec::new(),
            item => vec![item],
        };
        self.charge(size_of::<ListOp>())?;
        let mut changed = list.take().map(Arc::unwrap_or_clone).unwrap_or_default();
        put(&mut changed, edit, items);
        *list = Some(Arc::new(changed));
        Ok(())
    }

    /// Metadata up to `)`.
    pub(super) fn metadata_until_end(&mut self, metadata: &mut Metadata) -> Result<(), ReadError> {
        while !self.cursor.eat(b')') {
            self.charge(2 * size_of::<(Name, Value)>())?;
            if matches!(self.cursor.here(), Some(b'"' | b'\'')) {
                let comment = self.string()?;
                metadata.push(("comment".into(), Value::String(comment)));
                continue;
            }
            let at = self.cursor.at;
            let mut word = self.cursor.word();
            let edit = edit_named(word);
            if edit.is_some() {
                word = self.cursor.word();
            }
            if word.is_empty() {
                return Err(self.cursor.fault_at(at, "metadata, a name and a value, or `)`"));
            }
            let name = self.name(word)?;
            self.cursor.expect(b'=', "`=` and a value")?;
            self.metadata_value(metadata, name, edit)?;
            self.cursor.eat(b',');
        }
        Ok(())
    }

    fn metadata_value(
        &mut self,
        metadata: &mut Metadata,
        name: Name,
        edit: Option<Edit>,
    ) -> Result<(), ReadError> {
        if &*name == "relocates" {
            self.skip_braces()?;
            metadata.push((name, Value::Unsupported("relocates".into())));
            return Ok(());
        }
        // A crate's names for the same.
        let name = match &*name {
            "variants" => "variantSelection".into(),
            "variantSets" => "variantSetNames".into(),
            "doc" => "documentation".into(),
            "payload" | "references" | "inherits" | "specializes" | "apiSchemas" => name,
            _ if edit.is_none() => {
                let value = value::untyped(self, 0)?;
                metadata.push((name, value));
                return Ok(());
            }
            _ => name,
        };
        if matches!(&*name, "variantSelection" | "documentation") {
            let value = value::untyped(self, 0)?;
            metadata.push((name, value));
            return Ok(());
        }
        let known = metadata.iter().position(|(known, _)| *known == name);
        let mut list = match known.map(|place| metadata.swap_remove(place).1) {
            Some(Value::List(list)) => Some(list),
            _ => None,
        };
        self.list(&mut list, edit.unwrap_or(Edit::Explicit))?;
        metadata.extend(list.map(|list| (name, Value::List(list))));
        Ok(())
    }

    /// Goes behind `{ ... }`, whatever is in it.
    fn skip_braces(&mut self) -> Result<(), ReadError> {
        self.cursor.skip();
        let start = self.cursor.at;
        let mut depth = 0_usize;
        loop {
            self.cursor.skip();
            match self.cursor.here() {
                Some(b'{') => depth += 1,
                Some(b'}') => depth = depth.saturating_sub(1),
                Some(b'"' | b'\'') => {
                    self.cursor.string()?;
                    continue;
                }
                Some(_) => {}
                None => return Err(self.cursor.fault_at(start, "`{` that ends with `}`")),
            }
            self.cursor.at += 1;
            if depth == 0 {
                return Ok(());
            }
        }
    }
}

fn specifier(word: &[u8]) -> Option<Specifier> {
    match word {
        b"def" => Some(Specifier::Def),
        b"over" => Some(Specifier::Over),
        b"class" => Some(Specifier::Class),
        _ => None,
    }
}

fn edit_named(word: &[u8]) -> Option<Edit> {
    match word {
        b"prepend" => Some(Edit::Prepend),
        b"append" => Some(Edit::Append),
        b"add" => Some(Edit::Add),
        b"delete" => Some(Edit::Delete),
        b"reorder" => Some(Edit::Reorder),
        _ => None,
    }
}

fn put(list: &mut ListOp, edit: Edit, items: Vec<Value>) {
    match edit {
        Edit::Explicit => list.explicit = Some(items),
        Edit::Prepend => list.prepended = items,
        Edit::Append => list.appended = items,
        Edit::Add => list.added = items,
        Edit::Delete => list.deleted = items,
        Edit::Reorder => list.ordered = items,
    }
}
