//! From the file's columns to the groom's attributes: names, types and domains.

use std::collections::BTreeMap;

use glam::Vec2;
use groom::{Attribute, Domain, Values, names};

use super::Found;
use super::columns::Column;
use super::marks::Mark;
use crate::gltf::extra::STANDARD;
use crate::{Format, Warning};

/// Attributes that are one value a strand if they can be.
const OF_STRANDS: [&str; 4] = [names::ID, names::ROOT_UV, names::GROUP, names::GUIDE];

/// Takes the columns and makes attributes of them; what cannot be one is told.
pub(super) fn attributes(
    found: &mut Found,
    marks: &BTreeMap<String, Mark>,
    format: Format,
    warnings: &mut Vec<Warning>,
) -> Vec<(String, Attribute)> {
    let mut columns = std::mem::take(&mut found.columns);
    let mut unread = std::mem::take(&mut columns.torn);
    let mut columns = columns.finish(found.positions.len());
    // All opaque says nothing, unless it was said.
    let is_opaque =
        |column: &Column| matches!(&column.values, Values::Float(v) if v.iter().all(|&v| v == 0.0));
    if !marks.contains_key("ALPHA") && columns.get("ALPHA").is_some_and(is_opaque) {
        columns.remove("ALPHA");
    }
    if marks.contains_key("ALPHA") && !marks.contains_key("COLOR_0") {
        columns.remove("COLOR_0");
    }
    let has_root_uv = columns.contains_key("_ROOT_UV");
    let mut attributes: Vec<(String, Attribute)> = Vec::new();
    for (written, Column { mut values, is_filled }) in columns {
        let mark = marks.get(&written);
        let mut name = mark.map_or_else(|| name_of(&written), |mark| mark.name.clone());
        if written == "TEXCOORD_0" && !has_root_uv && per_strand(&values, &found.offsets).is_some() {
            name = names::ROOT_UV.to_owned();
            if let Values::Vec2(uvs) = &mut values {
                uvs.iter_mut().for_each(|uv| *uv = Vec2::new(uv.x, 1.0 - uv.y));
            }
        }
        let wants_int = mark.is_some_and(|mark| mark.is_int)
            || [names::ID, names::GROUP, names::GUIDE].contains(&name.as_str());
        if wants_int && let Some(integers) = as_integers(&values) {
            values = Values::Int(integers);
        }
        if name.is_empty() || !fits(&name, &values) || attributes.iter().any(|(known, _)| *known == name) {
            unread.push(written);
            continue;
        }
        if is_filled {
            warnings.push(Warning::AttributePartly { format, name: name.clone() });
        }
        let of_strand = OF_STRANDS.contains(&name.as_str());
        let domain = mark.map_or(if of_strand { Domain::Strand } else { Domain::Vertex }, |mark| mark.domain);
        attributes.push((name, in_domain(values, domain, &found.offsets)));
    }
    unread.sort();
    let why = "a groom has no place for its kind of values";
    let told = |name| Warning::AttributeNotRead { name, why: why.to_owned() };
    warnings.extend(unread.into_iter().map(told));
    attributes
}

fn name_of(written: &str) -> String {
    match written {
        "COLOR_0" => names::COLOR.to_owned(),
        "ALPHA" => names::TRANSPARENCY.to_owned(),
        "_WIDTH" | "_RADIUS" => names::RADIUS.to_owned(),
        _ => match STANDARD.iter().find(|(_, file)| *file == written) {
            Some((name, _)) => (*name).to_owned(),
            None => written.strip_prefix('_').unwrap_or(written).to_lowercase(),
        },
    }
}

/// Whether the type is the one the name stands for.
fn fits(name: &str, values: &Values) -> bool {
    match name {
        names::RADIUS | names::TRANSPARENCY => matches!(values, Values::Float(_)),
        names::COLOR | names::VELOCITY => matches!(values, Values::Vec3(_)),
        names::ROOT_UV => matches!(values, Values::Vec2(_)),
        names::ID | names::GROUP | names::GUIDE => matches!(values, Values::Int(_)),
        _ => true,
    }
}

/// The numbers as integers, if every one of them is.
fn as_integers(values: &Values) -> Option<Vec<i32>> {
    let Values::Float(values) = values else { return None };
    let is_integer = |v: &f32| f64::from(*v as i32) == f64::from(*v);
    values.iter().all(is_integer).then(|| values.iter().map(|&v| v as i32).collect())
}

/// The attribute in `domain`, or per vertex where its values differ within a member of it.
fn in_domain(values: Values, domain: Domain, offsets: &[u32]) -> Attribute {
    let whole = [0, offsets.last().copied().unwrap_or(0)];
    let reduced = match domain {
        Domain::Groom => per_strand(&values, &whole),
        Domain::Strand => per_strand(&values, offsets),
        Domain::Vertex => None,
    };
    match reduced {
        Some(values) => Attribute { domain, values },
        None => Attribute { domain: Domain::Vertex, values },
    }
}

/// The first value of each range, if all in it are the same.
fn per_strand(values: &Values, offsets: &[u32]) -> Option<Values> {
    fn first<T: Copy + PartialEq>(values: &[T], offsets: &[u32]) -> Option<Vec<T>> {
        let mut firsts = Vec::with_capacity(offsets.len());
        for pair in offsets.windows(2) {
            let range = values.get(pair[0] as usize..pair[1] as usize)?;
            let first = *range.first()?;
            if range.iter().any(|value| *value != first) {
                return None;
            }
            firsts.push(first);
        }
        Some(firsts)
    }
    Some(match values {
        Values::Float(v) => Values::Float(first(v, offsets)?),
        Values::Vec2(v) => Values::Vec2(first(v, offsets)?),
        Values::Vec3(v) => Values::Vec3(first(v, offsets)?),
        Values::Int(v) => Values::Int(first(v, offsets)?),
    })
}
