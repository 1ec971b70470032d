//! USC's `.data`: its layout to the byte, and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::lies::{change_everywhere, cut_everywhere, told, with_u32};
use crate::support::{any_groom, from_bytes, full_groom, to_bytes};
use groom::{Attribute, UpAxis, Values, names};
use groom_formats::{Format, FormatError, ReadOptions, Warning, read_from};
use proptest::prelude::*;

const LOCK: &[u8] = include_bytes!("../golden/lock.data");

proptest! {
    #[test]
    fn every_bit_of_the_points_survives(groom in any_groom()) {
        let (bytes, _) = to_bytes(Format::Data, &groom).unwrap();
        prop_assert_eq!(bytes.len(), 4 + 4 * groom.strand_count() + 12 * groom.point_count());
        let back = from_bytes(Format::Data, &bytes).unwrap();
        prop_assert_eq!(back.groom.offsets(), groom.offsets());
        let bits = |groom: &groom::Groom| {
            groom.positions().iter().flat_map(|p| p.to_array()).map(f32::to_bits).collect::<Vec<_>>()
        };
        prop_assert_eq!(bits(&back.groom), bits(&groom));
        prop_assert_eq!(to_bytes(Format::Data, &back.groom).unwrap().0, bytes);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = from_bytes(Format::Data, &bytes);
    }
}

#[test]
fn the_layout_is_the_makers() {
    let loaded = from_bytes(Format::Data, LOCK).unwrap();
    assert_eq!(loaded.warnings, [Warning::EmptyStrandsLeftOut { format: Format::Data, strands: 1 }]);
    let groom = loaded.groom;
    assert_eq!((groom.offsets(), groom.up_axis), (&[0, 3, 5][..], UpAxis::Y));
    assert_eq!(groom.strand(0)[2].to_array(), [0.5, 2.0, 0.0]);
    assert_eq!(groom.strand(1)[1].to_array(), [1.0, -1.0, 0.25]);
    let ids: Option<&Values> = groom.attribute(names::ID).map(|id: &Attribute| &id.values);
    assert_eq!(ids, Some(&Values::Int(vec![0, 2])));
    // Written again without the empty strand.
    let written = to_bytes(Format::Data, &groom).unwrap().0;
    assert_eq!(written, [&[2, 0, 0, 0], &LOCK[4..44], &LOCK[48..]].concat());
}

#[test]
fn odd_files_are_read_with_a_word() {
    let mut odd = LOCK.to_vec();
    // The second point of the first strand becomes its first again.
    odd.copy_within(8..20, 20);
    odd.extend([1, 2, 3]);
    let loaded = from_bytes(Format::Data, &odd).unwrap();
    let end = LOCK.len() as u64;
    assert_eq!(
        loaded.warnings[..],
        [
            Warning::TrailingBytes { offset: end, bytes: 3 },
            Warning::EmptyStrandsLeftOut { format: Format::Data, strands: 1 },
            Warning::ZeroLengthSegments { count: 1, first_point: 1 },
        ]
    );
    let repair = ReadOptions { repair: true, ..ReadOptions::default() };
    let mended = read_from(Format::Data, &odd[..], "memory", &repair).unwrap();
    assert_eq!((mended.groom.offsets(), mended.repairs.len()), (&[0, 2, 4][..], 1));
}

#[test]
fn points_that_are_no_numbers_are_placed() {
    let bad = with_u32(LOCK, 52 + 4, f32::NAN.to_bits());
    let told = told(Format::Data, &bad);
    assert!(
        told.starts_with("memory: byte 52 (strand 2): found the point 1 NaN 0.25, expected finite"),
        "{told}"
    );
    let repair = ReadOptions { repair: true, ..ReadOptions::default() };
    let mended = read_from(Format::Data, &bad[..], "memory", &repair).unwrap();
    assert_eq!(mended.groom.strand_count(), 1);
}

#[test]
fn lies_are_refused_at_their_byte() {
    cut_everywhere(Format::Data, LOCK);
    change_everywhere(Format::Data, LOCK);
    for (bytes, what) in [
        (with_u32(LOCK, 0, 1 << 31), "byte 0: found the number of strands -2147483648, expected 0 to"),
        (with_u32(LOCK, 0, u32::MAX), "byte 0: found the number of strands -1, expected 0 to"),
        (with_u32(LOCK, 0, 3 << 24), "(3, were the file big endian"),
        (
            with_u32(LOCK, 4, 1 << 30),
            "byte 4: found the number of points of strand 0 1073741824, expected 0 to 5",
        ),
        (vec![], "byte 0: found 0 bytes before the end of the file, expected 4 bytes: the number of strands"),
        (vec![0; 4], "found no strand with a point"),
        (vec![1, 0, 0, 0, 0, 0, 0, 0], "found no strand with a point"),
    ] {
        let told = told(Format::Data, &bytes);
        assert!(told.contains(what), "{told}");
    }
}

#[test]
fn what_data_cannot_hold_is_told() {
    let (_, warnings) = to_bytes(Format::Data, &full_groom()).unwrap();
    let format = Format::Data;
    let names = ["clump weight", "color", "id", "radius", "root_uv", "transparency"];
    let left_out = |name: &str| Warning::AttributeLeftOut { format, name: name.into() };
    assert_eq!(warnings, names.map(left_out));
    let empty = groom::Groom::new(vec![0], vec![]).unwrap();
    assert!(matches!(to_bytes(format, &empty), Err(FormatError::Empty { .. })));
}
