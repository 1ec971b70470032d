//! Small files for the tests.

use cyhair::{HairFile, Header};

/// A file with the arrays `bits` announces; `segments` are used with or without their array (without
/// it all strands get those of the first).
pub fn file(bits: u32, segments: &[u16]) -> HairFile {
    let announced = bits & 1 != 0;
    let default = segments[0];
    let counts = segments.iter().map(|&s| usize::from(if announced { s } else { default }) + 1);
    let points: usize = counts.sum();
    let mut header = Header {
        hair_count: segments.len() as u32,
        point_count: points as u32,
        arrays: bits,
        default_segments: default.into(),
        default_thickness: 0.25,
        default_transparency: 0.5,
        default_color: [0.1, 0.2, 0.3],
        ..Header::default()
    };
    header.set_info_text("made for a test");
    let value = |i: usize| i as f32 * 0.37 - 1.5;
    let triples = |shift: f32| (0..points).map(|i| [value(i), shift, value(i * 7)]).collect::<Vec<_>>();
    let floats = |shift: f32| (0..points).map(|i| value(i) + shift).collect::<Vec<_>>();
    let has = |bit: u32| bits & (1 << bit) != 0;
    HairFile {
        header,
        segments: announced.then(|| segments.to_vec()),
        points: has(1).then(|| triples(0.0)),
        thickness: has(2).then(|| floats(9.0)),
        transparency: has(3).then(|| floats(-2.0)),
        colors: has(4).then(|| triples(0.5)),
    }
}
