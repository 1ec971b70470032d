//! Custom attributes: `_NAME`, one value a vertex, as 32-bit floats.

use std::collections::{BTreeMap, BTreeSet};

use gltf::json::Value;
use gltf::json::accessor::Type;
use groom::{Attribute, Domain, Groom, Values, names};

use crate::{Format, Warning};

/// What is written without being asked for.
pub(super) const WIDTH: &str = "_WIDTH";

/// An attribute and its name in the file.
#[derive(Clone, Copy)]
pub(super) struct Extra<'a> {
    pub(super) attribute: &'a Attribute,
    /// Whether the values are turned and scaled with the positions.
    pub(super) is_velocity: bool,
}

impl Extra<'_> {
    /// glTF's type of a value and its bytes.
    pub(super) fn shape(&self) -> (Type, usize) {
        match self.attribute.values {
            Values::Float(_) | Values::Int(_) => (Type::Scalar, 4),
            Values::Vec2(_) => (Type::Vec2, 8),
            Values::Vec3(_) => (Type::Vec3, 12),
        }
    }
}

/// The standard names and what files call them.
pub(super) const STANDARD: [(&str, &str); 5] = [
    (names::ID, "_STRAND"),
    (names::ROOT_UV, "_ROOT_UV"),
    (names::GROUP, "_GROUP"),
    (names::GUIDE, "_GUIDE"),
    (names::VELOCITY, "_VELOCITY"),
];

/// Every attribute but those in `held`, under its name in the file; warns of those that cannot be written
/// and of those that are renamed.
pub(super) fn extras<'a>(
    groom: &'a Groom,
    format: Format,
    held: &[&str],
    warnings: &mut Vec<Warning>,
) -> Vec<(String, Extra<'a>)> {
    let mut taken = BTreeSet::from([WIDTH.to_owned(), "_RADIUS".to_owned()]);
    taken.extend(STANDARD.map(|(_, written)| written.to_owned()));
    let mut extras = Vec::new();
    for (name, attribute) in groom.attributes().filter(|(name, _)| !held.contains(name)) {
        if !fits(&attribute.values) {
            warnings.push(Warning::AttributeLeftOut { format, name: name.to_owned() });
            continue;
        }
        let written = match STANDARD.iter().find(|(standard, _)| *standard == name) {
            Some((_, written)) => (*written).to_owned(),
            None => {
                let (written, is_same) = custom_name(name, &mut taken);
                if !is_same {
                    let (name, written) = (name.to_owned(), written.clone());
                    warnings.push(Warning::AttributeRenamed { format, name, written });
                }
                written
            }
        };
        extras.push((written, Extra { attribute, is_velocity: name == names::VELOCITY }));
    }
    extras
}

/// Whether every value is finite and survives as a 32-bit float.
fn fits(values: &Values) -> bool {
    match values {
        Values::Float(v) => v.iter().all(|v| v.is_finite()),
        Values::Vec2(v) => v.iter().all(|v| v.is_finite()),
        Values::Vec3(v) => v.iter().all(|v| v.is_finite()),
        Values::Int(v) => v.iter().all(|v| v.unsigned_abs() <= 1 << 24),
    }
}

/// `_` and the name in capitals; whether reading gives the name back.
fn custom_name(name: &str, taken: &mut BTreeSet<String>) -> (String, bool) {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
    let stem = format!("_{}", name.chars().map(plain).collect::<String>());
    let numbered = (2..).map(|number| format!("{stem}_{number}"));
    let written = std::iter::once(stem.clone()).chain(numbered).find(|name| !taken.contains(name));
    let written = written.unwrap_or(stem);
    taken.insert(written.clone());
    let is_same = written.strip_prefix('_').is_some_and(|rest| rest.to_ascii_lowercase() == name);
    (written, is_same)
}

/// What `extras.groomkit` of the mesh says of the attributes in the file: name, domain and type in the groom.
pub(super) fn marks<'a>(written: impl IntoIterator<Item = (&'a str, &'a str, &'a Attribute)>) -> Value {
    let mark = |(written, name, attribute): (&str, &str, &Attribute)| {
        let domain = match attribute.domain {
            Domain::Groom => "groom",
            Domain::Strand => "strand",
            Domain::Vertex => "vertex",
        };
        let words = [("name", name), ("domain", domain), ("type", attribute.values.type_name())];
        let words = words.map(|(key, word)| (key.to_owned(), Value::from(word)));
        (written.to_owned(), Value::from_iter(words))
    };
    let marks: BTreeMap<String, Value> = written.into_iter().map(mark).collect();
    Value::from_iter([("groomkit".to_owned(), Value::from_iter(marks))])
}
