//! Making a groom from pieces of another, attributes and all.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::{Attribute, Domain, Groom, Values};

/// A value at a place of the old groom: between vertex `from` and the next, `t` of the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Global index of a vertex.
    pub from: u32,
    /// 0 at that vertex, 1 at the next; 0 whenever it is the last of its strand.
    pub t: f32,
}

impl Place {
    /// Exactly at a vertex.
    pub(crate) fn at(vertex: usize) -> Self {
        // A groom's offsets are u32, so its vertices are.
        Place { from: vertex as u32, t: 0.0 }
    }

    fn mix<T: Copy>(self, values: &[T], mix: impl Fn(T, T, f32) -> T) -> T {
        let from = self.from as usize;
        if self.t == 0.0 { values[from] } else { mix(values[from], values[from + 1], self.t) }
    }

    fn float(self, values: &[f32]) -> f32 {
        self.mix(values, |a, b, t| a + (b - a) * t)
    }

    pub(crate) fn vec3(self, values: &[Vec3]) -> Vec3 {
        self.mix(values, |a, b, t| a + (b - a) * t)
    }
}

/// The groom whose strand `i` is made from old strand `strands[i]` and whose points are at `places`.
///
/// Per-vertex values are interpolated like the points, integers taken from the nearer vertex.
/// With `keep_ids`, strands get their old identity as an `id` attribute, so that what belongs to a
/// strand by its id stays with it.
pub(crate) fn gather(
    groom: &Groom,
    strands: &[u32],
    offsets: Vec<u32>,
    places: &[Place],
    keep_ids: bool,
) -> Groom {
    let mut attributes = BTreeMap::new();
    for (name, attribute) in groom.attributes() {
        attributes.insert(name.to_owned(), pick(attribute, strands, places));
    }
    // An id that is not per strand identifies none.
    if keep_ids && groom.attribute(crate::names::ID).is_none_or(|id| id.domain != Domain::Strand) {
        let ids = strands.iter().map(|&strand| strand as i32).collect();
        let attribute = Attribute { domain: Domain::Strand, values: Values::Int(ids) };
        attributes.insert(crate::names::ID.to_owned(), attribute);
    }
    let positions = places.iter().map(|place| place.vec3(groom.positions())).collect();
    groom.with_strands(offsets, positions, attributes)
}

fn pick(attribute: &Attribute, strands: &[u32], places: &[Place]) -> Attribute {
    let values = match attribute.domain {
        Domain::Groom => attribute.values.clone(),
        Domain::Strand => match &attribute.values {
            Values::Float(v) => Values::Float(take(v, strands)),
            Values::Vec2(v) => Values::Vec2(take(v, strands)),
            Values::Vec3(v) => Values::Vec3(take(v, strands)),
            Values::Int(v) => Values::Int(take(v, strands)),
        },
        Domain::Vertex => match &attribute.values {
            Values::Float(v) => Values::Float(places.iter().map(|p| p.float(v)).collect()),
            Values::Vec2(v) => {
                Values::Vec2(places.iter().map(|p| p.mix(v, |a, b, t| a + (b - a) * t)).collect())
            }
            Values::Vec3(v) => Values::Vec3(places.iter().map(|p| p.vec3(v)).collect()),
            Values::Int(v) => {
                Values::Int(places.iter().map(|p| p.mix(v, |a, b, t| if t < 0.5 { a } else { b })).collect())
            }
        },
    };
    Attribute { domain: attribute.domain, values }
}

fn take<T: Copy>(values: &[T], strands: &[u32]) -> Vec<T> {
    strands.iter().map(|&strand| values[strand as usize]).collect()
}
