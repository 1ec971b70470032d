//! Attributes as primvars.

use std::collections::BTreeSet;
use std::io::{self, Write};

use groom::{Attribute, Domain, Values, names};

use crate::drawable::Drawable;
use crate::numbers::TextOut;
use crate::usd::write::stage::{INDENT, end_array, per_vertex, separate, tuple};
use crate::{Format, Warning};

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

/// Writes every attribute but the radius, which is the curves' widths.
pub(super) fn write_all<W: Write>(
    drawable: Drawable<'_>,
    out: &mut TextOut<'_, W>,
    warnings: &mut Vec<Warning>,
) -> io::Result<()> {
    let mut used: BTreeSet<String> = TAKEN.iter().map(|&name| name.to_owned()).collect();
    for (name, attribute) in drawable.groom.attributes() {
        match name {
            names::RADIUS => continue,
            names::COLOR => write(drawable, out, "color3f", "displayColor", attribute, |v| v)?,
            names::TRANSPARENCY => write(drawable, out, "float", "displayOpacity", attribute, |v| 1.0 - v)?,
            names::ID => write(drawable, out, "int", "id", attribute, |v| v)?,
            names::ROOT_UV => write(drawable, out, "texCoord2f", "st", attribute, |v| v)?,
            other => {
                let written = identifier(other, &mut used);
                write(drawable, out, type_name(&attribute.values), &written, attribute, |v| v)?;
                if written != other {
                    let name = other.to_owned();
                    warnings.push(Warning::AttributeRenamed { format: Format::Usda, name, written });
                }
            }
        }
    }
    Ok(())
}

fn type_name(values: &Values) -> &'static str {
    match values {
        Values::Float(_) => "float",
        Values::Vec2(_) => "float2",
        Values::Vec3(_) => "float3",
        Values::Int(_) => "int",
    }
}

/// `name` as a USD identifier that is not used yet: letters, digits and `_`, no digit first.
fn identifier(name: &str, used: &mut BTreeSet<String>) -> String {
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

fn write<W: Write>(
    drawable: Drawable<'_>,
    out: &mut TextOut<'_, W>,
    type_name: &str,
    name: &str,
    attribute: &Attribute,
    change: impl Fn(f32) -> f32,
) -> io::Result<()> {
    out.push(INDENT);
    out.push(format!("{type_name}[] primvars:{name} = [").as_bytes());
    let push = |out: &mut TextOut<'_, W>, index: usize| match &attribute.values {
        Values::Float(values) => float(out, change(values[index])),
        Values::Vec2(values) => tuple_of_any(out, &values[index].to_array()),
        Values::Vec3(values) => tuple_of_any(out, &values[index].to_array()),
        Values::Int(values) => out.push(values[index].to_string().as_bytes()),
    };
    let interpolation = match attribute.domain {
        Domain::Groom => {
            push(out, 0);
            "constant"
        }
        Domain::Strand => {
            for (place, (strand, _)) in drawable.strands().enumerate() {
                separate(out, place, place.is_multiple_of(8));
                push(out, strand);
                out.hand_on()?;
            }
            "uniform"
        }
        Domain::Vertex => {
            per_vertex(drawable, out, |out, _, vertex| push(out, vertex))?;
            "vertex"
        }
    };
    end_array(out, Some(interpolation));
    Ok(())
}

/// Attributes nobody checked may hold what is no number; USD has words for that.
fn float<W: Write>(out: &mut TextOut<'_, W>, value: f32) {
    if value.is_finite() {
        out.float(value);
    } else {
        let word = if value.is_nan() {
            "nan"
        } else if value > 0.0 {
            "inf"
        } else {
            "-inf"
        };
        out.push(word.as_bytes());
    }
}

fn tuple_of_any<W: Write>(out: &mut TextOut<'_, W>, values: &[f32]) {
    if values.iter().all(|v| v.is_finite()) {
        return tuple(out, values);
    }
    out.push(b"(");
    for (place, &value) in values.iter().enumerate() {
        separate(out, place, false);
        float(out, value);
    }
    out.push(b")");
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
