//! Grooms for the tests, bit by bit comparison.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)] // each test file uses some of it

pub mod lies;

use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Format, FormatError, Loaded, ReadOptions, Warning, WriteOptions};
use proptest::prelude::*;

/// A finite f32 of any magnitude.
pub fn finite() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |v| v.is_finite()),
        -10.0_f32..10.0,
        Just(-0.0),
    ]
}

/// A finite f32, 0 or more, that doubles to a finite one.
pub fn radius() -> impl Strategy<Value = f32> {
    finite().prop_map(|v| v.abs()).prop_filter("doubles", |v| (2.0 * v).is_finite())
}

pub fn vec3(number: impl Strategy<Value = f32>) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(number).prop_map(Vec3::from)
}

/// A groom of 1 to 8 strands of 1 to 5 points, radius, colour and transparency per vertex.
pub fn any_groom() -> impl Strategy<Value = Groom> {
    prop::collection::vec(1_usize..6, 1..9).prop_flat_map(|lengths| {
        let points = lengths.iter().sum::<usize>();
        let per_point = (
            prop::collection::vec(vec3(finite()), points),
            prop::collection::vec(radius(), points),
            prop::collection::vec(vec3(finite()), points),
            prop::collection::vec(finite(), points),
        );
        (Just(lengths), per_point).prop_map(|(lengths, (points, radii, colors, transparencies))| {
            let mut groom = Groom::new(offsets(&lengths), points).unwrap();
            set(&mut groom, names::RADIUS, Domain::Vertex, Values::Float(radii));
            set(&mut groom, names::COLOR, Domain::Vertex, Values::Vec3(colors));
            set(&mut groom, names::TRANSPARENCY, Domain::Vertex, Values::Float(transparencies));
            groom
        })
    })
}

pub fn offsets(lengths: &[usize]) -> Vec<u32> {
    let mut offsets = vec![0];
    for &length in lengths {
        offsets.push(offsets[offsets.len() - 1] + length as u32);
    }
    offsets
}

pub fn set(groom: &mut Groom, name: &str, domain: Domain, values: Values) {
    groom.set_attribute(name, Attribute { domain, values }).unwrap();
}

/// Strands of 3, 1 and 4 points with every standard attribute and a few others.
pub fn full_groom() -> Groom {
    let points = (0..8).map(|i| Vec3::new(i as f32 * 0.1, (i * i) as f32 * 0.01, -(i as f32))).collect();
    let mut groom = Groom::new(offsets(&[3, 1, 4]), points).unwrap();
    let ramp = |scale: f32| (0..8).map(|i| i as f32 * scale).collect::<Vec<_>>();
    set(&mut groom, names::RADIUS, Domain::Vertex, Values::Float(ramp(0.003)));
    let colors = vec![Vec3::X, Vec3::Y, Vec3::new(0.2, 0.4, 0.6)];
    set(&mut groom, names::COLOR, Domain::Strand, Values::Vec3(colors));
    set(&mut groom, names::TRANSPARENCY, Domain::Groom, Values::Float(vec![0.25]));
    set(&mut groom, names::ID, Domain::Strand, Values::Int(vec![7, -1, 9]));
    let uvs = vec![Vec2::ZERO, Vec2::ONE, Vec2::new(0.5, 0.25)];
    set(&mut groom, names::ROOT_UV, Domain::Strand, Values::Vec2(uvs));
    set(&mut groom, "clump weight", Domain::Vertex, Values::Float(ramp(1.0)));
    groom
}

pub fn to_bytes(format: Format, groom: &Groom) -> Result<(Vec<u8>, Vec<Warning>), FormatError> {
    let mut bytes = Vec::new();
    let warnings = groom_formats::write_to(format, groom, &mut bytes, "memory", &WriteOptions::default())?;
    Ok((bytes, warnings))
}

pub fn from_bytes(format: Format, bytes: &[u8]) -> Result<Loaded, FormatError> {
    let options = ReadOptions { known_len: Some(bytes.len() as u64), ..ReadOptions::default() };
    groom_formats::read_from(format, bytes, "memory", &options)
}

/// Everything HAIR and text hold of a groom, expanded per vertex, as bits.
pub fn bits(groom: &Groom) -> Vec<[u32; 8]> {
    let transparency = groom.attribute(names::TRANSPARENCY).and_then(Attribute::float_view);
    (0..groom.strand_count())
        .flat_map(|strand| groom.strand_range(strand).map(move |vertex| (strand, vertex)))
        .map(|(strand, vertex)| {
            let p = groom.positions()[vertex];
            let c = groom.colors().map_or(Vec3::ONE, |view| view.get(strand, vertex));
            let t = transparency.map_or(0.0, |view| view.get(strand, vertex));
            [p.x, p.y, p.z, groom.radii().get(strand, vertex), c.x, c.y, c.z, t].map(f32::to_bits)
        })
        .collect()
}
