//! MonoHair's `.hair`: told from HAIR by its first bytes, read to the byte, and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::lies::{change_everywhere, cut_everywhere, told, with_u32};
use crate::support::{any_groom, from_bytes, to_bytes};
use groom_formats::{Format, FormatError, Warning};
use proptest::prelude::*;

const LOCK: &[u8] = include_bytes!("../golden/monohair.hair");

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = from_bytes(Format::MonoHair, &bytes);
        let _ = from_bytes(Format::Hair, &bytes);
    }

    #[test]
    fn hair_stays_hair(groom in any_groom()) {
        let (bytes, _) = to_bytes(Format::Hair, &groom).unwrap();
        prop_assert_eq!(Format::Hair.sniff(&bytes), Format::Hair);
    }
}

#[test]
fn the_layout_is_the_makers() {
    // Asked for as what its name says.
    let loaded = from_bytes(Format::Hair, LOCK).unwrap();
    assert_eq!((loaded.warnings, loaded.hair), (vec![], None));
    let data = from_bytes(Format::Data, include_bytes!("../golden/lock.data")).unwrap().groom;
    assert_eq!((loaded.groom.offsets(), loaded.groom.positions()), (data.offsets(), data.positions()));
    assert_eq!(from_bytes(Format::MonoHair, LOCK).unwrap().groom, loaded.groom);
}

#[test]
fn what_is_neither_keeps_the_message_of_hair() {
    // Text, Tungsten's fibers, a damaged magic.
    let (mut damaged, _) =
        to_bytes(Format::Hair, &from_bytes(Format::MonoHair, LOCK).unwrap().groom).unwrap();
    damaged[0] = b'h';
    let fiber = [b"\x80\xBF\x80FIBER".as_slice(), &[0; 16]].concat();
    for (bytes, what) in
        [(&b"0.5 0.25 1 0.1\n0.5 0.5 1 0.1\n"[..], "a text file"), (&fiber, "Tungsten"), (&damaged, "HAIR")]
    {
        let error = from_bytes(Format::Hair, bytes).unwrap_err();
        assert!(matches!(error, FormatError::Hair { .. }), "{error}");
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn empty_strands_are_left_out() {
    // Strands of 3, 0 and 2 points.
    let bytes = [&[3, 0, 0, 0], &LOCK[4..10], &[0, 0], &LOCK[10..]].concat();
    let loaded = from_bytes(Format::Hair, &bytes).unwrap();
    assert_eq!(loaded.warnings, [Warning::EmptyStrandsLeftOut { format: Format::MonoHair, strands: 1 }]);
    assert_eq!((loaded.groom.strand_id(0), loaded.groom.strand_id(1)), (0, 2));
}

#[test]
fn lies_are_refused_at_their_byte() {
    cut_everywhere(Format::MonoHair, LOCK);
    change_everywhere(Format::MonoHair, LOCK);
    let told_of = |at, value| told(Format::MonoHair, &with_u32(LOCK, at, value));
    assert!(told_of(0, 1 << 31).contains("byte 0: found the number of strands -2147483648"));
    assert!(told_of(0, 2 << 24).contains("(2, were the file big endian"));
    assert!(told_of(4, 1 << 31).contains("byte 4: found the number of points"));
    let sum = told_of(4, 4);
    assert!(sum.contains("byte 8: found point counts that add up to 5, expected 4"), "{sum}");
    assert!(sum.contains("without HAIR's magic"), "{sum}");
    let trailing = [LOCK, &[0, 1]].concat();
    let warnings = from_bytes(Format::Hair, &trailing).unwrap().warnings;
    assert_eq!(warnings, [Warning::TrailingBytes { offset: LOCK.len() as u64, bytes: 2 }]);
}
