//! Figures of a model by another hand, against those known of it.
use std::io::Write;
use std::path::PathBuf;

use glam::Vec3;
use groom::{Groom, Statistics};

#[test]
fn straight_hair_has_its_known_figures() {
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let path = std::env::var_os("GROOMKIT_DATA").map_or(beside, PathBuf::from).join("hair/straight.hair");
    let Ok(bytes) = std::fs::read(&path) else {
        // Not `eprintln!`, which the test harness swallows.
        let _ = writeln!(std::io::stderr(), "skipped: {} is not there", path.display());
        return;
    };
    // This crate knows no files: 10,000 strands of 16 points follow the 128 bytes of header.
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let point = |i: usize| Vec3::new(float(128 + 12 * i), float(132 + 12 * i), float(136 + 12 * i));
    let groom =
        Groom::new((0..=10_000).map(|i| i * 16).collect(), (0..160_000).map(point).collect()).unwrap();

    let figures = Statistics::of(&groom);
    let near = |a: f64, b: f64, by: f64| assert!((a - b).abs() <= by, "{a} is not {b}");
    let length = figures.strand_length.unwrap();
    near(length.min, 55.3, 0.05);
    near(length.mean, 78.2, 0.05);
    near(length.max, 107.0, 0.05);
    let (low, high) = figures.bounds.unwrap();
    assert!((low - Vec3::new(-32.496, -33.901, -22.709)).abs().max_element() < 1e-3);
    assert!((high - Vec3::new(30.899, 24.074, 63.678)).abs().max_element() < 1e-3);
    assert_eq!((figures.sharp_bends, figures.zero_length_segments, figures.non_finite_points), (16, 0, 0));
}
