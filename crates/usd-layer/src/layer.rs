//! Layers: prims, attributes and relationships as a file holds them, before composition.

use std::sync::Arc;

use crate::{ListOp, Name, Value};

/// Metadata: names and values in the file's order.
pub type Metadata = Vec<(Name, Value)>;

/// One layer. `B` keeps the bytes of the file (`&[u8]`, `Vec<u8>`), in which the arrays stay until they are
/// asked for.
#[derive(Debug)]
pub struct Layer<B> {
    pub(crate) bytes: B,
    /// Where the layer is among the bytes: all of them but for a package.
    pub(crate) start: usize,
    pub(crate) end: usize,
    /// Tokens and, for every string, the token it is; empty for a text.
    pub(crate) tokens: Vec<Name>,
    pub(crate) strings: Vec<u32>,
    /// Metadata of the layer: `upAxis`, `metersPerUnit`, `timeCodesPerSecond`, `defaultPrim`, `subLayers`.
    pub metadata: Metadata,
    /// The prims at the root.
    pub prims: Vec<Prim>,
}

/// What a prim is there for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Specifier {
    /// `def`: it is there.
    Def,
    /// `over`: opinions about a prim that is defined elsewhere.
    #[default]
    Over,
    /// `class`: to be inherited from, not there by itself.
    Class,
}

/// A prim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prim {
    /// Its name in its parent.
    pub name: Name,
    /// Whether it defines, edits or serves as a class.
    pub specifier: Specifier,
    /// Its schema, `BasisCurves`; empty when it has none.
    pub type_name: Name,
    /// `active`, `apiSchemas`, `kind`, `references`, `variantSelection` and so on.
    pub metadata: Metadata,
    /// Its attributes.
    pub attributes: Vec<Attribute>,
    /// Its relationships.
    pub relationships: Vec<Relationship>,
    /// The prims in it.
    pub children: Vec<Prim>,
    /// Its variants; those selected by the prim itself are part of it already.
    pub variant_sets: Vec<VariantSet>,
}

/// The variants of one set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VariantSet {
    /// The set's name.
    pub name: Name,
    /// One prim a variant; its name is the variant's.
    pub variants: Vec<Prim>,
}

/// An attribute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attribute {
    /// Its name with its namespaces: `primvars:displayColor`.
    pub name: Name,
    /// Its type as it is written: `point3f[]`.
    pub type_name: Name,
    /// Whether it is `uniform`: the same at all times.
    pub uniform: bool,
    /// The value at no time in particular.
    pub default: Option<Value>,
    /// Values at times.
    pub samples: Option<Arc<Samples>>,
    /// The attributes it gets its value from.
    pub connections: Option<Arc<ListOp>>,
    /// `interpolation`, `elementSize`, `customData` and so on.
    pub metadata: Metadata,
}

/// Values at times.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Time codes, rising.
    pub times: Vec<f64>,
    /// One value a time.
    pub values: Vec<Value>,
}

/// A relationship.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Relationship {
    /// Its name with its namespaces: `material:binding`.
    pub name: Name,
    /// What it points to.
    pub targets: Option<Arc<ListOp>>,
    /// What else is said of it.
    pub metadata: Metadata,
}

pub(crate) fn find<'a>(metadata: &'a Metadata, name: &str) -> Option<&'a Value> {
    metadata.iter().find(|(key, _)| &**key == name).map(|(_, value)| value)
}

impl<B> Layer<B> {
    /// The layer's metadata of that name.
    #[must_use]
    pub fn metadata(&self, name: &str) -> Option<&Value> {
        find(&self.metadata, name)
    }

    /// The prim at a path such as `/Groom/Strands`.
    #[must_use]
    pub fn prim(&self, path: &str) -> Option<&Prim> {
        let mut names = path.strip_prefix('/')?.split('/');
        let first = names.next()?;
        let root = self.prims.iter().find(|prim| &*prim.name == first)?;
        names.try_fold(root, |prim, name| prim.children.iter().find(|child| &*child.name == name))
    }
}

impl Prim {
    /// The attribute of that name.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| &*attribute.name == name)
    }

    /// The relationship of that name.
    #[must_use]
    pub fn relationship(&self, name: &str) -> Option<&Relationship> {
        self.relationships.iter().find(|relationship| &*relationship.name == name)
    }

    /// The metadata of that name.
    #[must_use]
    pub fn metadata(&self, name: &str) -> Option<&Value> {
        find(&self.metadata, name)
    }

    /// Whether it is switched on.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.metadata("active") != Some(&Value::Bool(false))
    }
}

impl Attribute {
    /// The metadata of that name.
    #[must_use]
    pub fn metadata(&self, name: &str) -> Option<&Value> {
        find(&self.metadata, name)
    }

    /// The interpolation that is authored: `constant`, `uniform`, `varying`, `vertex`, `faceVarying`.
    #[must_use]
    pub fn interpolation(&self) -> Option<&str> {
        self.metadata("interpolation").and_then(Value::text)
    }

    /// Whether it has a value of its own, at any time.
    #[must_use]
    pub fn has_value(&self) -> bool {
        self.samples.is_some() || matches!(&self.default, Some(value) if *value != Value::Blocked)
    }

    /// The value at `time`, not interpolated: the sample at it or before it, the first sample if there is
    /// none before it, or the default. `None` asks for the default first.
    #[must_use]
    pub fn held(&self, time: Option<f64>) -> Option<&Value> {
        let samples = self.samples.as_ref().filter(|samples| !samples.values.is_empty());
        let value = match (samples, time) {
            (Some(samples), Some(time)) => samples.values.get(samples.before(time)),
            (Some(samples), None) => self.default.as_ref().or_else(|| samples.values.first()),
            (None, _) => self.default.as_ref(),
        };
        value.filter(|value| **value != Value::Blocked)
    }
}

impl Samples {
    /// Index of the last sample at `time` or before it, the first if there is none.
    #[must_use]
    pub fn before(&self, time: f64) -> usize {
        self.times.partition_point(|&t| t <= time).saturating_sub(1)
    }

    /// The samples around `time` and how far it is from the first to the second, 0 to 1.
    #[must_use]
    pub fn around(&self, time: f64) -> (usize, usize, f64) {
        let first = self.before(time);
        let second = (first + 1).min(self.times.len().saturating_sub(1));
        match (self.times.get(first), self.times.get(second)) {
            (Some(&a), Some(&b)) if a < time && b > a => {
                (first, second, ((time - a) / (b - a)).clamp(0.0, 1.0))
            }
            _ => (first, first, 0.0),
        }
    }
}
