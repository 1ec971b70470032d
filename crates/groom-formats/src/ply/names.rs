//! What attributes are called in a PLY file.

use std::collections::BTreeSet;

use groom::{Groom, Values};

use crate::{Format, Warning};

/// Names that mean something to readers, and not what an attribute of that name means.
const TAKEN: [&str; 26] = [
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "vx",
    "vy",
    "vz",
    "r",
    "g",
    "b",
    "red",
    "green",
    "blue",
    "alpha",
    "diffuse_red",
    "diffuse_green",
    "diffuse_blue",
    "width",
    "thickness",
    "nsegs",
    "vertex1",
    "vertex2",
    "vertex_index",
    "vertex_indices",
];

/// The names of the properties that hold an attribute.
///
/// A name in the file is one word that no other property has; a scalar does not end like a part of a vector.
pub(crate) fn properties(name: &str, values: &Values, used: &mut BTreeSet<String>) -> Vec<String> {
    let axes: &[&str] = match values {
        Values::Float(_) | Values::Int(_) => &[""],
        Values::Vec2(_) => &["_x", "_y"],
        Values::Vec3(_) => &["_x", "_y", "_z"],
    };
    let mut stem: String =
        name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
    let named = |stem: &str| axes.iter().map(|axis| format!("{stem}{axis}")).collect::<Vec<_>>();
    let is_part = |name: &str| axes.len() == 1 && ["_x", "_y", "_z"].iter().any(|axis| name.ends_with(axis));
    while stem.is_empty()
        || is_part(&stem)
        || named(&stem).iter().any(|name| TAKEN.contains(&name.as_str()) || used.contains(name))
    {
        stem.push('_');
    }
    let names = named(&stem);
    used.extend(names.iter().cloned());
    names
}

/// The warning that `written` is not what `name` is called, if so.
pub(crate) fn renamed(name: &str, written: &[String]) -> Option<Warning> {
    let stem = match written {
        [one] => one.as_str(),
        _ => written.first()?.strip_suffix("_x")?,
    };
    let (format, name) = (Format::Ply, name.to_owned());
    (stem != name).then(|| Warning::AttributeRenamed { format, name, written: stem.to_owned() })
}

/// Whether 8 bits hold every colour as it is.
pub(crate) fn colors_are_bytes(groom: &Groom) -> bool {
    // By bits: minus zero is not what comes back.
    let is_held = |&value: &f32| (f32::from(byte(value)) / 255.0).to_bits() == value.to_bits();
    let exact = |color: &glam::Vec3| color.to_array().iter().all(is_held);
    match groom.colors() {
        None => true,
        Some(groom::Vec3View::Constant(color)) => exact(&color),
        Some(groom::Vec3View::Strand(colors) | groom::Vec3View::Vertex(colors)) => colors.iter().all(exact),
    }
}

/// The nearest of 0 to 255.
pub(crate) fn byte(value: f32) -> u8 {
    // The cast keeps to the range.
    (value * 255.0).round() as u8
}
