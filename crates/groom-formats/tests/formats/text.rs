//! Text: every bit survives, faults are found at their line and column.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::{any_groom, bits, from_bytes, full_groom, offsets, to_bytes};
use groom::{Attribute, Groom, UpAxis, Values, names};
use groom_formats::{Format, FormatError, ReadOptions, Warning, text};
use proptest::prelude::*;

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

/// Some megabytes of strands of all lengths, one of them longer than what one thread takes at a time, blank
/// lines in ones and twos.
fn long_text() -> (String, Vec<u32>) {
    let (mut text, mut offsets, mut points) = (String::new(), vec![0], 0);
    for strand in 0..4000_u32 {
        let length = if strand == 1500 { 50_000 } else { 1 + strand * strand % 29 };
        for i in 0..length {
            points += 1;
            text.push_str(&format!("{points} {}.{} -{i} 0.5\n", strand % 100, i * 7));
        }
        text.push_str(if strand % 7 == 0 { "\n \n" } else { "\n" });
        offsets.push(points);
    }
    (text, offsets)
}

/// Gives what it has in bits of odd lengths.
struct Trickle<'a>(&'a [u8]);

impl std::io::Read for Trickle<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = buffer.len().min(self.0.len()).min(77_777);
        let (now, later) = self.0.split_at(count);
        buffer[..count].copy_from_slice(now);
        self.0 = later;
        Ok(count)
    }
}

#[test]
fn long_files_are_read_alike_on_any_number_of_threads() {
    let (text, offsets) = long_text();
    assert!(text.len() > 2_000_000);
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        for whole in [true, false] {
            let read = || match whole {
                true => from_bytes(Format::Text, text.as_bytes()),
                false => text::read(Trickle(text.as_bytes()), "memory", &ReadOptions::default()),
            };
            let groom = pool.install(read).unwrap().groom;
            assert_eq!(groom.offsets(), offsets, "{threads} threads");
            let numbers = text.lines().filter_map(|line| line.split(' ').next().unwrap().parse::<f32>().ok());
            assert!(numbers.eq(groom.positions().iter().map(|p| p.x)));
        }
    }
}

#[test]
fn faults_far_into_a_file_are_placed() {
    let (text, _) = long_text();
    let lines: Vec<&str> = text.lines().collect();
    for at in [2, 9_999, 60_000, 100_000, lines.len()] {
        for (line, expected) in [("1 2 x 0.5", (5, "`x`")), ("1 2 3", (1, "3 numbers"))] {
            let mut bad = lines.clone();
            bad[at - 1] = line;
            // A later fault is not the one to tell.
            bad.push("y");
            match from_bytes(Format::Text, bad.join("\n").as_bytes()) {
                Err(FormatError::Text { line, column, found, .. }) => {
                    assert_eq!((line, (column, found.as_str())), (at as u64, expected));
                }
                other => panic!("{at}: {other:?}"),
            }
        }
    }
}

#[test]
fn a_long_line_far_into_a_file_is_refused() {
    let (mut text, _) = long_text();
    let line = text.lines().count() as u64 + 1;
    text.push_str(&"1".repeat(300_000));
    let error = from_bytes(Format::Text, text.as_bytes()).unwrap_err();
    assert!(error.to_string().contains(&format!("line {line}, column 1: found a line of over")), "{error}");
    // The last line a file may have, to the byte.
    let longest = format!("0 0 0 0.5\n0 0 0 {:>width$}", 0.5, width = (1 << 16) - 7);
    assert_eq!(groom(&longest).point_count(), 2);
    assert!(from_bytes(Format::Text, format!("{longest} ").as_bytes()).is_err());
}

#[test]
fn a_file_without_line_ends_does_not_fill_the_memory() {
    let endless = std::io::repeat(b'1');
    let error = text::read(endless, "endless", &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("a line of over"), "{error}");
}
