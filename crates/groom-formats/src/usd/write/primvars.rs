//! Attributes as primvars: names, types, and what programs call them.

use std::collections::BTreeSet;

use groom::{Attribute, Domain, Values, names};

use crate::usd::write::array::{Array, Change, Rows, Shape, Spread};
use crate::usd::write::curves::Curves;
use crate::{Dialect, Format, Warning};

/// Names that mean something else to readers of USD: `widths` would win over the curves' own.
const TAKEN: [&str; 9] = [
    "widths",
    "points",
    "normals",
    "displayColor",
    "displayOpacity",
    "st",
    "id",
    "velocities",
    "accelerations",
];

/// A primvar of the curves.
pub(super) struct Primvar<'a> {
    /// With `primvars:` before it.
    pub name: String,
    pub type_name: &'static str,
    pub array: Array<'a>,
}

/// Every attribute but the radius and the velocity, which the curves have places for.
pub(super) fn all<'a>(
    curves: &'a Curves<'a>,
    dialect: Option<Dialect>,
    format: Format,
    warnings: &mut Vec<Warning>,
) -> Vec<Primvar<'a>> {
    let mut list = List { curves, primvars: Vec::new() };
    let mut used: BTreeSet<String> = TAKEN.iter().map(|&name| name.to_owned()).collect();
    used.extend(own_names(dialect).iter().map(|&name| name.to_owned()));
    for (name, attribute) in curves.groom.attributes() {
        match name {
            names::RADIUS | names::VELOCITY => continue,
            names::COLOR => list.add("displayColor", "color3f[]", attribute),
            names::TRANSPARENCY => {
                let opacity = Shape { change: Change::Complement, ..Shape::same(attribute.domain) };
                list.shaped("displayOpacity", "float[]", attribute, opacity);
            }
            names::ID => list.add("id", "int[]", attribute),
            names::ROOT_UV => list.add("st", "texCoord2f[]", attribute),
            names::GROUP | names::GUIDE => {
                used.insert(name.to_owned());
                list.add(name, type_name(&attribute.values), attribute);
            }
            other => {
                let prefix = if dialect == Some(Dialect::Unreal) { "groom_" } else { "" };
                let written = identifier(&format!("{prefix}{other}"), &mut used);
                list.add(&written, type_name(&attribute.values), attribute);
                if written != other {
                    let name = other.to_owned();
                    warnings.push(Warning::AttributeRenamed { format, name, written });
                }
            }
        }
        match dialect {
            Some(Dialect::Unreal) => list.unreal(name, attribute),
            Some(Dialect::Houdini) if name == names::ID => list.add("hairid", "int[]", attribute),
            Some(Dialect::Blender) if name == names::ROOT_UV => {
                list.add("surface_uv_coordinate", "float2[]", attribute);
            }
            _ => {}
        }
    }
    if dialect == Some(Dialect::Houdini) {
        list.push("width", "float[]", widths(curves));
    }
    list.primvars
}

/// The diameters, one a point.
pub(super) fn widths<'a>(curves: &'a Curves<'a>) -> Array<'a> {
    let (rows, from) = match curves.groom.attribute(names::RADIUS) {
        Some(attribute) => (Rows::from(&attribute.values), attribute.domain),
        None => (Rows::Floats(&[groom::DEFAULT_RADIUS]), Domain::Groom),
    };
    let shape = Shape { from, to: Spread::Point, change: Change::Double, ..Shape::FIXED };
    Array { curves, rows, shape }
}

/// The names a dialect adds.
fn own_names(dialect: Option<Dialect>) -> &'static [&'static str] {
    match dialect {
        Some(Dialect::Unreal) => {
            &["groom_id", "groom_root_uv", "groom_color", "groom_group_id", "groom_guide"]
        }
        Some(Dialect::Houdini) => &["hairid", "width"],
        Some(Dialect::Blender) => &["surface_uv_coordinate"],
        _ => &[],
    }
}

struct List<'a> {
    curves: &'a Curves<'a>,
    primvars: Vec<Primvar<'a>>,
}

impl<'a> List<'a> {
    fn add(&mut self, name: &str, type_name: &'static str, attribute: &'a Attribute) {
        self.shaped(name, type_name, attribute, Shape::same(attribute.domain));
    }

    fn shaped(&mut self, name: &str, type_name: &'static str, attribute: &'a Attribute, shape: Shape) {
        let array = Array { curves: self.curves, rows: Rows::from(&attribute.values), shape };
        self.push(name, type_name, array);
    }

    fn push(&mut self, name: &str, type_name: &'static str, array: Array<'a>) {
        self.primvars.push(Primvar { name: format!("primvars:{name}"), type_name, array });
    }

    /// What Unreal reads: types it takes, colours per point, the rest per strand.
    fn unreal(&mut self, name: &str, attribute: &'a Attribute) {
        let (written, type_name, to) = match name {
            names::ID => ("groom_id", "int[]", Spread::Curve),
            names::ROOT_UV => ("groom_root_uv", "float2[]", Spread::Curve),
            names::COLOR => ("groom_color", "float3[]", Spread::Point),
            names::GROUP => ("groom_group_id", "int[]", Spread::Curve),
            names::GUIDE => ("groom_guide", "int[]", Spread::Curve),
            _ => return,
        };
        // What is per point cannot become per strand.
        let to = if attribute.domain == Domain::Vertex { Spread::Point } else { to };
        self.shaped(written, type_name, attribute, Shape { to, ..Shape::same(attribute.domain) });
    }
}

fn type_name(values: &Values) -> &'static str {
    match values {
        Values::Float(_) => "float[]",
        Values::Vec2(_) => "float2[]",
        Values::Vec3(_) => "float3[]",
        Values::Int(_) => "int[]",
    }
}

/// `name` as a USD identifier that is not used yet: letters, digits and `_`, no digit first.
pub(super) fn identifier(name: &str, used: &mut BTreeSet<String>) -> String {
    let mut plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if !plain.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
        plain.insert(0, '_');
    }
    let mut free = plain.clone();
    let mut number = 2;
    while !used.insert(free.clone()) {
        free = format!("{plain}_{number}");
        number += 1;
    }
    free
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers_of_their_own() {
        let mut used: BTreeSet<String> = TAKEN.iter().map(|&name| name.to_owned()).collect();
        let mut make = |name| identifier(name, &mut used);
        assert_eq!(make("rest_length"), "rest_length");
        assert_eq!(make("clump id"), "clump_id");
        assert_eq!(make("clump-id"), "clump_id_2");
        assert_eq!(make("2nd"), "_2nd");
        assert_eq!(make(""), "_");
        assert_eq!(make("widths"), "widths_2");
    }
}
