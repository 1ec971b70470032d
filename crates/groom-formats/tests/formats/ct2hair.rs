//! CT2Hair's `.bin`: its layout to the byte, and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::lies::{change_everywhere, cut_everywhere, told, with_u32};
use crate::support::{from_bytes, to_bytes};
use glam::Vec3;
use groom::{Domain, Values};
use groom_formats::{Format, Warning};
use proptest::prelude::*;

const LOCK: &[u8] = include_bytes!("../golden/lock.bin");

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = from_bytes(Format::Ct2Hair, &bytes);
    }
}

#[test]
fn the_layout_is_the_makers() {
    let loaded = from_bytes(Format::Ct2Hair, LOCK).unwrap();
    assert_eq!(loaded.warnings, [Warning::EmptyStrandsLeftOut { format: Format::Ct2Hair, strands: 1 }]);
    // The same points as in the .data file.
    let data = from_bytes(Format::Data, include_bytes!("../golden/lock.data")).unwrap().groom;
    assert_eq!((loaded.groom.offsets(), loaded.groom.positions()), (data.offsets(), data.positions()));
    let tangent = loaded.groom.attribute("tangent").unwrap();
    assert_eq!((tangent.domain, &tangent.values), (Domain::Vertex, &Values::Vec3(vec![Vec3::NEG_Y; 5])));
    let label = &loaded.groom.attribute("label").unwrap().values;
    assert_eq!(label, &Values::Float(vec![0.0, 0.0, 0.0, 2.0, 2.0]));
}

#[test]
fn zeros_are_no_attributes() {
    let mut plain = LOCK.to_vec();
    // The points of the first strand start at byte 8, those of the last after one more empty count.
    for start in (0..3).map(|i| 8 + 28 * i).chain((0..2).map(|i| 8 + 3 * 28 + 8 + 28 * i)) {
        plain[start + 12..start + 28].fill(0);
    }
    let groom = from_bytes(Format::Ct2Hair, &plain).unwrap().groom;
    assert_eq!(groom.attributes().map(|(name, _)| name).collect::<Vec<_>>(), ["id"]);
}

#[test]
fn lies_are_refused_at_their_byte() {
    cut_everywhere(Format::Ct2Hair, LOCK);
    change_everywhere(Format::Ct2Hair, LOCK);
    let told_of = |at, value| told(Format::Ct2Hair, &with_u32(LOCK, at, value));
    assert!(told_of(0, 1 << 31).contains("byte 0: found the number of strands -2147483648"));
    assert!(told_of(4, 6).contains("byte 4: found the number of points of strand 0 6, expected 0 to 5"));
    assert!(told_of(0, 3 << 24).contains("(3, were the file big endian"));
    let nan = told_of(8 + 28, f32::NAN.to_bits());
    assert!(nan.contains("byte 36 (strand 0): found the point NaN 1 0"), "{nan}");
}

#[test]
fn it_is_not_written() {
    let groom = from_bytes(Format::Ct2Hair, LOCK).unwrap().groom;
    let error = to_bytes(Format::Ct2Hair, &groom).unwrap_err().to_string();
    assert_eq!(error, "memory: bin can be read and not written");
}
