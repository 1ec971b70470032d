//! From specs, each a path and fields, to prims in prims.

use std::collections::HashMap;
use std::sync::Arc;

use super::compression::too_much;
use super::paths::NONE;
use super::value::{FieldValue, Source};
use crate::layer::{Attribute, Metadata, Prim, Relationship, Specifier, VariantSet};
use crate::read::ReadError;
use crate::read::budget::Budget;
use crate::{ListOp, Name, Value};

/// The numbers of the kinds of specs that are kept.
const ATTRIBUTE: u32 = 1;
const PRIM: u32 = 6;
const ROOT: u32 = 7;
const RELATIONSHIP: u32 = 8;
const VARIANT: u32 = 10;
const VARIANT_SET: u32 = 11;

/// The layer itself.
#[derive(Default)]
pub(in crate::read) struct Root {
    pub(in crate::read) metadata: Metadata,
    pub(in crate::read) prims: Vec<Prim>,
}

/// What is in a prim, variant or set, last first, until its own turn comes.
#[derive(Default)]
struct Inside {
    prims: Vec<Prim>,
    attributes: Vec<Attribute>,
    relationships: Vec<Relationship>,
    variant_sets: Vec<VariantSet>,
}

/// The order in which children are listed.
#[derive(Default)]
struct Orders {
    prims: Option<Value>,
    properties: Option<Value>,
}

pub(super) fn build(source: &Source<'_>, budget: &mut Budget) -> Result<Root, ReadError> {
    let specs = specs_by_path(source, budget)?;
    let mut builder = Builder { source, budget, fields: Vec::new(), inside: HashMap::new() };
    builder.fields.resize_with(source.sections.fields.len(), || None);
    let mut root = Root::default();
    // Parents come first in the order, so children are finished first from its end.
    for &index in source.paths.order.iter().rev() {
        let Some(spec) = specs.get(index as usize).and_then(|&spec| source.sections.specs.get(spec as usize))
        else {
            continue;
        };
        let node = source.paths.nodes[index as usize];
        let name = source.token(node.token, source.sections.paths.at)?;
        match spec.kind {
            ROOT => root = builder.root(index, spec.fields)?,
            _ if node.parent == NONE => {}
            PRIM | VARIANT => {
                let prim = builder.prim(index, name, spec)?;
                builder.parent(node.parent).prims.push(prim);
            }
            ATTRIBUTE => {
                let attribute = builder.attribute(name, spec.fields)?;
                builder.parent(node.parent).attributes.push(attribute);
            }
            RELATIONSHIP => {
                let relationship = builder.relationship(name, spec.fields)?;
                builder.parent(node.parent).relationships.push(relationship);
            }
            VARIANT_SET => {
                // Its variants are its siblings: `{set=variant}` beside `{set=}`; the prim sorts them.
                let name =
                    Name::from(name.trim_start_matches('{').trim_end_matches('}').trim_end_matches('='));
                builder.parent(node.parent).variant_sets.push(VariantSet { name, variants: Vec::new() });
            }
            _ => {}
        }
    }
    Ok(root)
}

/// For every path the index of its spec.
fn specs_by_path(source: &Source<'_>, budget: &mut Budget) -> Result<Vec<u32>, ReadError> {
    let paths = source.paths.nodes.len();
    let cost = 4 * paths as u64 + 40 * source.sections.fields.len() as u64;
    budget.take(cost, || too_much(source.sections.paths.at, cost, "specs"))?;
    let mut specs = vec![u32::MAX; paths];
    for (index, spec) in source.sections.specs.iter().enumerate() {
        match specs.get_mut(spec.path as usize) {
            Some(slot) => *slot = index as u32,
            None => {
                let found = format!("path {} in spec {index}", spec.path);
                return Err(ReadError::byte(source.sections.paths.at, found, format!("one of {paths}")));
            }
        }
    }
    Ok(specs)
}

struct Builder<'a, 'b> {
    source: &'b Source<'a>,
    budget: &'b mut Budget,
    /// Values of fields, which specs share, once they were read.
    fields: Vec<Option<FieldValue>>,
    inside: HashMap<u32, Inside>,
}

impl Builder<'_, '_> {
    fn parent(&mut self, index: u32) -> &mut Inside {
        self.inside.entry(index).or_default()
    }

    fn charge(&mut self, bytes: usize) -> Result<(), ReadError> {
        let at = self.source.sections.paths.at;
        self.budget.take(bytes as u64, || too_much(at, bytes as u64, "prims and attributes"))
    }

    /// Calls `take` with every field of a spec.
    fn fields(&mut self, first: u32, mut take: impl FnMut(&Name, FieldValue)) -> Result<(), ReadError> {
        let source = self.source;
        let at = source.sections.paths.at;
        let set = source.sections.field_sets.get(first as usize..).unwrap_or_default();
        for &index in set.iter().take_while(|&&index| index != u32::MAX) {
            let Some(field) = source.sections.fields.get(index as usize) else {
                return Err(ReadError::byte(at, format!("field {index}"), "one of the file's fields"));
            };
            self.charge(size_of::<(Name, Value)>())?;
            let value = match self.fields.get(index as usize) {
                Some(Some(value)) => value.clone(),
                _ => source.field(field.value, self.budget)?,
            };
            if let Some(slot @ None) = self.fields.get_mut(index as usize) {
                *slot = Some(value.clone());
            }
            take(&source.token(field.name, at)?, value);
        }
        Ok(())
    }

    fn root(&mut self, index: u32, fields: u32) -> Result<Root, ReadError> {
        let mut root = Root::default();
        let mut order = None;
        self.fields(fields, |name, value| match (&**name, value) {
            ("primChildren", FieldValue::Value(value)) => order = Some(value),
            (_, FieldValue::Value(value)) => root.metadata.push((name.clone(), value)),
            _ => {}
        })?;
        let mut inside = self.inside.remove(&index).unwrap_or_default();
        inside.prims.reverse();
        sort_by_name(&mut inside.prims, order.as_ref(), |prim| &prim.name);
        root.prims = inside.prims;
        Ok(root)
    }

    fn prim(&mut self, index: u32, name: Name, spec: &super::sections::Spec) -> Result<Prim, ReadError> {
        self.charge(size_of::<Prim>())?;
        let mut prim = Prim { name, ..Prim::default() };
        let mut orders = Orders::default();
        self.fields(spec.fields, |name, value| {
            let FieldValue::Value(value) = value else { return };
            match &**name {
                "specifier" => prim.specifier = specifier(&value),
                "typeName" => prim.type_name = value.text().unwrap_or_default().into(),
                "primChildren" => orders.prims = Some(value),
                "properties" => orders.properties = Some(value),
                "variantSetChildren" | "variantChildren" => {}
                _ => prim.metadata.push((name.clone(), value)),
            }
        })?;
        if let Some(mut inside) = self.inside.remove(&index) {
            inside.prims.reverse();
            inside.attributes.reverse();
            inside.relationships.reverse();
            inside.variant_sets.reverse();
            take_variants(&mut inside);
            sort_by_name(&mut inside.prims, orders.prims.as_ref(), |prim| &prim.name);
            sort_by_name(&mut inside.attributes, orders.properties.as_ref(), |attribute| &attribute.name);
            sort_by_name(&mut inside.relationships, orders.properties.as_ref(), |relationship| {
                &relationship.name
            });
            (prim.children, prim.attributes) = (inside.prims, inside.attributes);
            (prim.relationships, prim.variant_sets) = (inside.relationships, inside.variant_sets);
        }
        Ok(prim)
    }

    fn attribute(&mut self, name: Name, fields: u32) -> Result<Attribute, ReadError> {
        self.charge(size_of::<Attribute>())?;
        let mut attribute = Attribute { name, ..Attribute::default() };
        self.fields(fields, |name, value| match (&**name, value) {
            ("timeSamples", FieldValue::Samples(samples)) => attribute.samples = Some(samples),
            (_, FieldValue::Samples(_)) => {}
            ("typeName", FieldValue::Value(value)) => {
                attribute.type_name = value.text().unwrap_or_default().into()
            }
            ("variability", FieldValue::Value(value)) => attribute.uniform = value.text() == Some("uniform"),
            ("default", FieldValue::Value(value)) => attribute.default = Some(value),
            ("connectionPaths", FieldValue::Value(value)) => attribute.connections = list(value),
            ("connectionChildren", _) => {}
            (_, FieldValue::Value(value)) => attribute.metadata.push((name.clone(), value)),
        })?;
        Ok(attribute)
    }

    fn relationship(&mut self, name: Name, fields: u32) -> Result<Relationship, ReadError> {
        self.charge(size_of::<Relationship>())?;
        let mut relationship = Relationship { name, ..Relationship::default() };
        self.fields(fields, |name, value| match (&**name, value) {
            ("targetPaths", FieldValue::Value(value)) => relationship.targets = list(value),
            ("targetChildren" | "variability", _) | (_, FieldValue::Samples(_)) => {}
            (_, FieldValue::Value(value)) => relationship.metadata.push((name.clone(), value)),
        })?;
        Ok(relationship)
    }
}

fn list(value: Value) -> Option<Arc<ListOp>> {
    match value {
        Value::List(list) => Some(list),
        _ => None,
    }
}

fn specifier(value: &Value) -> Specifier {
    match value.text() {
        Some("def") => Specifier::Def,
        Some("class") => Specifier::Class,
        _ => Specifier::Over,
    }
}

/// Moves variants, which are stored beside the prim's children, into their sets.
fn take_variants(inside: &mut Inside) {
    let (variants, prims) =
        std::mem::take(&mut inside.prims).into_iter().partition(|prim: &Prim| prim.name.starts_with('{'));
    inside.prims = prims;
    let variants: Vec<Prim> = variants;
    for mut variant in variants {
        let inner = variant.name.trim_start_matches('{').trim_end_matches('}').to_owned();
        let (set, name) = inner.split_once('=').unwrap_or((&inner, ""));
        variant.name = name.into();
        match inside.variant_sets.iter_mut().find(|known| &*known.name == set) {
            Some(known) => known.variants.push(variant),
            None => inside.variant_sets.push(VariantSet { name: set.into(), variants: vec![variant] }),
        }
    }
}

/// Sorts by the place of the name in a list of tokens.
fn sort_by_name<T>(items: &mut [T], order: Option<&Value>, name: impl Fn(&T) -> &Name) {
    let Some(Value::List(order)) = order else { return };
    let places: HashMap<&str, usize> =
        order.items().enumerate().filter_map(|(place, item)| Some((item.text()?, place))).collect();
    items.sort_by_key(|item| places.get(&**name(item)).copied().unwrap_or(usize::MAX));
}
