//! Text: every bit survives, faults are found at their line and column.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

mod support;

use groom::{Attribute, Groom, UpAxis, Values, names};
use groom_formats::{Format, FormatError, ReadOptions, Warning, text};
use proptest::prelude::*;
use support::{any_groom, bits, from_bytes, full_groom, offsets, to_bytes};

proptest! {
    #[test]
    fn text_keeps_every_bit(groom in any_groom()) {
        let (bytes, _) = to_bytes(Format::Text, &groom).unwrap();
        let back = from_bytes(Format::Text, &bytes).unwrap();
        prop_assert!(back.warnings.is_empty());
        prop_assert_eq!(back.groom.offsets(), groom.offsets());
        prop_assert_eq!(bits(&back.groom), bits(&groom));
        // What was read is written the same.
        prop_assert_eq!(to_bytes(Format::Text, &back.groom).unwrap().0, bytes);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = from_bytes(Format::Text, &bytes);
    }

    #[test]
    fn any_words_are_read_or_refused(words in "([ \t\r\n]|[0-9.eE+-]|nan|inf){0,120}") {
        if let Ok(loaded) = from_bytes(Format::Text, words.as_bytes()) {
            prop_assert!(loaded.groom.positions().iter().all(|p| p.is_finite()));
        }
    }
}

fn groom(text: &str) -> Groom {
    from_bytes(Format::Text, text.as_bytes()).unwrap().groom
}

#[test]
fn layout_is_as_documented() {
    let mut groom = groom("0 0 0 0.5\n1 2.5 -3 0.25\n\n0 0 1 0.5\n");
    let text = |groom: &Groom| String::from_utf8(to_bytes(Format::Text, groom).unwrap().0).unwrap();
    assert_eq!(text(&groom), "0 0 0 0.5\n1 2.5 -3 0.25\n\n0 0 1 0.5\n");
    groom.set_attribute(names::COLOR, Attribute::constant_vec3([1.0, 0.5, 0.0].into())).unwrap();
    assert!(text(&groom).starts_with("0 0 0 0.5 1 0.5 0\n1 2.5 "));
    groom.set_attribute(names::TRANSPARENCY, Attribute::constant_float(0.0)).unwrap();
    assert!(text(&groom).starts_with("0 0 0 0.5 1 0.5 0\n"), "opaque needs no column");
    groom.set_attribute(names::TRANSPARENCY, Attribute::constant_float(0.125)).unwrap();
    assert!(text(&groom).starts_with("0 0 0 0.5 1 0.5 0 0.125\n"));
}

#[test]
fn threads_change_nothing() {
    // Strands longer and shorter than what one thread takes at a time.
    let lengths: Vec<usize> = (0..300).map(|i| 1 + (i * i * 7) % 97).chain([20_000, 1, 1024, 3]).collect();
    let points = lengths.iter().sum::<usize>();
    let position = |i: usize| glam::Vec3::new(i as f32 * 0.37, 1.0 / (i % 99 + 1) as f32, -(i as f32));
    let mut groom = Groom::new(offsets(&lengths), (0..points).map(position).collect()).unwrap();
    let colors = (0..lengths.len()).map(|i| glam::Vec3::splat(i as f32 / 7.0)).collect();
    let domain = groom::Domain::Strand;
    groom.set_attribute(names::COLOR, Attribute { domain, values: Values::Vec3(colors) }).unwrap();
    let mut expected = String::new();
    for (strand, points) in groom.strands().enumerate() {
        expected.push_str(if strand > 0 { "\n" } else { "" });
        for p in points {
            let c = strand as f32 / 7.0;
            expected.push_str(&format!("{} {} {} 0.5 {c} {c} {c}\n", p.x, p.y, p.z));
        }
    }
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let bytes = pool.install(|| to_bytes(Format::Text, &groom).unwrap().0);
        assert!(bytes == expected.as_bytes(), "{threads} threads");
    }
}

#[test]
fn what_text_cannot_hold_is_told() {
    let mut groom = full_groom();
    groom.meters_per_unit = 0.01;
    groom.remove_attribute(names::COLOR);
    let (_, warnings) = to_bytes(Format::Text, &groom).unwrap();
    let format = Format::Text;
    let left_out = |name: &str| Warning::AttributeLeftOut { format, name: name.into() };
    assert_eq!(
        warnings,
        [
            Warning::UpAxisNotStored { format, usual: UpAxis::Z, groom: UpAxis::Y },
            Warning::UnitNotStored { format, meters_per_unit: 0.01 },
            left_out("clump weight"),
            left_out("id"),
            left_out("root_uv"),
            Warning::ColorMadeUp { format },
        ]
    );
}

#[test]
fn loose_layouts_are_read() {
    let expected = groom("0 0 0 1\n0 1 0 1\n\n2 0 0 1\n");
    let crlf = "0 0 0 1\r\n0 1 0 1\r\n\r\n2 0 0 1\r\n";
    let blanks = "\n \n  0 0\t0 1  \n0 1 0 +1.0e0\n\n\n \t\n2 0 0 1";
    let marked = "\u{feff}0 0 0 1\n0 1 0 1\n\n2 0 0 1\n";
    for text in [crlf, blanks, marked] {
        let loaded = from_bytes(Format::Text, text.as_bytes()).unwrap();
        assert_eq!((loaded.groom, loaded.warnings), (expected.clone(), vec![]), "{text:?}");
    }
    let bare = from_bytes(Format::Text, b"0 0 0\n0 1 0\n").unwrap();
    assert_eq!(bare.warnings, [Warning::NoRadius { radius: 0.5 }]);
    assert_eq!(bare.groom.radii().get(0, 1), 0.5);
    let wide = from_bytes(Format::Text, b"\n0 0 0 1 .1 .2 .3 .4 5 6\n").unwrap();
    assert_eq!(wide.warnings, [Warning::ExtraColumns { line: 2, found: 10, used: 8 }]);
    let two_more = from_bytes(Format::Text, b"0 0 0 1 9 9\n").unwrap();
    assert_eq!(two_more.warnings, [Warning::ExtraColumns { line: 1, found: 6, used: 4 }]);
    assert!(two_more.groom.colors().is_none());
}

#[test]
fn up_and_unit_come_from_the_options() {
    let options =
        ReadOptions { up_axis: Some(UpAxis::Y), meters_per_unit: Some(0.01), ..ReadOptions::default() };
    let loaded = text::read(&b"0 0 0 1\n"[..], "memory", &options).unwrap();
    assert_eq!((loaded.groom.up_axis, loaded.groom.meters_per_unit), (UpAxis::Y, 0.01));
    assert_eq!(groom("0 0 0 1\n").up_axis, UpAxis::Z);
}

#[test]
fn faults_are_placed() {
    let cases: [(&str, u64, usize, &str); 16] = [
        ("", 1, 1, "no point"),
        ("\n\n", 2, 1, "no point"),
        ("# hair\n", 1, 1, "`#`"),
        ("0 0 0 1\n0 x 0 1\n", 2, 3, "`x`"),
        ("0 0 0 1\n0 0 nan 1\n", 2, 5, "`nan`"),
        ("0 0 1e39 1\n", 1, 5, "`1e39`"),
        ("0 0 1e400 1\n", 1, 5, "`1e400`"),
        ("0 0 infinity 1\n", 1, 5, "`infinity`"),
        ("0 0 0 1\r0 0 1 1\r", 1, 7, "`1\\r0`"),
        ("0 0 0 1\n\u{feff}0 0 1 1\n", 2, 1, "`\\u{feff}0`"),
        ("0 0 0x10 1\n", 1, 5, "`0x10`"),
        ("0 0\n", 1, 1, "2 numbers"),
        ("0 0 0 1\n\n0 0 0\n", 3, 1, "3 numbers"),
        ("0,0,0,1\n", 1, 1, "`0,0,0,1`"),
        ("0 0 0 -1\n", 1, 1, "a radius of -1"),
        ("0 0 0 \u{fe}\n", 1, 7, "`\u{fe}`"),
    ];
    for (text, at_line, at_column, what) in cases {
        match from_bytes(Format::Text, text.as_bytes()) {
            Err(FormatError::Text { line, column, found, .. }) => {
                assert_eq!((line, column, found.as_str()), (at_line, at_column, what), "{text:?}");
            }
            other => panic!("{text:?}: {other:?}"),
        }
    }
    let told = from_bytes(Format::Text, b"0 0 0 1\n0 x 0 1\n").unwrap_err().to_string();
    assert_eq!(told, "memory: line 2, column 3: found `x`, expected a number");
}

#[test]
fn a_file_without_line_ends_does_not_fill_the_memory() {
    let endless = std::io::repeat(b'1');
    let error = text::read(endless, "endless", &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("a line of over"), "{error}");
}
