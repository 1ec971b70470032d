//! Streaming gives the bytes, the warnings and the faults of reading and writing whole grooms.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use std::io::Write;
use std::path::{Path, PathBuf};

use cyhair::{Field, HairFile, Header};
use glam::Vec3;
use groom::{Attribute, UpAxis, names};
use groom_formats::{
    FormatError, ReadOptions, Warning, WriteOptions, convert_streaming, convert_streaming_with, read, write,
};
use proptest::prelude::*;

/// Every format that takes strands in pieces.
const TARGETS: [&str; 4] = ["hair", "txt", "data", "ply"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Odd and even numbers, some doubled, no two arrays alike.
fn file(arrays: u32, segments: &[u16]) -> HairFile {
    let points = segments.iter().map(|&s| usize::from(s) + 1).sum::<usize>();
    let number = |i: usize| (i as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32);
    let floats = |by: usize| (0..points).map(|i| number(i * 3 + by)).collect::<Vec<_>>();
    let triples =
        |by: usize| (0..points).map(|i| [0, 1, 2].map(|k| number(i * 7 + k + by))).collect::<Vec<_>>();
    let has = |field: Field| arrays & field.bit() != 0;
    let mut file = HairFile {
        header: Header { default_segments: segments[0].into(), ..Header::default() },
        segments: has(Field::Segments).then(|| segments.to_vec()),
        points: Some(triples(0)),
        thickness: has(Field::Thickness).then(|| floats(0)),
        transparency: has(Field::Transparency).then(|| floats(1)),
        colors: has(Field::Colors).then(|| triples(1)),
    };
    file.sync_header();
    file.header.hair_count = segments.len() as u32;
    file.header.set_info_text("kept");
    file
}

/// Converts both ways and compares; returns the bytes.
fn check(input: &Path, target: &str, options: &ReadOptions) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let (whole, streamed) = (folder.path().join("whole"), folder.path().join("streamed"));
    let (whole, streamed) = (whole.with_extension(target), streamed.with_extension(target));
    let loaded = read(input, options).unwrap();
    let write_options = WriteOptions { hair: loaded.hair, ..WriteOptions::default() };
    let lost = write(&loaded.groom, &whole, &write_options).unwrap();
    let done = convert_streaming(input, &streamed, options, &WriteOptions::default()).unwrap().unwrap();
    let counts = (loaded.groom.strand_count() as u64, loaded.groom.point_count() as u64);
    assert_eq!((done.strands, done.points), counts);
    assert_eq!(format!("{:?}", done.odd), format!("{:?}", loaded.warnings));
    assert_eq!(done.lost, lost);
    let bytes = std::fs::read(streamed).unwrap();
    assert!(bytes == std::fs::read(whole).unwrap(), "{} to {target}", input.display());
    bytes
}

fn stored(file: &HairFile) -> tempfile::TempPath {
    let mut path = tempfile::Builder::new().suffix(".hair").tempfile().unwrap();
    path.write_all(&file.to_bytes().unwrap()).unwrap();
    path.into_temp_path()
}

#[test]
fn every_combination_of_arrays() {
    let alike = vec![24; 1500];
    let mixed: Vec<u16> = (0..1500).map(|i| (i * i % 61) as u16).collect();
    let long = [65_535, 0, 1, 40_000, 0, 7];
    for arrays in (0..32).filter(|arrays| arrays & Field::Points.bit() != 0) {
        let has_segments = arrays & Field::Segments.bit() != 0;
        let cases: &[&[u16]] = if has_segments { &[&alike, &mixed, &long, &[3]] } else { &[&alike, &[3]] };
        for segments in cases {
            let input = stored(&file(arrays, segments));
            for target in TARGETS {
                let bytes = check(&input, target, &ReadOptions::default());
                assert!(target != "hair" || bytes == std::fs::read(&input).unwrap(), "to the byte");
            }
        }
    }
}

#[test]
fn samples_and_real_hair() {
    let mut inputs: Vec<PathBuf> = ["samples", "samples/arrays"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(root().join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "hair"))
        .filter(|path| HairFile::open(path).unwrap().file.points.is_some())
        .collect();
    assert!(inputs.len() >= 9);
    let data = std::env::var_os("GROOMKIT_DATA").map_or_else(|| root().join("../shared/data"), PathBuf::from);
    let straight = data.join("hair/straight.hair");
    if straight.exists() {
        inputs.push(straight);
    } else {
        writeln!(std::io::stderr(), "skipped: {} is not there", straight.display()).unwrap();
    }
    let tilted =
        ReadOptions { up_axis: Some(UpAxis::Y), meters_per_unit: Some(0.01), ..ReadOptions::default() };
    for input in inputs {
        for target in TARGETS {
            check(&input, target, &ReadOptions::default());
            check(&input, target, &tilted);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_file(arrays in 0_u32..32, segments in prop::collection::vec(0_u16..400, 1..400)) {
        let input = stored(&file(arrays | 0b11, &segments));
        for target in TARGETS {
            check(&input, target, &ReadOptions::default());
        }
    }
}

fn error_of(input: &Path, output: &Path) -> (String, String) {
    let options = ReadOptions::default();
    let streamed = convert_streaming(input, output, &options, &WriteOptions::default()).unwrap_err();
    let whole =
        read(input, &options).and_then(|loaded| write(&loaded.groom, output, &WriteOptions::default()));
    (streamed.to_string(), whole.unwrap_err().to_string())
}

#[test]
fn faults_are_those_of_whole_files_and_leave_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let whole = file(0b11111, &vec![24; 3000]).to_bytes().unwrap();
    let mut bad_radius = file(0b11111, &vec![24; 3000]);
    bad_radius.thickness.as_mut().unwrap()[70_001] = -1.0;
    let mut bad_point = whole.clone();
    let at = 128 + 2 * 3000 + 12 * 70_000;
    bad_point[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let lying = [&whole[..8], &[0xff; 4], &whole[12..]].concat();
    let pointless = file(0b11111, &[1]).to_bytes().map(|mut bytes| {
        bytes[12] &= !2;
        bytes
    });
    let cases = [
        whole[..whole.len() - 1].to_vec(),
        whole[..100].to_vec(),
        bad_radius.to_bytes().unwrap(),
        bad_point,
        lying,
        pointless.unwrap(),
    ];
    for (case, bytes) in cases.iter().enumerate() {
        let input = folder.path().join("in.hair");
        std::fs::write(&input, bytes).unwrap();
        for target in TARGETS {
            let output = folder.path().join("old").with_extension(target);
            std::fs::write(&output, "old").unwrap();
            let (streamed, whole) = error_of(&input, &output);
            assert_eq!(streamed, whole, "case {case}");
            assert_eq!(std::fs::read(&output).unwrap(), b"old");
        }
    }
    let left: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(left.len(), 1 + TARGETS.len(), "nothing is left beside them: {left:?}");
}

#[test]
fn pairs_that_cannot_stream_are_left_alone() {
    let input = stored(&file(0b11111, &[3, 4]));
    let folder = tempfile::tempdir().unwrap();
    let none = |input: &Path, name: &str, read: &ReadOptions, write: &WriteOptions| {
        let output = folder.path().join(name);
        assert_eq!(convert_streaming(input, &output, read, write).unwrap(), None);
        assert!(!output.exists());
    };
    let (plain_read, plain) = (ReadOptions::default(), WriteOptions::default());
    none(&input, "a.usda", &plain_read, &plain);
    none(Path::new("missing.txt"), "a.hair", &plain_read, &plain);
    none(&input, "a.hair", &ReadOptions { repair: true, ..plain_read.clone() }, &plain);
    let extras = read(&input, &plain_read).unwrap().hair.unwrap();
    let other = groom_formats::HairExtras { segments_array: false, ..extras };
    none(&input, "a.hair", &plain_read, &WriteOptions { hair: Some(other), ..plain.clone() });
}

#[test]
fn edits_see_every_block_once() {
    let input = stored(&file(0b10011, &vec![24; 3000]));
    let folder = tempfile::tempdir().unwrap();
    for target in ["hair", "txt"] {
        let mut seen = 0;
        let output = folder.path().join("edited").with_extension(target);
        let done = convert_streaming_with::<FormatError>(
            &input,
            &output,
            &ReadOptions::default(),
            &WriteOptions::default(),
            |mut block, first| {
                assert_eq!(first, seen);
                seen += block.strand_count() as u64;
                block.positions_mut().iter_mut().for_each(|p| *p *= 2.0);
                let radii = (0..block.strand_count()).map(|i| (first + i as u64) as f32).collect();
                let domain = groom::Domain::Strand;
                block
                    .set_attribute(names::RADIUS, Attribute { domain, values: groom::Values::Float(radii) })
                    .unwrap();
                block.remove_attribute(names::COLOR);
                block.set_attribute("rest", Attribute::constant_float(1.0)).unwrap();
                Ok(block)
            },
        );
        let done = done.unwrap().unwrap();
        assert_eq!(seen, 3000);
        assert!(matches!(&done.lost[..], [Warning::AttributeLeftOut { name, .. }] if name == "rest"));
        let (before, after) = (
            read(&input, &ReadOptions::default()).unwrap().groom,
            read(&output, &ReadOptions::default()).unwrap().groom,
        );
        assert_eq!(after.radii().get(2999, 74_999), 2999.0);
        let doubled: Vec<Vec3> = before.positions().iter().map(|p| *p * 2.0).collect();
        assert_eq!(after.positions(), doubled);
        assert_eq!(after.strand_count(), 3000);
    }
    let output = folder.path().join("thinned.hair");
    let thinned = convert_streaming_with::<FormatError>(
        &input,
        &output,
        &ReadOptions::default(),
        &WriteOptions::default(),
        |_, _| Ok(groom::Groom::new(vec![0, 1], vec![Vec3::ZERO]).unwrap()),
    );
    let told = thinned.unwrap_err().to_string();
    assert!(told.contains("found 1 strands of 1 points, expected 1311 strands"), "{told}");
    assert!(!output.exists());
}
