//! Environments as files: broken ones are refused, real ones shine from where they should.

use std::io::Write;
use std::path::{Path, PathBuf};

use glam::Vec3;
use hair_render::*;
use proptest::prelude::*;

fn studio_exr() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("studio.exr");
    write_studio(&path, 32).unwrap();
    std::fs::read(path).unwrap()
}

/// A Radiance picture of 64 x 4 pixels in the run-length code of today: runs and plain stretches.
fn small_hdr() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 64\n".to_vec();
    for row in 0..4u8 {
        bytes.extend([2, 2, 0, 64]);
        for channel in 0..4u8 {
            bytes.extend([128 + 40, if channel == 3 { 128 } else { 60 * channel + row }]);
            bytes.push(24);
            bytes.extend((0..24).map(|i| if channel == 3 { 129 } else { 8 * i + row }));
        }
    }
    bytes
}

/// What opening a file of these bytes says.
fn open(bytes: &[u8]) -> Result<Environment, RenderError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.any");
    std::fs::write(&path, bytes).unwrap();
    Environment::open(&path)
}

#[test]
fn pictures_cut_anywhere_are_refused_by_name() {
    for bytes in [studio_exr(), small_hdr()] {
        assert!(open(&bytes).is_ok());
        for length in 0..bytes.len() {
            let message = open(&bytes[..length]).unwrap_err().to_string();
            assert!(message.contains("picture.any"), "{length}: {message}");
        }
    }
}

#[test]
fn a_size_that_the_file_cannot_hold_is_refused_before_memory_is_taken() {
    let hdr = |size: &str| {
        let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
        bytes.extend([0; 64]);
        open(&bytes).unwrap_err().to_string()
    };
    assert!(hdr("-Y 999999999 +X 999999999").contains("999999999 x 999999999"));
    assert!(hdr("-Y 16384 +X 16384").contains("16384 x 16384"), "{}", hdr("-Y 16384 +X 16384"));
    assert!(hdr("-Y 0 +X 7").contains("7 x 0"));

    let sound = studio_exr();
    let mut bytes = sound.clone();
    let window = bytes.windows(11).position(|w| w == b"dataWindow\0").unwrap() + 11 + 6 + 4;
    for far in [16_383i32, 872_415_231, i32::MAX - 1] {
        bytes.clone_from(&sound);
        for corner in [8, 12] {
            // First across alone: one block of 16 rows is then all there is to a lie.
            bytes[window + corner..window + corner + 4].copy_from_slice(&far.to_le_bytes());
            assert!(matches!(open(&bytes), Err(RenderError::InvalidPicture { .. })), "{far}");
        }
    }
}

#[test]
fn what_is_no_picture_or_not_there_is_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(Environment::open(&folder.path().join("none.hdr")), Err(RenderError::Io { .. })));
    assert!(matches!(open(b"GIF89a"), Err(RenderError::UnsupportedPicture { .. })));
    assert!(matches!(open(b""), Err(RenderError::UnsupportedPicture { .. })));
    assert!(matches!(open(b"#?RADIANCE\n"), Err(RenderError::InvalidPicture { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..Default::default() })]

    /// Bytes changed anywhere: a picture or an error, never a panic. (Most changes in the pixels of a
    /// .hdr file make another sound picture.)
    #[test]
    fn changed_bytes_never_end_the_program(
        of_exr in any::<bool>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        in_header in any::<bool>(),
    ) {
        let mut bytes = if of_exr { studio_exr() } else { small_hdr() };
        let reach = if in_header { bytes.len().min(400) } else { bytes.len() };
        for (place, value) in changes {
            bytes[place.index(reach)] = value;
        }
        if let Ok(environment) = open(&bytes) {
            prop_assert!(environment.radiance(Vec3::new(0.6, 0.0, 0.8)).is_finite());
        }
    }
}

fn real_pictures() -> Vec<PathBuf> {
    let data = std::env::var_os("GROOMKIT_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let Ok(entries) = std::fs::read_dir(data.join("hdri")) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut paths: Vec<_> = paths.filter(|path| path.extension().is_some_and(|e| e == "hdr")).collect();
    paths.sort();
    paths
}

/// The brightest pixel of a real picture, found by another reader, shines from the direction of its
/// place: column 0 begins at -Z, a quarter is +X, the middle is +Z; row 0 begins at +Y.
#[test]
fn the_sun_of_a_real_picture_stands_where_its_pixel_is() {
    let paths = real_pictures();
    if paths.is_empty() {
        // Past the harness, which keeps the words of tests that pass to itself.
        let mut stderr = std::io::stderr();
        writeln!(stderr, "skipped: no HDRI in shared/data/hdri").unwrap();
    }
    for path in paths {
        let picture = image::open(&path).unwrap().into_rgb32f();
        let brightness = |p: &image::Rgb<f32>| p.0.iter().sum::<f32>();
        let (x, y, sun) =
            picture.enumerate_pixels().max_by(|a, b| brightness(a.2).total_cmp(&brightness(b.2))).unwrap();
        let azimuth = (0.5 - (x as f32 + 0.5) / picture.width() as f32) * std::f32::consts::TAU;
        let down = (y as f32 + 0.5) / picture.height() as f32 * std::f32::consts::PI;
        let direction = Vec3::new(down.sin() * azimuth.sin(), down.cos(), down.sin() * azimuth.cos());
        let environment = Environment::open(&path).unwrap();
        let found = environment.radiance(direction);
        assert!((found - Vec3::from_array(sun.0)).length() < 0.02 * found.length(), "{}", path.display());
        for other in [-direction, Vec3::new(-direction.x, direction.y, direction.z)] {
            assert!(environment.radiance(other).element_sum() < 0.9 * brightness(sun), "{}", path.display());
        }
    }
}
