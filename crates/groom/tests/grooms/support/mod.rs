//! Grooms for the tests.

use glam::{Vec3, Vec3Swizzles};
use groom::{Attribute, Domain, Groom, Values, names, random};
use proptest::prelude::*;

/// Grooms of 1 to 8 strands with 1 to 14 points anywhere, some of them in the same place, with a radius, a
/// velocity, an integer and the index of the point per vertex, and an id per strand.
pub fn grooms() -> impl Strategy<Value = Groom> {
    let coordinate = prop_oneof![4 => -10.0_f32..10.0, 1 => (-2_i8..3).prop_map(f32::from)];
    let strand = prop::collection::vec(prop::array::uniform3(coordinate), 1..15);
    (prop::collection::vec(strand, 1..9), 0.01_f32..2.0).prop_map(|(strands, radius)| {
        let strands: Vec<Vec<Vec3>> =
            strands.into_iter().map(|s| s.into_iter().map(Vec3::from).collect()).collect();
        let mut groom = from_strands(&strands);
        let count = groom.point_count();
        let vertex = |values| Attribute { domain: Domain::Vertex, values };
        let radii = (0..count).map(|i| radius * (1.0 + (i % 5) as f32)).collect();
        groom.set_attribute(names::RADIUS, vertex(Values::Float(radii))).unwrap();
        let velocities = groom.positions().iter().map(|p| p.zxy()).collect();
        groom.set_attribute(names::VELOCITY, vertex(Values::Vec3(velocities))).unwrap();
        groom.set_attribute("index", vertex(Values::Int((0..count as i32).collect()))).unwrap();
        let ids = (0..groom.strand_count() as i32).map(|i| i * 7 + 3).collect();
        groom
            .set_attribute(names::ID, Attribute { domain: Domain::Strand, values: Values::Int(ids) })
            .unwrap();
        groom
    })
}

pub fn from_strands(strands: &[Vec<Vec3>]) -> Groom {
    let mut offsets = vec![0];
    offsets.extend(strands.iter().scan(0, |end, strand| {
        *end += strand.len() as u32;
        Some(*end)
    }));
    Groom::new(offsets, strands.concat()).unwrap()
}

/// `strands` wavy strands of `points` points and length about 10 on a square of side 20.
pub fn wavy(strands: u32, points: usize) -> Groom {
    let strand = |id| {
        let number = |what| random(5, id, what);
        let root = Vec3::new(number("x") * 20.0, 0.0, number("z") * 20.0);
        let (wave, phase) = (number("wave"), number("phase") * 6.3);
        let point = |i| {
            let t = i as f32 / (points - 1) as f32 * 10.0;
            root + Vec3::new(wave * (t * 2.0 + phase).sin(), t, wave * (t * 1.7).cos())
        };
        (0..points).map(point).collect()
    };
    from_strands(&(0..strands).map(strand).collect::<Vec<_>>())
}

pub fn floats<'a>(groom: &'a Groom, name: &str) -> &'a [f32] {
    match &groom.attribute(name).unwrap().values {
        Values::Float(values) => values,
        _ => &[],
    }
}

pub fn vec3s<'a>(groom: &'a Groom, name: &str) -> &'a [Vec3] {
    match &groom.attribute(name).unwrap().values {
        Values::Vec3(values) => values,
        _ => &[],
    }
}

pub fn ints<'a>(groom: &'a Groom, name: &str) -> &'a [i32] {
    match &groom.attribute(name).unwrap().values {
        Values::Int(values) => values,
        _ => &[],
    }
}
