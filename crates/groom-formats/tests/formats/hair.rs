//! HAIR files through the groom and back come out with the same bytes.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::{any_groom, bits, finite, from_bytes, full_groom, offsets, radius, set, to_bytes};
use cyhair::{HairFile, Header};
use groom::{Domain, Groom, UpAxis, Values, names};
use groom_formats::{Format, FormatError, ReadOptions, Warning, WriteOptions};
use proptest::prelude::*;

/// Thickness that halves and doubles without a loss.
fn thickness() -> impl Strategy<Value = f32> {
    radius().prop_filter("halves", |v| v * 0.5 * 2.0 == *v)
}

prop_compose! {
    /// Any of the 16 combinations of arrays that have points, with any defaults.
    fn any_file()(lengths in prop::collection::vec(1_usize..6, 1..9), alike in any::<bool>())(
        points in prop::collection::vec(prop::array::uniform3(finite()), lengths.len() * 5),
        thick in prop::option::of(prop::collection::vec(thickness(), lengths.len() * 5)),
        clear in prop::option::of(prop::collection::vec(finite(), lengths.len() * 5)),
        colors in prop::option::of(prop::collection::vec(prop::array::uniform3(finite()), lengths.len() * 5)),
        defaults in (thickness(), finite(), prop::array::uniform3(finite())),
        info in prop::collection::vec(any::<u8>(), 88),
        segments_array in any::<bool>(),
        default_segments in any::<u32>(),
        lengths in Just(if alike { vec![lengths[0]; lengths.len()] } else { lengths }),
        ) -> HairFile {
        let count = lengths.iter().sum::<usize>();
        let cut = |mut values: Vec<f32>| { values.truncate(count); values };
        let cut3 = |mut values: Vec<[f32; 3]>| { values.truncate(count); values };
        let needs_array = segments_array || lengths.iter().any(|&length| length != lengths[0]);
        let header = Header {
            hair_count: lengths.len() as u32,
            default_segments: if needs_array { default_segments } else { lengths[0] as u32 - 1 },
            default_thickness: defaults.0,
            default_transparency: defaults.1,
            default_color: defaults.2,
            info: info.try_into().unwrap(),
            ..Header::default()
        };
        let mut file = HairFile {
            header,
            segments: needs_array.then(|| lengths.iter().map(|&length| length as u16 - 1).collect()),
            points: Some(cut3(points)),
            thickness: thick.map(cut),
            transparency: clear.map(cut),
            colors: colors.map(cut3),
        };
        file.sync_header();
        file
    }
}

proptest! {
    #[test]
    fn bytes_survive_the_groom(file in any_file()) {
        let bytes = file.to_bytes().unwrap();
        let loaded = from_bytes(Format::Hair, &bytes).unwrap();
        let mut again = Vec::new();
        let options = WriteOptions { hair: loaded.hair, ..WriteOptions::default() };
        groom_formats::write_to(Format::Hair, &loaded.groom, &mut again, "memory", &options).unwrap();
        prop_assert_eq!(again, bytes);
    }

    #[test]
    fn grooms_survive_the_bytes(groom in any_groom()) {
        let (bytes, _) = to_bytes(Format::Hair, &groom).unwrap();
        let back = from_bytes(Format::Hair, &bytes).unwrap().groom;
        prop_assert_eq!(back.offsets(), groom.offsets());
        prop_assert_eq!(bits(&back), bits(&groom));
    }
}

#[test]
fn thickness_is_a_diameter() {
    let header = Header { hair_count: 1, default_segments: 1, default_thickness: 0.25, ..Header::default() };
    let mut file = HairFile { header, points: Some(vec![[0.0; 3], [1.0; 3]]), ..HairFile::default() };
    file.sync_header();
    let constant = from_bytes(Format::Hair, &file.to_bytes().unwrap()).unwrap().groom;
    assert_eq!(constant.attribute(names::RADIUS).unwrap().domain, Domain::Groom);
    assert_eq!((constant.radii().get(0, 0), constant.up_axis), (0.125, UpAxis::Z));
    file.thickness = Some(vec![1.0, 0.5]);
    file.sync_header();
    let varying = from_bytes(Format::Hair, &file.to_bytes().unwrap()).unwrap().groom;
    assert_eq!(varying.attribute(names::RADIUS).unwrap().values, Values::Float(vec![0.5, 0.25]));
}

#[test]
fn values_per_strand_are_spread_over_the_points() {
    let mut groom = full_groom();
    set(&mut groom, names::RADIUS, Domain::Strand, Values::Float(vec![1.0, 2.0, 3.0]));
    let (bytes, warnings) = to_bytes(Format::Hair, &groom).unwrap();
    let file = HairFile::from_bytes(&bytes).unwrap().file;
    assert_eq!(file.thickness.unwrap(), [2.0, 2.0, 2.0, 4.0, 6.0, 6.0, 6.0, 6.0]);
    assert_eq!(file.colors.unwrap()[3], [0.0, 1.0, 0.0]);
    assert_eq!((file.transparency, file.header.default_transparency), (None, 0.25));
    assert_eq!(file.segments.unwrap(), [2, 0, 3]);
    assert!(warnings.contains(&Warning::AttributeLeftOut { format: Format::Hair, name: "id".into() }));
}

#[test]
fn oddities_come_back_as_warnings_and_are_mended_when_asked() {
    let header = Header { hair_count: 1, default_segments: 2, ..Header::default() };
    let points = Some(vec![[0.0; 3], [0.0; 3], [1.0; 3]]);
    let mut file = HairFile { header, points, ..HairFile::default() };
    file.sync_header();
    let mut bytes = file.to_bytes().unwrap();
    bytes.extend(b"more");
    let loaded = from_bytes(Format::Hair, &bytes).unwrap();
    assert_eq!((loaded.warnings.len(), loaded.repairs.len()), (2, 0));
    let options = ReadOptions { repair: true, ..ReadOptions::default() };
    let mended = groom_formats::read_from(Format::Hair, &bytes[..], "memory", &options).unwrap();
    assert!(!mended.repairs.is_empty() && mended.warnings.is_empty(), "{mended:?}");
}

#[test]
fn broken_and_impossible_files_are_told_apart() {
    let error = from_bytes(Format::Hair, b"HAIL").unwrap_err();
    assert!(
        matches!(error, FormatError::Hair { .. }) && error.to_string().starts_with("memory: "),
        "{error}"
    );
    let header = Header { hair_count: 1, default_segments: 1, point_count: 2, ..Header::default() };
    let file = HairFile { header, ..HairFile::default() };
    let error = from_bytes(Format::Hair, &file.to_bytes().unwrap()).unwrap_err();
    assert!(matches!(error, FormatError::Unsupported { .. }), "{error}");
    let empty = Groom::new(vec![0], vec![]).unwrap();
    assert!(matches!(to_bytes(Format::Hair, &empty), Err(FormatError::Empty { .. })));
    let long = Groom::new(offsets(&[1, 65_538]), vec![glam::Vec3::ZERO; 65_539]).unwrap();
    let error = to_bytes(Format::Hair, &long).unwrap_err();
    assert!(matches!(error, FormatError::TooLarge { found: 65_537, .. }), "{error}");
    let alone = Groom::new(offsets(&[65_538]), vec![glam::Vec3::ZERO; 65_538]).unwrap();
    assert!(to_bytes(Format::Hair, &alone).is_ok(), "the default has 32 bits");
}
