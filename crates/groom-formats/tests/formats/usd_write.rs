//! What is written as USD, without other people's programs (those run end to end).

#![allow(clippy::unwrap_used)] // helpers of tests
#![cfg(all(feature = "usda", feature = "usdz"))]

use std::path::Path;

use crate::support::{any_groom, from_bytes, full_groom, offsets, to_bytes};
use glam::{DVec3, Vec3};
use groom::{Groom, names};
use groom_formats::{
    Dialect, Format, FormatError, Frame, MotionOptions, Warning, WriteOptions, write_animation,
};
use proptest::prelude::*;

const ENDINGS: [&str; 3] = ["usda", "usdc", "usdz"];

fn frames(groom: &Groom, times: &[f64]) -> Vec<Frame> {
    let frame = |&time: &f64| Frame {
        time,
        positions: groom.positions().iter().map(|&p| p + Vec3::X * time as f32).collect(),
        velocities: Some(vec![Vec3::X * 24.0; groom.point_count()]),
        accelerations: None,
    };
    times.iter().map(frame).collect()
}

fn animate(groom: &Groom, frames: Vec<Frame>, rate: f64, path: &Path) -> Result<Vec<Warning>, FormatError> {
    write_animation(
        groom,
        &mut frames.into_iter().map(Ok),
        &MotionOptions::at_rate(rate),
        path,
        &WriteOptions::default(),
    )
}

#[test]
fn accelerations_have_the_times_of_points_and_an_origin_is_a_translation() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usda");
    let groom = full_groom();
    let mut frames = frames(&groom, &[1.0, 1.5]);
    frames.iter_mut().for_each(|f| f.accelerations = Some(vec![Vec3::new(0.0, -9.81, 0.0); 8]));
    let motion = MotionOptions { origin: DVec3::new(1234567.875, 0.1, -3.0), ..MotionOptions::at_rate(24.0) };
    write_animation(&groom, &mut frames.into_iter().map(Ok), &motion, &path, &WriteOptions::default())
        .unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    for line in [
        "double3 xformOp:translate = (1234567.875, 0.1, -3)",
        "uniform token[] xformOpOrder = [\"xformOp:translate\"]",
        "vector3f[] accelerations.timeSamples = {",
        "            1.5: [(0, -9.81, 0)",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

fn compare(text: &str, golden: &str) {
    let text = text.replace(env!("CARGO_PKG_VERSION"), "VERSION");
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(golden);
    if std::env::var_os("GROOMKIT_BLESS").is_some() {
        std::fs::write(&golden, &text).unwrap();
    }
    assert_eq!(text, std::fs::read_to_string(golden).unwrap(), "set GROOMKIT_BLESS=1 to accept");
}

#[test]
fn motion_is_sampled_and_the_rest_said_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usda");
    let groom = full_groom();
    animate(&groom, frames(&groom, &[1.0, 1.5, 2.0]), 24.0, &path).unwrap();
    compare(&std::fs::read_to_string(path).unwrap(), "usd_write_motion.usda");
}

#[test]
fn phantom_points_lie_beyond_the_ends() {
    let points = vec![Vec3::ZERO, Vec3::new(1.0, 2.0, 0.5), Vec3::X, Vec3::Y];
    let mut groom = Groom::new(offsets(&[2, 2]), points).unwrap();
    crate::support::set(
        &mut groom,
        names::RADIUS,
        groom::Domain::Vertex,
        groom::Values::Float(vec![1.0, 0.5, 2.0, 1.0]),
    );
    let mut bytes = Vec::new();
    let options = WriteOptions { dialect: Some(Dialect::Karma), ..WriteOptions::default() };
    groom_formats::write_to(Format::Usda, &groom, &mut bytes, "memory", &options).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    for line in [
        "uniform token type = \"cubic\"",
        "int[] curveVertexCounts = [4, 4]",
        "point3f[] points = [(-1, -2, -0.5), (0, 0, 0), (1, 2, 0.5), (2, 4, 1),",
        "    (2, -1, 0), (1, 0, 0), (0, 1, 0), (-1, 2, 0)]",
        "float[] widths = [2, 2, 1, 1,",
        "    4, 4, 2, 2] (",
        "float3[] extent = [(-3, -4, -2.5), (4, 6, 3)]",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

#[test]
fn a_package_holds_the_crate_as_it_is() {
    let groom = full_groom();
    let (layer, warnings) = to_bytes(Format::Usdc, &groom).unwrap();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert_eq!(layer, to_bytes(Format::Usdc, &groom).unwrap().0, "nothing depends on chance");
    let (package, _) = to_bytes(Format::Usdz, &groom).unwrap();
    let start = package.windows(8).position(|bytes| bytes == b"PXR-USDC").unwrap();
    assert_eq!(start % 64, 0);
    assert_eq!(package[start..start + layer.len()], layer);
}

#[test]
fn what_does_not_change_is_stored_once() {
    let folder = tempfile::tempdir().unwrap();
    let points = (0..9000).map(|i| Vec3::new(i as f32, 0.1, -0.3)).collect();
    let groom = Groom::new((0..=3000).map(|i| 3 * i).collect(), points).unwrap();
    let bytes = |count: u32| {
        let path = folder.path().join(format!("{count}.usdc"));
        let mut frames = vec![frames(&groom, &[0.0]).remove(0); count as usize];
        (0..).zip(&mut frames).for_each(|(time, frame)| frame.time = f64::from(time));
        animate(&groom, frames, 24.0, &path).unwrap();
        path.metadata().unwrap().len()
    };
    let (one, ten) = (bytes(1), bytes(10));
    assert!(ten < one + 1000, "{one} bytes for one frame, {ten} for ten of the same");
}

#[test]
fn frames_that_make_no_motion_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let groom = full_groom();
    let mut wide = groom.clone();
    wide.set_attribute(names::RADIUS, groom::Attribute::constant_float(1e37)).unwrap();
    let good = frames(&groom, &[1.0, 2.0]);
    let change = |frame: usize, change: &dyn Fn(&mut Frame)| {
        let mut frames = good.clone();
        change(&mut frames[frame]);
        frames
    };
    let cases = [
        (Vec::new(), 24.0, "frames: found none, expected at least one"),
        (good.clone(), 0.0, "frame rate: found 0, expected a finite number over 0"),
        (good.clone(), f64::NAN, "frame rate: found NaN"),
        (change(1, &|f| f.time = 1.0), 24.0, "time of frame 1: found 1, expected more than 1"),
        (change(0, &|f| f.time = f64::INFINITY), 24.0, "time of frame 0: found inf"),
        (change(1, &|f| f.velocities = None), 24.0, "velocities of frame 1: found none, expected some"),
        (change(0, &|f| f.velocities = None), 24.0, "velocities of frame 1: found some, expected none"),
        (change(1, &|f| f.positions.truncate(3)), 24.0, "position of frame 1: found 3 values, expected 8"),
        (change(0, &|f| f.positions[4].y = f32::NAN), 24.0, "at point 4, expected finite numbers"),
        (change(1, &|f| f.positions[0].y = f32::MAX), 24.0, "leave 32-bit floats"),
    ];
    let cases = cases.into_iter().chain([
        (
            change(1, &|f| f.accelerations = Some(vec![Vec3::ZERO; 8])),
            24.0,
            "accelerations of frame 1: found some, expected none, as before",
        ),
        (
            change(0, &|f| (f.velocities, f.accelerations) = (None, Some(vec![Vec3::ZERO; 8]))),
            24.0,
            "accelerations of frame 0: found some, expected none, or velocities with them",
        ),
    ]);
    let cases: Vec<_> = cases.collect();
    for ending in ENDINGS {
        let path = folder.path().join(format!("old.{ending}"));
        std::fs::write(&path, "old").unwrap();
        for (frames, rate, words) in &cases {
            let error = animate(&wide, frames.clone(), *rate, &path).unwrap_err().to_string();
            assert!(error.contains(words), "{error}: {words}");
        }
        let motion = MotionOptions { origin: DVec3::NAN, ..MotionOptions::at_rate(24.0) };
        let mut coming = good.clone().into_iter().map(Ok);
        let error = write_animation(&groom, &mut coming, &motion, &path, &WriteOptions::default());
        assert!(error.unwrap_err().to_string().contains("origin: found [NaN"));
        let broken = FormatError::Unsupported { file: "x".into(), format: Format::Usdc, what: "broke" };
        let mut coming = vec![Ok(good[0].clone()), Err(broken)].into_iter();
        write_animation(&groom, &mut coming, &MotionOptions::at_rate(24.0), &path, &WriteOptions::default())
            .unwrap_err();
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
    }
}

#[test]
fn velocities_of_a_still_do_not_stay_in_motion_without() {
    let folder = tempfile::tempdir().unwrap();
    let mut groom = full_groom();
    let velocities = groom::Values::Vec3(vec![Vec3::Z; 8]);
    crate::support::set(&mut groom, names::VELOCITY, groom::Domain::Vertex, velocities);
    let still = String::from_utf8(to_bytes(Format::Usda, &groom).unwrap().0).unwrap();
    assert!(still.contains("vector3f[] velocities = [(0, 0, 1),"));
    assert!(!still.contains("primvars:velocity"));
    let path = folder.path().join("a.usda");
    let mut frames = frames(&groom, &[1.0]);
    frames[0].velocities = None;
    let told = animate(&groom, frames, 24.0, &path).unwrap();
    assert!(told.contains(&Warning::AttributeLeftOut { format: Format::Usda, name: "velocity".into() }));
    assert!(!std::fs::read_to_string(path).unwrap().contains("velocities"));
}

proptest! {
    #[test]
    fn text_and_crate_refuse_the_same_grooms(groom in any_groom()) {
        let results = [Format::Usda, Format::Usdc, Format::Usdz].map(|format| {
            to_bytes(format, &groom).map(|(_, warnings)| warnings.len()).map_err(|e| e.to_string().len())
        });
        prop_assert_eq!(&results[1], &results[0]);
        prop_assert_eq!(&results[2], &results[0]);
    }
    #[test]
    fn what_is_written_is_read_back(groom in any_groom()) {
        prop_assume!(groom.strands().all(|points| points.len() > 1));
        for format in [Format::Usda, Format::Usdc, Format::Usdz] {
            let Ok((bytes, _)) = to_bytes(format, &groom) else { continue };
            let back = from_bytes(format, &bytes).unwrap().groom;
            prop_assert_eq!(back.offsets(), groom.offsets());
            let bits = |groom: &Groom| -> Vec<_> {
                groom.positions().iter().map(|p| p.to_array().map(f32::to_bits)).collect()
            };
            prop_assert_eq!(bits(&back), bits(&groom));
            prop_assert_eq!(back.attribute(names::COLOR), groom.attribute(names::COLOR));
        }
    }
}
