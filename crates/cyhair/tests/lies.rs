//! Files that lie are refused by every reader, with the place, and cost no more than they are long.
#![allow(clippy::panic, clippy::unwrap_used, clippy::print_stderr)] // helpers of tests count as tests

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io::Cursor;

use common::file;
use cyhair::{Field, HairError, HairFile, HairReader, HairView, Header, LookAlike, Repair, Warning};
use proptest::prelude::*;

/// The system's allocator, remembering the largest request of each thread.
struct Watching;

thread_local! {
    static LARGEST: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system's allocator as it came.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Watching {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = LARGEST.try_with(|largest| largest.set(largest.get().max(layout.size())));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Watching = Watching;

/// Every way of reading refuses `bytes`; the error of the first.
fn refused(bytes: &[u8]) -> HairError {
    let error = HairFile::from_bytes(bytes).unwrap_err();
    let kind = std::mem::discriminant(&error);
    let same = |other: HairError| {
        assert_eq!(std::mem::discriminant(&other), kind, "{other} instead of {error}");
    };
    // Without the length, sums are found wrong before the end is found missing.
    HairFile::read(bytes, None).unwrap_err();
    same(HairView::new(bytes).unwrap_err());
    same(stream(bytes).unwrap_err());
    error
}

fn stream(bytes: &[u8]) -> Result<Vec<Warning>, HairError> {
    let mut reader = HairReader::new(Cursor::new(bytes))?;
    while reader.next_strand()?.is_some() {}
    Ok(reader.warnings())
}

fn with_u32(bytes: &[u8], offset: usize, value: u32) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[offset..offset + 4].copy_from_slice(&value.to_le_bytes());
    bytes
}

#[test]
fn truncation_at_every_byte_is_refused_with_its_place() {
    for bits in 0..32 {
        let bytes = file(bits, &[2, 1, 3]).to_bytes().unwrap();
        for len in 0..bytes.len() {
            match refused(&bytes[..len]) {
                HairError::Truncated { offset, expected, found, .. } => {
                    assert!(offset <= len as u64 && found < expected);
                    assert_eq!(offset + found, len as u64, "arrays {bits:#b} cut at {len}");
                }
                other => panic!("arrays {bits:#b} cut at {len}: {other}"),
            }
        }
    }
}

#[test]
fn counts_that_lie_are_refused_without_taking_memory() {
    let bytes = file(0b11111, &[2, 1, 3]).to_bytes().unwrap();
    for (offset, value) in [(4, u32::MAX), (8, u32::MAX), (4, 1 << 30), (8, 1 << 31), (8, 10)] {
        let bytes = with_u32(&bytes, offset, value);
        LARGEST.set(0);
        refused(&bytes);
        let _ = HairFile::read_and_repair(&bytes[..]);
        assert!(LARGEST.get() <= 2 * bytes.len() + (1 << 16) + 64, "{} bytes taken", LARGEST.get());
    }
    assert!(matches!(refused(&with_u32(&bytes, 4, 0)), HairError::NoStrands));
    let message = refused(&with_u32(&bytes, 8, 8)).to_string();
    assert_eq!(
        message,
        "point_count at byte 8: found 8, expected 9, the sum of segments + 1 over the strands (segments at byte 128)"
    );
    let defaults = file(0b00010, &[2, 2]).to_bytes().unwrap();
    let error = refused(&with_u32(&defaults, 16, u32::MAX));
    assert!(
        matches!(error, HairError::PointCount { field: Field::DefaultSegments, offset: 16, expected, .. }
        if expected == 2 << 32)
    );
}

#[test]
fn non_finite_points_are_refused_with_their_place() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let bytes = file(0b00011, &[2, 1, 3]).to_bytes().unwrap();
        let bytes = with_u32(&bytes, 134 + 12 * 4 + 8, bad.to_bits());
        let error = refused(&bytes);
        assert!(matches!(error, HairError::NonFinitePoint { offset: 190, point: 4, component: 2, .. }));
    }
}

#[test]
fn look_alikes_are_named() {
    let mut mono: Vec<u8> = [2_u32, 5].iter().flat_map(|v| v.to_le_bytes()).collect();
    mono.extend([2_u16, 3].iter().flat_map(|v| v.to_le_bytes()));
    mono.extend([0; 5 * 12]);
    let kind = |bytes: &[u8]| match refused(bytes) {
        HairError::Magic { looks_like, .. } => looks_like,
        other => panic!("{other}"),
    };
    mono.extend([0; 12]);
    assert_eq!(kind(&mono), None);
    mono.truncate(mono.len() - 12);
    assert_eq!(kind(&mono), Some(LookAlike::MonoHair { strands: 2, points: 5 }));
    assert!(refused(&mono).to_string().contains("this looks like a MonoHair file (2 strands, 5 points"));
    assert_eq!(kind(b"0.5 0.25 1 0.1\n0.5 0.5 1 0.1\n"), Some(LookAlike::Text));
    assert_eq!(kind(b"\x80\xBF\x80FIBER\0\0"), Some(LookAlike::TungstenFiber));
}

#[test]
fn odd_files_are_read_with_warnings_and_mended() {
    let mut odd = file(0b11111, &[0, 3, 2]);
    odd.header.default_thickness = f32::NAN;
    odd.thickness.as_mut().unwrap()[6] = f32::INFINITY;
    let points = odd.points.as_mut().unwrap();
    points[3] = points[2];
    points[5] = points[4];
    let mut bytes = odd.to_bytes().unwrap();
    bytes[12] |= 0x80;
    bytes.extend([1, 2, 3]);
    let end = odd.header.layout().end;
    let thickness_at = 128 + 6 + 8 * 12 + 6 * 4;
    let loaded = HairFile::from_bytes(&bytes).unwrap();
    let expected = [
        Warning::UnknownArrays { bits: 0x80 },
        Warning::TrailingBytes { offset: end, bytes: 3 },
        Warning::OnePointStrands { count: 1, first_strand: 0 },
        // Points 4 and 5 coincide too, but belong to two strands.
        Warning::ZeroLengthSegments { count: 1, first_point: 3 },
        Warning::NonFiniteValues { field: Field::Thickness, offset: thickness_at, count: 1 },
    ];
    assert_eq!(loaded.warnings, expected);
    assert_eq!(HairView::new(&bytes).unwrap().warnings(), expected);
    assert_eq!(stream(&bytes).unwrap(), expected);

    let repaired = HairFile::read_and_repair(&bytes[..]).unwrap();
    let done = [
        Repair::DroppedTrailingBytes { offset: end, bytes: 3 },
        Repair::ClearedUnknownArrays { bits: 0x80 },
        Repair::ReplacedDefault { field: Field::DefaultThickness },
        Repair::ReplacedValues { field: Field::Thickness, count: 1 },
        Repair::MergedSegments { count: 1 },
        Repair::DroppedStrands { count: 1 },
    ];
    assert_eq!(repaired.repairs, done);
    assert_eq!(repaired.file.segments, Some(vec![2, 2]));
    assert_eq!(repaired.file.thickness.as_ref().unwrap()[4], 1.0);
    let again = HairFile::from_bytes(&repaired.file.to_bytes().unwrap()).unwrap();
    assert!(again.warnings.is_empty());
}

#[test]
fn wrong_counts_are_mended_where_only_one_way_is_right() {
    let set = |bytes: &[u8]| HairFile::read_and_repair(bytes).map(|r| r.repairs);
    let good = file(0b00011, &[2, 1, 3]).to_bytes().unwrap();
    let to = |field, from, to| vec![Repair::SetCount { field, from, to }];
    assert_eq!(set(&with_u32(&good, 8, 77)).unwrap(), to(Field::PointCount, 77, 9));
    let default = file(0b00010, &[2; 5]).to_bytes().unwrap();
    assert_eq!(set(&with_u32(&default, 8, 3)).unwrap(), to(Field::PointCount, 3, 15));
    assert_eq!(set(&with_u32(&default, 4, 4)).unwrap(), to(Field::HairCount, 4, 5));
    assert_eq!(set(&with_u32(&default, 16, 3)).unwrap(), to(Field::DefaultSegments, 3, 2));
    // Five strands of three points or three of five: who knows.
    assert!(matches!(set(&with_u32(&default, 16, 4)), Err(HairError::PointCount { .. })));
}

#[test]
fn cut_files_keep_their_whole_strands() {
    let whole = file(0b11111, &[2, 1, 3]);
    let bytes = whole.to_bytes().unwrap();
    let cut = |len: usize| HairFile::read_and_repair(&bytes[..len]);
    let colors_gone = cut(bytes.len() - 1).unwrap();
    assert_eq!(colors_gone.repairs, [Repair::DroppedArray { field: Field::Colors }]);
    assert_eq!(colors_gone.file.transparency, whole.transparency);
    let two_left = cut(134 + 12 * 6).unwrap();
    assert_eq!(two_left.file.segments, Some(vec![2, 1]));
    assert_eq!(two_left.file.points.as_deref(), Some(&whole.points.as_ref().unwrap()[..5]));
    assert!(two_left.repairs.contains(&Repair::DroppedCutStrands { kept: 2, dropped: 1 }));
    for len in 0..bytes.len() {
        match cut(len) {
            Ok(repaired) => assert!(repaired.file.check().is_ok() && !repaired.repairs.is_empty()),
            Err(error) => {
                assert!(matches!(error, HairError::Truncated { .. }) && len < 134 + 36, "{len}: {error}")
            }
        }
    }
}

#[test]
fn points_that_are_not_finite_are_dropped() {
    let mut bad = file(0b00010, &[3, 3, 3]);
    let points = bad.points.as_mut().unwrap();
    points[1][0] = f32::NAN;
    for point in &mut points[4..7] {
        point[2] = f32::INFINITY;
    }
    let repairs = bad.repair().unwrap();
    assert_eq!(repairs, [Repair::DroppedPoints { count: 4 }, Repair::DroppedStrands { count: 1 }]);
    assert_eq!(bad.segments, Some(vec![2, 3]));
    bad.check().unwrap();
    let mut hopeless = file(0b00010, &[0, 0]);
    assert!(matches!(hopeless.repair(), Err(HairError::NoStrands)));
}

/// The bytes of `file`, each array of floats with faults at `places`: not a number, infinite, or
/// (two of them) a triple that repeats the one before it.
fn odd_bytes(mut file: HairFile, places: &[(prop::sample::Index, usize)]) -> Vec<u8> {
    let mut bytes = file.header.to_bytes().to_vec();
    bytes.extend(file.segments.iter().flatten().flat_map(|count| count.to_le_bytes()));
    let arrays = [
        file.points.as_deref_mut().map(bytemuck::cast_slice_mut::<_, f32>),
        file.thickness.as_deref_mut(),
        file.transparency.as_deref_mut(),
        file.colors.as_deref_mut().map(bytemuck::cast_slice_mut),
    ];
    for values in arrays.into_iter().flatten() {
        for (place, kind) in places {
            let at = place.index(values.len());
            match (kind, at / 3 * 3) {
                (0, _) => values[at] = f32::NAN,
                (1, _) => values[at] = f32::INFINITY,
                (_, 0) => {}
                (_, start) => values.copy_within(start - 3..(values.len() - 3).min(start), start),
            }
        }
        bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
    bytes
}

/// A mended file is written, read again the same, and has no warning and nothing more to mend.
fn nothing_is_left_to_repair(file: &HairFile) {
    let again = HairFile::from_bytes(&file.to_bytes().unwrap()).unwrap();
    assert_eq!(&again.file, file);
    let expected: &[Warning] = if file.points.is_some() { &[] } else { &[Warning::MissingPoints] };
    assert_eq!(again.warnings, expected);
    assert_eq!(again.file.clone().repair().unwrap(), []);
}

#[test]
fn headers_without_arrays_promise_what_they_like_at_no_cost() {
    let header = |hair_count, default_segments, point_count| {
        Header { hair_count, default_segments, point_count, ..Header::default() }.to_bytes()
    };
    LARGEST.set(0);
    let one_long = header(1, u32::MAX - 1, u32::MAX);
    assert!(HairFile::read_and_repair(&one_long[..]).unwrap().repairs.is_empty());
    let many_short = header(u32::MAX, 0, u32::MAX);
    assert!(matches!(HairFile::read_and_repair(&many_short[..]), Err(HairError::NoStrands)));
    assert_eq!(HairFile::from_bytes(&many_short).unwrap().file.strand_count(), u32::MAX as usize);
    // Nothing but the counts speaks, and they disagree.
    for counts in [header(1 << 31, 7, 8), header(3, 4, 9)] {
        assert!(matches!(HairFile::read_and_repair(&counts[..]), Err(HairError::PointCount { .. })));
    }
    let mut long = file(0b00001, &[u16::MAX; 100]);
    long.segments.as_mut().unwrap()[7] = 0;
    long.header.point_count -= u32::from(u16::MAX);
    let repaired = HairFile::read_and_repair(&long.to_bytes().unwrap()[..]).unwrap();
    assert_eq!(repaired.repairs, [Repair::DroppedStrands { count: 1 }]);
    assert_eq!(repaired.file.header.point_count, 99 << 16);
    assert!(LARGEST.get() <= 1 << 17, "{} bytes taken", LARGEST.get());
}

#[test]
fn a_file_that_lies_is_named_by_its_path() {
    let path = std::env::temp_dir().join(format!("cyhair-lies-{}.hair", std::process::id()));
    let bytes = file(0b00010, &[2, 2]).to_bytes().unwrap();
    std::fs::write(&path, &bytes[..150]).unwrap();
    let message = HairFile::open(&path).unwrap_err().to_string();
    let expected = "points at byte 128: expected 72 bytes, found 22 before the end of the file";
    assert_eq!(message, format!("{}: {expected}", path.display()));
    #[cfg(feature = "mmap")]
    assert_eq!(cyhair::MappedHair::open(&path).unwrap().view().unwrap_err().to_string(), message);
    std::fs::remove_file(&path).unwrap();
    assert!(HairFile::open(&path).unwrap_err().to_string().contains(&*path.to_string_lossy()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_bytes_make_a_reader_panic_or_take_more_memory_than_they_are(
        fields in any::<[u32; 4]>(),
        small in any::<[bool; 4]>(),
        rest in prop::collection::vec(any::<u8>(), 0..600),
        cut in 0_usize..140,
    ) {
        let mut bytes = b"HAIR".to_vec();
        for (value, small) in fields.into_iter().zip(small) {
            bytes.extend((if small { value % 12 } else { value }).to_le_bytes());
        }
        bytes.resize(128, 0);
        bytes.extend(rest);
        if cut > 120 {
            bytes.truncate(cut);
        }
        LARGEST.set(0);
        let read = HairFile::from_bytes(&bytes);
        prop_assert!(LARGEST.get() <= bytes.len() + 1024, "{} bytes taken", LARGEST.get());
        LARGEST.set(0);
        let unknown = HairFile::read(&bytes[..], None);
        prop_assert!(LARGEST.get() <= 2 * bytes.len() + (1 << 16) + 64);
        prop_assert_eq!(read.is_ok(), unknown.is_ok());
        prop_assert_eq!(read.is_ok(), HairView::new(&bytes).is_ok());
        prop_assert_eq!(read.is_ok(), stream(&bytes).is_ok());
        LARGEST.set(0);
        let repaired = HairFile::read_and_repair(&bytes[..]);
        prop_assert!(LARGEST.get() <= 8 * bytes.len() + (1 << 16), "{} bytes taken", LARGEST.get());
        if let Ok(repaired) = repaired {
            nothing_is_left_to_repair(&repaired.file);
        }
    }

    #[test]
    fn what_is_mended_is_read_without_a_warning(
        bits in 0_u32..32,
        segments in prop::collection::vec(0_u16..5, 1..9),
        same in any::<bool>(),
        odd in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..4), 0..6),
        count in prop::option::of((1_usize..5, 0_u32..40)),
        cut in prop::option::of(any::<prop::sample::Index>()),
        trailing in 0_usize..5,
    ) {
        let segments = if same { vec![segments[0]; segments.len()] } else { segments };
        let mut bytes = odd_bytes(file(bits, &segments), &odd);
        if let Some((field, value)) = count {
            bytes = with_u32(&bytes, 4 * field, value);
        }
        match cut {
            Some(cut) => bytes.truncate(cut.index(bytes.len())),
            None => bytes.resize(bytes.len() + trailing, 7),
        }
        match HairFile::read_and_repair(&bytes[..]) {
            Ok(repaired) => {
                nothing_is_left_to_repair(&repaired.file);
                let clean = HairFile::from_bytes(&bytes).is_ok_and(|loaded| loaded.warnings.is_empty());
                prop_assert!(!clean || repaired.file.to_bytes().unwrap() == bytes);
            }
            // Mending can do without a points array, but not without strands or against the counts.
            Err(HairError::NoStrands | HairError::PointCount { .. } | HairError::Truncated { .. }) => {}
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}
