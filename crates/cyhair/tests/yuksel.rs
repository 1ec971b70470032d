//! A model by the format's author, against what his own reader says of it.
#![allow(clippy::panic, clippy::unwrap_used)] // helpers of tests count as tests

use std::io::Write;
use std::path::PathBuf;

use cyhair::{HairFile, HairReader};

/// The file's path, or a word on stderr that it is missing.
fn data(name: &str) -> Option<PathBuf> {
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let path = std::env::var_os("GROOMKIT_DATA").map_or(beside, PathBuf::from).join(name);
    if !path.exists() {
        // Not `eprintln!`, which the test harness swallows.
        let _ = writeln!(std::io::stderr(), "skipped: {} is not there", path.display());
        return None;
    }
    Some(path)
}

#[test]
fn straight_hair_reads_as_yuksels_own_reader_reads_it() {
    let (Some(path), Some(oracle)) = (data("hair/straight.hair"), data("hair/straight.cyHairFile.json"))
    else {
        return;
    };
    let oracle: serde_json::Value = serde_json::from_slice(&std::fs::read(oracle).unwrap()).unwrap();
    let loaded = HairFile::open(&path).unwrap();
    assert!(loaded.warnings.is_empty());
    let (file, header) = (&loaded.file, &oracle["header"]);
    assert_eq!(header["hair_count"], file.header.hair_count);
    assert_eq!(header["point_count"], file.header.point_count);
    assert_eq!(header["arrays"], file.header.arrays);
    assert_eq!(header["d_segments"], file.header.default_segments);
    let single = |value: &serde_json::Value| value.as_f64().unwrap() as f32;
    assert_eq!(single(&header["d_thickness"]), file.header.default_thickness);
    assert_eq!(single(&header["d_transparency"]), file.header.default_transparency);
    assert_eq!(
        header["d_color"].as_array().unwrap().iter().map(single).collect::<Vec<_>>(),
        file.header.default_color
    );

    let points = file.points.as_deref().unwrap();
    for axis in 0..3 {
        let sum: f64 = points.iter().map(|p| f64::from(p[axis])).sum();
        assert_eq!(sum, oracle["sum_points_f64"][axis].as_f64().unwrap());
    }
    let ranges: Vec<_> = file.strand_ranges().collect();
    for strand in oracle["strands"].as_array().unwrap() {
        let range = ranges[strand["index"].as_u64().unwrap() as usize].clone();
        let expected: Vec<[f32; 3]> = strand["points"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| std::array::from_fn(|axis| single(&p[axis])))
            .collect();
        assert_eq!(&points[range], expected);
    }
    assert_eq!(file.to_bytes().unwrap(), std::fs::read(&path).unwrap());
}

#[test]
fn real_files_stream_as_they_load() {
    for name in ["hair/straight.hair", "hair/bear_fur.hair"] {
        let Some(path) = data(name) else { continue };
        let loaded = HairFile::open(&path).unwrap();
        let points = loaded.file.points.as_deref().unwrap();
        let mut reader = HairReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        let mut ranges = loaded.file.strand_ranges();
        while let Some(strand) = reader.next_strand().unwrap() {
            let range = ranges.next().unwrap();
            assert_eq!(strand.points, Some(&points[range.clone()]));
            assert_eq!(strand.colors, loaded.file.colors.as_deref().map(|colors| &colors[range]));
        }
        assert!(ranges.next().is_none());
        assert_eq!(reader.warnings(), loaded.warnings);
    }
}

#[cfg(feature = "mmap")]
#[test]
fn a_mapped_file_shows_the_same_points() {
    let Some(path) = data("hair/straight.hair") else { return };
    let mapped = cyhair::MappedHair::open(&path).unwrap();
    let loaded = HairFile::open(&path).unwrap();
    assert_eq!(mapped.view().unwrap().points().unwrap().as_slice(), loaded.file.points.as_deref());
}
