//! What is written comes back, by every way of reading, to the bit.
#![allow(clippy::panic, clippy::unwrap_used, clippy::print_stderr)] // helpers of tests count as tests

mod common;

use std::io::{Cursor, Read};

use common::file;
use cyhair::{ArrayWriter, Field, HairError, HairFile, HairReader, HairView, HairWriter, Strand, Warning};
use proptest::prelude::*;

/// A stream that gives a few bytes at a time and does not know its length.
struct Trickle<'a>(&'a [u8]);

impl Read for Trickle<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = buffer.len().min(7);
        self.0.read(&mut buffer[..count])
    }
}

/// Reads strand by strand and writes strand by strand.
fn through_streams(bytes: &[u8], segments: Option<Vec<u16>>) -> Result<(Vec<u8>, Vec<Warning>), HairError> {
    let mut reader = HairReader::new(Cursor::new(bytes))?;
    let mut writer = HairWriter::new(Cursor::new(Vec::new()), *reader.header(), segments)?;
    while let Some(strand) = reader.next_strand()? {
        writer.push(strand)?;
    }
    Ok((writer.finish()?.into_inner(), reader.warnings()))
}

/// As [`through_streams`], the segments being counted on the way.
fn counted(bytes: &[u8]) -> Result<Vec<u8>, HairError> {
    let mut reader = HairReader::new(Cursor::new(bytes))?;
    let mut writer = HairWriter::counting(Cursor::new(Vec::new()), *reader.header())?;
    while let Some(strand) = reader.next_strand()? {
        writer.push(strand)?;
    }
    Ok(writer.finish()?.into_inner())
}

/// Writes the arrays one after another, in pieces of `piece` values.
fn array_by_array(file: &HairFile, piece: usize) -> Result<Vec<u8>, HairError> {
    let mut writer = ArrayWriter::new(Vec::new(), file.header)?;
    file.segments.iter().flat_map(|a| a.chunks(piece)).try_for_each(|p| writer.segments(p))?;
    file.points.iter().flat_map(|a| a.chunks(piece)).try_for_each(|p| writer.points(p))?;
    file.thickness.iter().flat_map(|a| a.chunks(piece)).try_for_each(|p| writer.thickness(p))?;
    file.transparency.iter().flat_map(|a| a.chunks(piece)).try_for_each(|p| writer.transparency(p))?;
    file.colors.iter().flat_map(|a| a.chunks(piece)).try_for_each(|p| writer.colors(p))?;
    writer.finish()
}

/// The file a view shows.
fn from_view(view: &HairView<'_>) -> HairFile {
    HairFile {
        header: *view.header(),
        segments: view.segments().map(|a| a.iter().collect()),
        points: view.points().map(|a| (0..a.len()).map(|i| a.get(i).unwrap()).collect()),
        thickness: view.thickness().map(|a| a.iter().collect()),
        transparency: view.transparency().map(|a| a.iter().collect()),
        colors: view.colors().map(|a| a.iter().collect()),
    }
}

fn check_every_way(file: &HairFile) {
    let bytes = file.to_bytes().unwrap();
    assert_eq!(bytes.len() as u64, file.header.layout().end);
    let loaded = HairFile::from_bytes(&bytes).unwrap();
    assert_eq!(&loaded.file, file);
    assert_eq!(loaded.file.to_bytes().unwrap(), bytes);
    assert_eq!(HairFile::read(Trickle(&bytes), None).unwrap(), loaded);
    assert_eq!(
        HairFile::read_and_repair(Trickle(&bytes)).map(|r| r.file.header.info).unwrap(),
        file.header.info
    );

    // Bytes at an odd address can only be read value by value.
    let mut shifted = vec![0];
    shifted.extend(&bytes);
    for bytes in [&bytes[..], &shifted[1..]] {
        let view = HairView::new(bytes).unwrap();
        assert_eq!(&from_view(&view), file);
        assert_eq!(view.warnings(), loaded.warnings);
        assert!(view.strand_ranges().eq(file.strand_ranges()));
    }
    let (streamed, warnings) = through_streams(&bytes, file.segments.clone()).unwrap();
    assert_eq!(streamed, bytes);
    assert_eq!(warnings, loaded.warnings);
    // Without any array nothing tells how long a strand is.
    if file.header.arrays & !1 != 0 || file.segments.is_none() {
        assert_eq!(counted(&bytes).unwrap(), bytes);
    }
    for piece in [1, 5, 100_000] {
        assert_eq!(array_by_array(file, piece).unwrap(), bytes);
    }
}

#[test]
fn every_combination_of_arrays_comes_back() {
    for bits in 0..32 {
        for segments in [&[2, 1, 3][..], &[1], &[4, 4]] {
            check_every_way(&file(bits, segments));
        }
    }
}

#[test]
fn strands_longer_than_the_buffers_come_back() {
    check_every_way(&file(0b11111, &[65_535, 1, 20_000]));
    check_every_way(&file(0b11110, &[30_000, 30_000, 30_000]));
}

#[test]
fn a_missing_points_array_is_a_warning() {
    let loaded = HairFile::from_bytes(&file(0b00101, &[1, 2]).to_bytes().unwrap()).unwrap();
    assert_eq!(loaded.warnings, [Warning::MissingPoints]);
    assert!(loaded.file.points.is_none());
}

#[test]
fn a_writer_refuses_what_a_reader_would() {
    let good = file(0b11111, &[1, 2]);
    let refused = |change: fn(&mut HairFile)| {
        let mut bad = good.clone();
        change(&mut bad);
        let mut written = Vec::new();
        let error = bad.write(&mut written).unwrap_err();
        assert!(written.is_empty());
        error
    };
    assert!(matches!(refused(|f| f.points = None), HairError::ArrayBit { announced: true, .. }));
    assert!(matches!(refused(|f| f.header.arrays ^= 4), HairError::ArrayBit { announced: false, .. }));
    assert!(matches!(refused(|f| f.header.point_count += 1), HairError::ArrayLength { .. }));
    assert!(matches!(refused(|f| f.segments = Some(vec![1, 1])), HairError::PointCount { .. }));
    assert!(matches!(refused(|f| f.header.hair_count = 0), HairError::NoStrands));
    let infinite = refused(|f| f.points.as_mut().unwrap()[3][1] = f32::INFINITY);
    assert!(
        matches!(infinite, HairError::NonFinitePoint { point: 3, component: 1, offset, .. } if offset == 132 + 40)
    );
}

#[test]
fn a_streaming_writer_refuses_strands_that_do_not_fit() {
    let good = file(0b00011, &[1, 2]);
    let writer = || HairWriter::new(Cursor::new(Vec::new()), good.header, good.segments.clone()).unwrap();
    let points = [[0.0; 3], [1.0; 3], [f32::NAN; 3]];
    let strand = |count| Strand { points: Some(&points[..count]), ..Strand::default() };
    assert!(matches!(writer().push(strand(1)), Err(HairError::Strand { expected: 2, found: 1, .. })));
    let with_color = Strand { colors: Some(&points[..2]), ..strand(2) };
    assert!(matches!(writer().push(with_color), Err(HairError::Strand { expected: 0, found: 2, .. })));
    let mut one = writer();
    one.push(strand(2)).unwrap();
    assert!(matches!(one.push(strand(3)), Err(HairError::NonFinitePoint { point: 4, .. })));
    assert!(matches!(one.finish(), Err(HairError::StrandCount { expected: 2, found: 1 })));
}

#[test]
fn an_array_writer_refuses_what_a_reader_would() {
    let good = file(0b11011, &[1, 2]);
    let writer = || {
        let mut writer = ArrayWriter::new(Vec::new(), good.header).unwrap();
        writer.segments(&[1, 2]).unwrap();
        writer
    };
    let length = |result: Result<(), HairError>| match result {
        Err(HairError::ArrayLength { field, expected, found }) => (field, expected, found),
        other => panic!("{other:?}"),
    };
    assert_eq!(length(writer().segments(&[0])), (Field::Segments, 2, 3));
    assert_eq!(length(writer().points(&[[0.0; 3]; 6])), (Field::Points, 5, 6));
    assert_eq!(length(writer().thickness(&[0.0; 1])), (Field::Points, 5, 0));
    assert_eq!(length(writer().finish().map(drop)), (Field::Points, 5, 0));
    let mut one = writer();
    one.points(&[[0.0; 3]; 2]).unwrap();
    assert!(matches!(one.points(&[[f32::NAN; 3]]), Err(HairError::NonFinitePoint { point: 2, .. })));
    one.points(&[[0.0; 3]; 3]).unwrap();
    assert_eq!(length(one.thickness(&[0.0])), (Field::Thickness, 0, 1));
    one.transparency(&[0.0; 5]).unwrap();
    assert_eq!(length(one.points(&[[0.0; 3]])), (Field::Points, 5, 6));
    assert_eq!(length(one.finish().map(drop)), (Field::Colors, 5, 0));
    let mut lying = ArrayWriter::new(Vec::new(), file(0b00011, &[1, 2]).header).unwrap();
    lying.segments(&[2, 2]).unwrap();
    lying.points(&[[0.0; 3]; 5]).unwrap();
    assert!(matches!(lying.finish(), Err(HairError::PointCount { expected: 6, found: 5, .. })));
}

#[test]
fn a_counting_writer_refuses_strands_without_room() {
    let good = file(0b00011, &[1, 2]);
    let writer = || HairWriter::counting(Cursor::new(Vec::new()), good.header).unwrap();
    let points = vec![[0.0; 3]; 70_000];
    let strand = |count| Strand { points: Some(&points[..count]), ..Strand::default() };
    let mut full = writer();
    full.push(strand(4)).unwrap();
    assert!(matches!(full.push(strand(2)), Err(HairError::Strand { strand: 1, expected: 1, found: 2, .. })));
    assert!(matches!(writer().push(strand(0)), Err(HairError::Strand { expected: 1, found: 0, .. })));
    let mut short = writer();
    short.push(strand(1)).unwrap();
    short.push(strand(1)).unwrap();
    assert!(matches!(short.finish(), Err(HairError::PointCount { expected: 2, found: 5, .. })));
    let header = cyhair::Header { hair_count: 1, point_count: 70_000, ..good.header };
    let mut long = HairWriter::counting(Cursor::new(Vec::new()), header).unwrap();
    let refused = long.push(strand(70_000));
    assert!(matches!(refused, Err(HairError::Strand { expected: 65_536, found: 70_000, .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_file_comes_back(
        bits in 0_u32..32,
        segments in prop::collection::vec(0_u16..9, 1..20),
        thickness in any::<[u32; 2]>(),
    ) {
        let mut file = file(bits, &segments);
        // Any bits at all are kept in arrays that need not be finite.
        if let Some(values) = &mut file.thickness {
            values[0] = f32::from_bits(thickness[0]);
        }
        file.header.default_color[2] = f32::from_bits(thickness[1]);
        let bytes = file.to_bytes().unwrap();
        let loaded = HairFile::from_bytes(&bytes).unwrap();
        prop_assert_eq!(loaded.file.to_bytes().unwrap(), bytes.clone());
        let (streamed, warnings) = through_streams(&bytes, file.segments.clone()).unwrap();
        prop_assert_eq!(streamed, bytes);
        prop_assert_eq!(format!("{warnings:?}"), format!("{:?}", loaded.warnings));
    }
}
