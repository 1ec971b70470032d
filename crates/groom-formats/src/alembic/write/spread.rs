//! Attributes that readers want per vertex, and what they were before.

use groom::{Attribute, Domain, Groom, Values};

/// One value for every point.
pub(super) fn over_points<T: Copy>(groom: &Groom, domain: Domain, values: &[T]) -> Vec<T> {
    let mut spread = Vec::with_capacity(groom.point_count());
    match domain {
        Domain::Vertex => spread.extend_from_slice(values),
        Domain::Groom => {
            spread.extend(values.iter().take(1).flat_map(|&v| std::iter::repeat_n(v, groom.point_count())));
        }
        Domain::Strand => {
            for (points, &value) in groom.strands().zip(values) {
                spread.extend(std::iter::repeat_n(value, points.len()));
            }
        }
    }
    spread
}

/// The attribute with a value for every point.
pub(super) fn attribute(groom: &Groom, attribute: &Attribute) -> Attribute {
    let domain = attribute.domain;
    let values = match &attribute.values {
        Values::Float(values) => Values::Float(over_points(groom, domain, values)),
        Values::Vec2(values) => Values::Vec2(over_points(groom, domain, values)),
        Values::Vec3(values) => Values::Vec3(over_points(groom, domain, values)),
        Values::Int(values) => Values::Int(over_points(groom, domain, values)),
    };
    Attribute { domain: Domain::Vertex, values }
}
