//! PLY strands: hairutil's layout in all three storages, bare vertices, edges, and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::lies::{change_everywhere, cut_everywhere, told};
use crate::support::{any_groom, from_bytes, full_groom, set, to_bytes};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};
use groom_formats::{Format, FormatError, Loaded, ReadOptions, Warning, read_from};
use proptest::prelude::*;

const ASCII: &[u8] = include_bytes!("../golden/ascii.ply");
const LITTLE: &[u8] = include_bytes!("../golden/little.ply");
const BIG: &[u8] = include_bytes!("../golden/big.ply");
const BARE: &[u8] = include_bytes!("../golden/bare.ply");
const EDGES: &[u8] = include_bytes!("../golden/edges.ply");

#[test]
fn minus_zero_is_a_colour_of_its_own() {
    let mut groom = Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::X]).unwrap();
    set(&mut groom, names::COLOR, Domain::Vertex, Values::Vec3(vec![Vec3::new(-0.0, 1.0, 0.0), Vec3::ONE]));
    let (bytes, _) = to_bytes(Format::Ply, &groom).unwrap();
    let back = from_bytes(Format::Ply, &bytes).unwrap().groom;
    assert_eq!(crate::support::bits(&back), crate::support::bits(&groom));
}

proptest! {
    #[test]
    fn a_groom_comes_back_whole(groom in any_groom()) {
        let (bytes, warnings) = to_bytes(Format::Ply, &groom).unwrap();
        prop_assert_eq!(warnings, vec![]);
        let back = from_bytes(Format::Ply, &bytes).unwrap();
        prop_assert_eq!(crate::support::bits(&back.groom), crate::support::bits(&groom));
        prop_assert_eq!(back.groom.offsets(), groom.offsets());
        prop_assert_eq!(to_bytes(Format::Ply, &back.groom).unwrap().0, bytes);
    }

    #[test]
    fn any_header_is_read_or_refused(
        lines in prop::collection::vec(prop::sample::select(vec![
            "format ascii 1.0", "format binary_little_endian 1.0", "element vertex 2", "element strand 1",
            "element edge 1", "element groom 1", "element face 18446744073709551615", "property float x",
            "property double y", "property float z", "property uchar red", "property ushort nsegs",
            "property int vertex1", "property int vertex2", "property list uchar int vertex_indices",
            "property list int double q", "comment up_axis z", "property float a_x", "property float a_y",
        ]), 0..14),
        body in prop_oneof![
            prop::collection::vec(any::<u8>(), 0..200),
            "([0-9 \n.-]|nan|1e9){0,100}".prop_map(String::into_bytes),
        ],
    ) {
        let mut bytes = format!("ply\n{}\nend_header\n", lines.join("\n")).into_bytes();
        bytes.extend(body);
        let _ = from_bytes(Format::Ply, &bytes);
        let options = ReadOptions { points_per_strand: Some(2), ..ReadOptions::default() };
        let _ = read_from(Format::Ply, &bytes[..], "memory", &options);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = from_bytes(Format::Ply, &bytes);
    }
}

fn values<'a>(groom: &'a Groom, name: &str, domain: Domain) -> &'a Values {
    let attribute = groom.attribute(name).unwrap();
    assert_eq!(attribute.domain, domain, "{name}");
    &attribute.values
}

#[test]
fn hairutils_layout_is_read_in_every_storage() {
    for bytes in [ASCII, LITTLE, BIG] {
        let Loaded { groom, warnings, .. } = from_bytes(Format::Ply, bytes).unwrap();
        let what = "element `face`".to_owned();
        assert_eq!(warnings, [Warning::NotRead { format: Format::Ply, what, count: 1 }]);
        assert_eq!((groom.offsets(), groom.up_axis), (&[0, 3, 4][..], UpAxis::Y));
        assert_eq!(groom.positions()[2..], [Vec3::new(0.5, 2.0, 0.0), Vec3::new(1.0, 0.0, 0.25)]);
        let red = Vec3::new(1.0, 0.0, 0.2);
        let colors = vec![red, red, Vec3::ZERO, Vec3::Y];
        assert_eq!(values(&groom, names::COLOR, Domain::Vertex), &Values::Vec3(colors));
        let radii = vec![0.0, 0.125, 0.25, 0.375];
        assert_eq!(values(&groom, names::RADIUS, Domain::Vertex), &Values::Float(radii));
        assert_eq!(groom.attributes().count(), 2);
    }
}

#[test]
fn bare_vertices_need_the_points_of_a_strand() {
    let told = told(Format::Ply, BARE);
    assert!(told.contains("found 6 vertices and nothing that says which make a strand"), "{told}");
    assert!(told.contains("--points-per-strand"), "{told}");
    let with = |points| {
        let options = ReadOptions { points_per_strand: Some(points), ..ReadOptions::default() };
        read_from(Format::Ply, BARE, "memory", &options)
    };
    let groom = with(3).unwrap().groom;
    assert_eq!((groom.offsets(), groom.strand(1)[0]), (&[0, 3, 6][..], Vec3::new(3.0, 6.0, 0.0)));
    assert_eq!(values(&groom, names::TRANSPARENCY, Domain::Vertex), &Values::Float(vec![0.0; 6]));
    assert_eq!(groom.colors().unwrap().get(0, 0), Vec3::X);
    for points in [0, 4, 7] {
        let told = with(points).unwrap_err().to_string();
        assert!(told.contains("found 6 vertices, expected a multiple of"), "{told}");
    }
}

#[test]
fn edges_that_meet_are_strands() {
    let loaded = from_bytes(Format::Ply, EDGES).unwrap();
    assert_eq!((loaded.warnings, loaded.groom.offsets()), (vec![], &[0, 2, 5][..]));
    assert_eq!(loaded.groom.strand(0), [Vec3::X, Vec3::new(1.0, 1.0, 0.0)]);
    let quality = Values::Float(vec![1.0, 2.0, 0.5, 0.25, 0.125]);
    assert_eq!(values(&loaded.groom, "quality", Domain::Vertex), &quality);
    let text = String::from_utf8(EDGES.to_vec()).unwrap();
    let wrong = told(Format::Ply, text.replace("3 4\n", "3 5\n").as_bytes());
    assert!(wrong.contains("row 0 of the element `edge`: found the vertex 5, expected 0 to 4"), "{wrong}");
    let wrong = told(Format::Ply, text.replace("3 4\n", "-1 4\n").as_bytes());
    assert!(wrong.contains("found the vertex -1"), "{wrong}");
    // Two vertices used over and over.
    let many = 4000;
    let head = text.replace("element edge 3", &format!("element edge {many}"));
    let body = format!("{}{}", &head[..head.len() - 12], "0 1\n".repeat(many));
    assert!(told(Format::Ply, body.as_bytes()).contains("found strands of 8000 points on 5 vertices"));
}

#[test]
fn every_attribute_survives_in_its_own_place() {
    let mut groom = full_groom();
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.00254;
    set(&mut groom, "velocity", Domain::Vertex, Values::Vec3(vec![Vec3::new(0.1, 2.0, -3.0); 8]));
    set(&mut groom, "part_x", Domain::Strand, Values::Float(vec![0.5, 0.25, 0.75]));
    set(&mut groom, "x", Domain::Strand, Values::Int(vec![i32::MIN, -1, 4]));
    let (bytes, warnings) = to_bytes(Format::Ply, &groom).unwrap();
    let renamed = |name: &str, written: &str| {
        let (name, written) = (name.to_owned(), written.to_owned());
        Warning::AttributeRenamed { format: Format::Ply, name, written }
    };
    let (clump, part, x) =
        (renamed("clump weight", "clump_weight"), renamed("part_x", "part_x_"), renamed("x", "x_"));
    assert_eq!(warnings, [clump, part, x]);
    let back = from_bytes(Format::Ply, &bytes).unwrap();
    assert_eq!(back.warnings, []);
    for (name, written) in [("clump weight", "clump_weight"), ("part_x", "part_x_"), ("x", "x_")] {
        let attribute = groom.remove_attribute(name).unwrap();
        groom.set_attribute(written, attribute).unwrap();
    }
    assert_eq!(back.groom, groom);
    // What is asked for has the last word.
    let options =
        ReadOptions { up_axis: Some(UpAxis::Y), meters_per_unit: Some(2.0), ..ReadOptions::default() };
    let asked = read_from(Format::Ply, &bytes[..], "memory", &options).unwrap().groom;
    assert_eq!((asked.up_axis, asked.meters_per_unit), (UpAxis::Y, 2.0));
}

#[test]
fn constants_and_values_of_strands_stay_so() {
    let mut groom = Groom::new(vec![0, 2, 4], vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]).unwrap();
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.3)).unwrap();
    groom.set_attribute(names::COLOR, Attribute::constant_vec3(Vec3::new(0.1, 2.0, -1.0))).unwrap();
    let (bytes, warnings) = to_bytes(Format::Ply, &groom).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(from_bytes(Format::Ply, &bytes).unwrap().groom, groom);
    // As hairutil wants them, at the vertices: clamped bytes, diameters.
    let row = [&0.6_f32.to_le_bytes()[..], &[26, 255, 0]].concat();
    assert!(
        bytes.windows(row.len()).any(|window| window == row),
        "no thickness and colour behind the position"
    );
    set(&mut groom, names::COLOR, Domain::Strand, Values::Vec3(vec![Vec3::X, Vec3::splat(0.2)]));
    assert_eq!(from_bytes(Format::Ply, &to_bytes(Format::Ply, &groom).unwrap().0).unwrap().groom, groom);
}

#[test]
fn the_written_layout_is_hairutils() {
    let groom = from_bytes(Format::Ply, LITTLE).unwrap().groom;
    let (bytes, _) = to_bytes(Format::Ply, &groom).unwrap();
    let end = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let header = String::from_utf8(bytes[..end].to_vec()).unwrap();
    let expected = [
        "ply",
        "format binary_little_endian 1.0",
        concat!("comment Written by groomkit ", env!("CARGO_PKG_VERSION")),
        "comment up_axis y",
        "comment meters_per_unit 1",
        "element vertex 4",
        "property float x",
        "property float y",
        "property float z",
        "property float thickness",
        "property uchar red",
        "property uchar green",
        "property uchar blue",
        "element strand 2",
        "property ushort nsegs",
        "end_header",
    ];
    assert_eq!(header.lines().collect::<Vec<_>>(), expected);
    assert_eq!(bytes.len() - end, 4 * 19 + 2 * 2);
    assert_eq!(bytes[bytes.len() - 4..], [2, 0, 0, 0]);
}

#[test]
fn more_segments_than_a_ushort_are_refused() {
    let line = |points: usize| Groom::new(vec![0, points as u32], vec![Vec3::ZERO; points]).unwrap();
    assert!(to_bytes(Format::Ply, &line(65_536)).is_ok());
    let error = to_bytes(Format::Ply, &line(65_537)).unwrap_err();
    assert!(matches!(error, FormatError::TooLarge { found: 65_536, limit: 65_535, .. }), "{error}");
    let empty = Groom::new(vec![0], vec![]).unwrap();
    assert!(matches!(to_bytes(Format::Ply, &empty), Err(FormatError::Empty { .. })));
}

#[test]
fn lies_are_refused_in_their_place() {
    for bytes in [LITTLE, BIG] {
        cut_everywhere(Format::Ply, bytes);
        change_everywhere(Format::Ply, bytes);
    }
    // The last number of a text may be cut and be a number still.
    cut_everywhere(Format::Ply, &ASCII[..ASCII.len() - 3]);
    change_everywhere(Format::Ply, ASCII);
    let text = String::from_utf8(ASCII.to_vec()).unwrap();
    for (from, to, what) in [
        ("ply", "plx", "line 1: found `plx`, expected `ply`"),
        ("ascii", "base64", "line 2: found the format `base64`, expected ascii"),
        ("format ascii 1.0\n", "", "found no format"),
        (
            "vertex 4",
            "vertex 2147483648",
            "line 4: found 2147483648 rows of the element `vertex`, expected no more",
        ),
        ("vertex 4", "vertex -4", "line 4: found `-4` of the element `vertex`, expected a whole number"),
        ("float x", "half x", "line 5: found the type `half`"),
        ("float y", "float x", "line 6: found a second property `x`"),
        ("element face 1\n", "elements face\n", "found `elements face`"),
        ("element face 1", "element strand 1", "line 17: found a second `strand`"),
        ("property float x", "property float w", "found an element `vertex` without x, y and z"),
        ("list uchar", "list float", "found a list whose length is a float"),
        ("\n2\n0\n", "\n1\n0\n", "found nsegs that stand for 3 points, expected 4"),
        ("\n2\n0\n", "\n65535\n65535\n", "found nsegs that stand for 131072 points, expected 4"),
        ("\n2\n0\n", "\n2.5\n0\n", "line 25: found `2.5`, expected a whole number"),
        ("\n2\n0\n", "\n70000\n0\n", "line 25: found 70000, expected a number that fits 2 bytes"),
        ("255 0 51 0.25", "256 0 51 0.25", "line 22: found 256, expected a number that fits 1 bytes"),
        ("255 0 51 0.25", "255 0 51 -1", "row 1 of the element `vertex`: found the thickness -1"),
        ("0.5 2 0 0", "nan 2 0 0", "point 2: found the point NaN 2 0, expected finite numbers"),
        ("3 0 1 2 0.5", "-3 0 1 2 0.5", "line 29: found -3, expected a number that fits 1 bytes"),
        ("3 0 1 2 0.5", "9 0 1 2 0.5", "line 30: found the end of the file"),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        let told = told(Format::Ply, changed.as_bytes());
        assert!(told.contains(what), "{from} -> {to}: {told}");
    }
    for head in ["", "ply\n", "ply\nformat ascii 1.0\nend_header\n"] {
        told(Format::Ply, head.as_bytes());
    }
    let crlf = String::from_utf8(EDGES.to_vec()).unwrap().replace('\n', "\r\n");
    let expected = from_bytes(Format::Ply, EDGES).unwrap().groom;
    assert_eq!(from_bytes(Format::Ply, crlf.as_bytes()).unwrap().groom, expected);
}
