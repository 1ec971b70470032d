//! Curves of several objects as one groom.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, Values, names};

use crate::{Format, FormatError, Warning};

/// An object's share of a groom.
pub(crate) struct Part {
    pub(crate) strand_lens: Vec<u32>,
    pub(crate) points: usize,
    pub(crate) attributes: BTreeMap<String, Attribute>,
}

/// Takes room for an attribute: its name, how many values it has, and their size; an error if there is not enough.
pub(crate) type Take<'a> = &'a dyn Fn(&str, usize, usize) -> Result<(), FormatError>;

/// The groom of all parts; where there are several and none says its groups, each is one. Attributes may get more
/// values than the parts have, which `take` is asked for.
pub(crate) fn groom(
    mut parts: Vec<Part>,
    positions: Vec<Vec3>,
    format: Format,
    file: &str,
    take: Take<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Groom, FormatError> {
    let mut offsets = vec![0_u32];
    let mut end = 0_u32;
    for len in parts.iter().flat_map(|part| &part.strand_lens) {
        end = end.checked_add(*len).ok_or_else(|| FormatError::TooLarge {
            file: file.to_owned(),
            format,
            what: "points",
            found: positions.len() as u64,
            limit: u32::MAX.into(),
        })?;
        offsets.push(end);
    }
    let mut groom = Groom::new(offsets, positions).map_err(|error| FormatError::groom(file, error))?;
    if parts.len() > 1 && parts.iter().all(|part| !part.attributes.contains_key(names::GROUP)) {
        for (index, part) in parts.iter_mut().enumerate() {
            let group = Attribute { domain: Domain::Groom, values: Values::Int(vec![index as i32]) };
            part.attributes.insert(names::GROUP.into(), group);
        }
    }
    let mut all: Vec<String> = parts.iter().flat_map(|part| part.attributes.keys().cloned()).collect();
    all.sort();
    all.dedup();
    for name in all {
        let fault = match joined(&mut parts, &name, take)? {
            Some(attribute) => groom.set_attribute(&*name, attribute).err().map(|error| error.to_string()),
            None => Some("its type differs from object to object".into()),
        };
        if let Some(why) = fault {
            warnings.push(Warning::AttributeNotRead { name, why });
        }
    }
    Ok(groom)
}

/// The attribute of all parts, in the narrowest domain that serves them; parts without it have nothing (the usual
/// radius, white). `None` if their types differ.
fn joined(parts: &mut [Part], name: &str, take: Take<'_>) -> Result<Option<Attribute>, FormatError> {
    if let [part] = parts {
        return Ok(part.attributes.remove(name));
    }
    let taken: Vec<Option<Attribute>> = parts.iter_mut().map(|part| part.attributes.remove(name)).collect();
    let Some(first) = taken.iter().flatten().next() else { return Ok(None) };
    let same = taken.iter().all(|attribute| attribute.as_ref() == Some(first));
    if same && first.domain == Domain::Groom {
        return Ok(Some(first.clone()));
    }
    let vertex = taken.iter().flatten().any(|attribute| attribute.domain == Domain::Vertex);
    let domain = if vertex { Domain::Vertex } else { Domain::Strand };
    let members = |part: &Part| if vertex { part.points } else { part.strand_lens.len() };
    take(name, parts.iter().map(members).sum(), value_size(&first.values))?;
    let mut values = match first.values {
        Values::Float(_) => Values::Float(Vec::new()),
        Values::Vec2(_) => Values::Vec2(Vec::new()),
        Values::Vec3(_) => Values::Vec3(Vec::new()),
        Values::Int(_) => Values::Int(Vec::new()),
    };
    for (part, attribute) in parts.iter().zip(&taken) {
        let missing = match (name, &values) {
            (names::RADIUS, _) => Values::Float(vec![groom::DEFAULT_RADIUS]),
            (names::COLOR, _) => Values::Vec3(vec![Vec3::ONE]),
            (_, Values::Float(_)) => Values::Float(vec![0.0]),
            (_, Values::Vec2(_)) => Values::Vec2(vec![Vec2::ZERO]),
            (_, Values::Vec3(_)) => Values::Vec3(vec![Vec3::ZERO]),
            (_, Values::Int(_)) => Values::Int(vec![0]),
        };
        let missing = Attribute { domain: Domain::Groom, values: missing };
        let attribute = attribute.as_ref().unwrap_or(&missing);
        match (&mut values, &attribute.values) {
            (Values::Float(to), Values::Float(from)) => extend(to, from, attribute.domain, domain, part),
            (Values::Vec2(to), Values::Vec2(from)) => extend(to, from, attribute.domain, domain, part),
            (Values::Vec3(to), Values::Vec3(from)) => extend(to, from, attribute.domain, domain, part),
            (Values::Int(to), Values::Int(from)) => extend(to, from, attribute.domain, domain, part),
            _ => return Ok(None),
        }
    }
    Ok(Some(Attribute { domain, values }))
}

/// Bytes of one value.
pub(crate) fn value_size(values: &Values) -> usize {
    match values {
        Values::Float(_) | Values::Int(_) => size_of::<f32>(),
        Values::Vec2(_) => size_of::<Vec2>(),
        Values::Vec3(_) => size_of::<Vec3>(),
    }
}

/// Adds a part's values, repeated where the domain is wider than theirs.
fn extend<T: Copy>(to: &mut Vec<T>, from: &[T], domain: Domain, wanted: Domain, part: &Part) {
    match (domain, wanted) {
        (Domain::Groom, Domain::Vertex) => to.extend(from.iter().cycle().take(part.points)),
        (Domain::Groom, _) => to.extend(from.iter().cycle().take(part.strand_lens.len())),
        (Domain::Strand, Domain::Vertex) => {
            let strands = from.iter().zip(&part.strand_lens);
            to.extend(strands.flat_map(|(value, &len)| std::iter::repeat_n(*value, len as usize)));
        }
        _ => to.extend_from_slice(from),
    }
}
