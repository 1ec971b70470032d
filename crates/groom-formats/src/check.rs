//! Values no file should hold, refused before the first byte is written.

use groom::{FloatView, Groom, Vec3View, names};

use crate::FormatError;

const FINITE: &str = "a finite number";
const RADIUS: &str = "a finite number, 0 or more";

/// Refuses positions, radii, colours and transparencies that are not finite, and negative radii.
pub(crate) fn values(groom: &Groom, file: &str) -> Result<(), FormatError> {
    let check = Check { groom, file };
    for (vertex, point) in groom.positions().iter().enumerate() {
        if !point.is_finite() {
            return check.fault("position", Place::Vertex(vertex), first_bad(point.to_array()), FINITE);
        }
    }
    check.floats(names::RADIUS, RADIUS, |v| v.is_finite() && v >= 0.0)?;
    check.floats(names::TRANSPARENCY, FINITE, f32::is_finite)?;
    check.colors()
}

struct Check<'a> {
    groom: &'a Groom,
    file: &'a str,
}

/// Where a value sits in its attribute.
enum Place {
    Groom,
    Strand(usize),
    Vertex(usize),
}

impl Check<'_> {
    fn floats(
        &self,
        what: &'static str,
        expected: &'static str,
        good: fn(f32) -> bool,
    ) -> Result<(), FormatError> {
        let bad = |values: &[f32]| values.iter().position(|&v| !good(v)).map(|i| (i, values[i]));
        let found = match self.groom.attribute(what).and_then(groom::Attribute::float_view) {
            Some(FloatView::Constant(value)) => bad(&[value]).map(|(_, v)| (Place::Groom, v)),
            Some(FloatView::Strand(values)) => bad(values).map(|(i, v)| (Place::Strand(i), v)),
            Some(FloatView::Vertex(values)) => bad(values).map(|(i, v)| (Place::Vertex(i), v)),
            None => None,
        };
        found.map_or(Ok(()), |(place, value)| self.fault(what, place, value, expected))
    }

    fn colors(&self) -> Result<(), FormatError> {
        let bad = |values: &[glam::Vec3]| {
            values.iter().position(|v| !v.is_finite()).map(|i| (i, first_bad(values[i].to_array())))
        };
        let found = match self.groom.colors() {
            Some(Vec3View::Constant(value)) => bad(&[value]).map(|(_, v)| (Place::Groom, v)),
            Some(Vec3View::Strand(values)) => bad(values).map(|(i, v)| (Place::Strand(i), v)),
            Some(Vec3View::Vertex(values)) => bad(values).map(|(i, v)| (Place::Vertex(i), v)),
            None => None,
        };
        found.map_or(Ok(()), |(place, value)| self.fault(names::COLOR, place, value, FINITE))
    }

    fn fault(
        &self,
        what: &'static str,
        place: Place,
        found: f32,
        expected: &'static str,
    ) -> Result<(), FormatError> {
        let offsets = self.groom.offsets();
        let (strand, vertex) = match place {
            Place::Groom => (0, 0),
            Place::Strand(strand) => (strand, offsets[strand] as usize),
            Place::Vertex(vertex) => (offsets.partition_point(|&o| o as usize <= vertex) - 1, vertex),
        };
        Err(FormatError::Value { file: self.file.to_owned(), what, strand, vertex, found, expected })
    }
}

/// The first component that is not finite.
fn first_bad(values: [f32; 3]) -> f32 {
    values.into_iter().find(|v| !v.is_finite()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use groom::{Attribute, Domain, Values};

    use super::*;

    fn groom() -> Groom {
        Groom::new(vec![0, 2, 5], vec![Vec3::ZERO; 5]).unwrap()
    }

    fn told(groom: &Groom) -> String {
        values(groom, "a.txt").unwrap_err().to_string()
    }

    #[test]
    fn bad_values_are_named_with_their_place() {
        assert!(values(&groom(), "").is_ok());
        let mut bad = groom();
        bad.positions_mut()[3].y = f32::NAN;
        assert_eq!(told(&bad), "a.txt: position of point 3 (strand 1) is NaN, expected a finite number");
        let mut bad = groom();
        let radii = Attribute { domain: Domain::Strand, values: Values::Float(vec![1.0, -1.0]) };
        bad.set_attribute(names::RADIUS, radii).unwrap();
        assert!(told(&bad).starts_with("a.txt: radius of point 2 (strand 1) is -1, expected"));
        let mut bad = groom();
        bad.set_attribute(names::COLOR, Attribute::constant_vec3(Vec3::new(0.0, 1.0, f32::INFINITY)))
            .unwrap();
        assert!(told(&bad).contains("color of point 0 (strand 0) is inf"));
    }
}
