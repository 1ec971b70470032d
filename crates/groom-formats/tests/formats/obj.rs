//! Wavefront OBJ lines: what exporters write, every bit back, and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::lies::told;
use crate::support::{any_groom, from_bytes, full_groom, set, to_bytes};
use glam::Vec3;
use groom::{Domain, Groom, UpAxis, Values, names};
use groom_formats::{Format, FormatError, ReadOptions, Warning, read_from};
use proptest::prelude::*;

fn read(text: &str) -> Groom {
    from_bytes(Format::Obj, text.as_bytes()).unwrap().groom
}

proptest! {
    #[test]
    fn every_bit_of_points_and_colours_survives(groom in any_groom()) {
        let written = to_bytes(Format::Obj, &groom);
        if groom.strands().all(|strand| strand.len() < 2) {
            let is_empty = matches!(written, Err(FormatError::Empty { points: 2, .. }));
            prop_assert!(is_empty);
            return Ok(());
        }
        let bytes = written.unwrap().0;
        let back = from_bytes(Format::Obj, &bytes).unwrap().groom;
        let kept: Vec<usize> = (0..groom.strand_count()).filter(|&s| groom.strand(s).len() > 1).collect();
        prop_assert_eq!(back.strand_count(), kept.len());
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        for (strand, &old) in kept.iter().enumerate() {
            for (vertex, from) in back.strand_range(strand).zip(groom.strand_range(old)) {
                prop_assert_eq!(bits(back.positions()[vertex]), bits(groom.positions()[from]));
                let (color, old_color) = (back.colors().unwrap(), groom.colors().unwrap());
                prop_assert_eq!(bits(color.get(strand, vertex)), bits(old_color.get(old, from)));
            }
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = from_bytes(Format::Obj, &bytes);
    }

    #[test]
    fn any_statements_are_read_or_refused(
        lines in prop::collection::vec("(v|l|f|p|#|\\\\)?( |\t)?([0-9/.-]|e| |\\\\|nan){0,12}\r?", 0..20),
    ) {
        let text = format!("v 0 0 0\nv 1 1 1\n{}\n", lines.join("\n"));
        if let Ok(loaded) = from_bytes(Format::Obj, text.as_bytes()) {
            prop_assert!(loaded.groom.positions().iter().all(|p| p.is_finite()));
        }
    }
}

#[test]
fn strands_are_lines() {
    let groom = read(
        "o hair\nv 0 0 0\nv 0 1 0 1\nv 0 2 0\nvt 0 1\nv 5 0 0\nv 5 1 0\ng a\ns off\nl 1/1 2/1 3\nl -2 -1\n",
    );
    assert_eq!((groom.offsets(), groom.up_axis, groom.meters_per_unit), (&[0, 3, 5][..], UpAxis::Y, 1.0));
    assert_eq!(groom.strand(1), [Vec3::new(5.0, 0.0, 0.0), Vec3::new(5.0, 1.0, 0.0)]);
    assert!(groom.colors().is_none());
    // Vertices may come later, be shared and left out; lines go on.
    let groom = read("l 3 \\\n 1\\\r\n2\r\nl 1 3 2\nv 0 0 0\r\nv 1 0 0\nv 2 0 0\nv 9 9 9");
    assert_eq!(groom.positions().iter().map(|p| p.x).collect::<Vec<_>>(), [2.0, 0.0, 1.0, 0.0, 2.0, 1.0]);
}

#[test]
fn lines_of_two_that_meet_are_joined() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\n";
    // As Blender and MeshLab write edges of a mesh.
    let groom = read(&format!("{vertices}l 1 2\nl 2 3\nl 4 5\n"));
    assert_eq!(groom.offsets(), [0, 3, 5]);
    let groom = read(&format!("{vertices}l 1 2 3\nl 3 4\nl 4 5\n"));
    assert_eq!(groom.offsets(), [0, 3, 6], "a strand that was given whole is whole");
}

#[test]
fn colours_are_read_where_there_are_some() {
    let groom = read("v 0 0 0\nv 1 0 0 0.5 0.25 0\nv 2 0 0 1 0.1 0.2 0.3\nl 1 2 3\n");
    let colors = vec![Vec3::ONE, Vec3::new(0.5, 0.25, 0.0), Vec3::new(0.1, 0.2, 0.3)];
    let found = groom.attribute(names::COLOR).unwrap();
    assert_eq!((found.domain, &found.values), (Domain::Vertex, &Values::Vec3(colors)));
    let groom = read("v 0 0 0 0 0 1\nv 1 0 0\nl 1 2\nv 3 3 3\n");
    assert_eq!(groom.colors().unwrap().get(0, 1), Vec3::ONE);
}

#[test]
fn what_is_no_strand_is_told() {
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 3 2 1\np 1\ncurv 0 1 1 2\nl 1 2\n";
    let loaded = from_bytes(Format::Obj, text.as_bytes()).unwrap();
    let not_read = |what: &str, count| Warning::NotRead { format: Format::Obj, what: what.into(), count };
    let expected = [not_read("faces", 2), not_read("points (`p`)", 1), not_read("statements `curv`", 1)];
    assert_eq!(loaded.warnings, expected);
}

#[test]
fn the_layout_is_as_documented() {
    let mut groom = read("v 0 0 0\nv 1 2.5 -3\nl 1 2\nv 0.1 0 0\nv 1e-7 0 0\nv 1 1 1\nl 3 4 5\n");
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.01;
    set(&mut groom, names::COLOR, Domain::Strand, Values::Vec3(vec![Vec3::X, Vec3::splat(0.5)]));
    let (bytes, warnings) = to_bytes(Format::Obj, &groom).unwrap();
    let format = Format::Obj;
    assert_eq!(warnings, [Warning::UpAxisNotStored { format, usual: UpAxis::Y, groom: UpAxis::Z }]);
    let expected = format!(
        "# Written by groomkit {}\n# up_axis z\n# meters_per_unit 0.01\nv 0 0 0 1 0 0\nv 1 2.5 -3 1 0 0\nl 1 2\n\
         v 0.1 0 0 0.5 0.5 0.5\nv 1e-7 0 0 0.5 0.5 0.5\nv 1 1 1 0.5 0.5 0.5\nl 3 4 5\n",
        env!("CARGO_PKG_VERSION")
    );
    assert_eq!(String::from_utf8(bytes.clone()).unwrap(), expected);
    let back = from_bytes(Format::Obj, &bytes).unwrap().groom;
    assert_eq!((back.up_axis, back.meters_per_unit), (UpAxis::Z, 0.01));
    let options =
        ReadOptions { up_axis: Some(UpAxis::Y), meters_per_unit: Some(2.0), ..ReadOptions::default() };
    let asked = read_from(format, &bytes[..], "memory", &options).unwrap().groom;
    assert_eq!((asked.up_axis, asked.meters_per_unit), (UpAxis::Y, 2.0));
}

#[test]
fn what_obj_cannot_hold_is_told() {
    let (bytes, warnings) = to_bytes(Format::Obj, &full_groom()).unwrap();
    let format = Format::Obj;
    let left_out = |name: &str| Warning::AttributeLeftOut { format, name: name.into() };
    let mut expected = vec![Warning::OnePointStrandsLeftOut { format, strands: 1 }];
    expected.extend(["clump weight", "id", "radius", "root_uv", "transparency"].map(left_out));
    assert_eq!(warnings, expected);
    assert_eq!(from_bytes(format, &bytes).unwrap().groom.offsets(), [0, 3, 7]);
}

#[test]
fn many_strands_keep_their_numbers() {
    // More than a block of text, with a strand across the border.
    let points: Vec<Vec3> = (0..5000).map(|i| Vec3::new(i as f32, 0.5, -0.25)).collect();
    let offsets = (0..=1000).map(|i| 5 * i).collect();
    let groom = Groom::new(offsets, points).unwrap();
    let back = from_bytes(Format::Obj, &to_bytes(Format::Obj, &groom).unwrap().0).unwrap().groom;
    assert!(back == groom);
}

#[test]
fn faults_are_placed() {
    for (text, what) in [
        ("", "the whole file: found 0 vertices and no line, expected at least one `l`"),
        ("v 0 0 0\nf 1 1 1\n", "found 1 vertices and no line"),
        ("v 0 0\n", "line 1: found a vertex of 2 numbers, expected x y z [w] or x y z r g b"),
        ("v 0 0 0 1 1\n", "line 1: found a vertex of 5 numbers"),
        ("v 0 0 0 1 1 1 1 1\n", "line 1: found a vertex of 8 numbers"),
        ("\n\nv 0 x 0\n", "line 3: found `x`, expected a number"),
        ("v 0 0 0\nl 1\n", "line 2: found a line of less than two vertices"),
        (
            "v 0 0 0\nl 1 2\n",
            "line 2: found the vertex 2, expected 1 to 1, a vertex of the file, or -1 to -1",
        ),
        ("v 0 0 0\nl 0 1\n", "line 2: found the vertex 0"),
        ("v 0 0 0\nl -2 1\n", "line 2: found the vertex -2"),
        ("v 0 0 0\nl 1 -9223372036854775808\n", "line 2: found the vertex -9223372036854775808"),
        ("v 0 0 0\nl 1 9223372036854775807\n", "line 2: found the vertex 9223372036854775807"),
        ("v 0 0 0\nl 1 a/b\n", "line 2: found `a/b`, expected the number of a vertex"),
        ("v 0 0 0\nv 0 \\\ninf 0\nl 1 2\n", "vertex 2: found the point 0 inf 0, expected finite numbers"),
    ] {
        let told = told(Format::Obj, text.as_bytes());
        assert!(told.contains(what), "{text:?}: {told}");
    }
    // One vertex over and over: two bytes of text for twelve of memory.
    let many = format!("v 0 0 0\nl{}\n", " 1".repeat(10_000));
    assert!(told(Format::Obj, many.as_bytes()).contains("found strands of 10000 points on 1 vertices"));
    // Cut anywhere, a text is read or refused.
    let text = "v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nl 1 2\nf 1 2 1\n";
    (0..text.len()).for_each(|length| drop(from_bytes(Format::Obj, &text.as_bytes()[..length])));
}
