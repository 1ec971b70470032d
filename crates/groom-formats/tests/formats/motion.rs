//! Grooms that move, through every format that holds motion and back.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

use std::path::Path;

use glam::{DVec3, Vec3};
use groom::Groom;
use groom_formats::{
    Frame, MotionOptions, ReadOptions, Warning, WriteOptions, read_frames, read_moving, write_animation,
};
use proptest::prelude::*;

const ENDINGS: [&str; 4] = ["usda", "usdc", "usdz", "abc"];
/// A character far away.
const FAR: DVec3 = DVec3::new(1e6 + 0.0625, -2e6 - 1.0 / 3.0, 0.1);

fn write(groom: &Groom, frames: &[Frame], motion: &MotionOptions, path: &Path) -> Vec<Warning> {
    let mut given = frames.iter().cloned().map(Ok);
    write_animation(groom, &mut given, motion, path, &WriteOptions::default()).unwrap()
}

/// Two strands of three and five points.
fn lock() -> Groom {
    let positions = (0..8).map(|i| Vec3::new(i as f32 * 0.1, (i * i) as f32 * 0.01, -(i as f32))).collect();
    Groom::new(vec![0, 3, 8], positions).unwrap()
}

/// Frames at `times` in which every point goes its own way.
fn frames(groom: &Groom, times: &[f64], accelerations: bool) -> Vec<Frame> {
    let frame = |&time: &f64| {
        let wander = |(i, p): (usize, &Vec3)| {
            let (i, t) = (i as f32, time as f32);
            *p + Vec3::new((i + t).sin(), t * t * 0.01, -0.25 * t)
        };
        let positions: Vec<Vec3> = groom.positions().iter().enumerate().map(wander).collect();
        let velocities = positions.iter().map(|p| *p * 24.0).collect();
        let accelerations = accelerations.then(|| positions.iter().map(|p| *p * -3.0).collect());
        Frame { time, positions, velocities: Some(velocities), accelerations }
    };
    times.iter().map(frame).collect()
}

#[test]
fn an_origin_is_applied_or_kept_as_asked() {
    let folder = tempfile::tempdir().unwrap();
    let groom = lock();
    let written = frames(&groom, &[1.0, 1.25, 2.0], false);
    for ending in ENDINGS {
        let path = folder.path().join(format!("a.{ending}"));
        write(&groom, &written, &MotionOptions { origin: FAR, ..MotionOptions::at_rate(24.0) }, &path);
        let keep = ReadOptions { keep_origin: true, ..ReadOptions::default() };
        let (loaded, read) = read_frames(&path, &keep).unwrap();
        assert_eq!(loaded.origin, FAR, "{ending}");
        assert_eq!(loaded.groom.positions(), written[0].positions);
        let read: Vec<Frame> = read.map(Result::unwrap).collect();
        assert_eq!(read, written, "{ending}: to the bit, though it is far away");
        let (loaded, read) = read_frames(&path, &ReadOptions::default()).unwrap();
        assert_eq!(loaded.origin, DVec3::ZERO);
        for (read, written) in read.map(Result::unwrap).zip(&written) {
            let placed: Vec<Vec3> =
                written.positions.iter().map(|p| (p.as_dvec3() + FAR).as_vec3()).collect();
            assert_eq!((read.positions, &read.velocities), (placed, &written.velocities), "{ending}");
        }
    }
}

#[test]
fn an_origin_that_is_nowhere_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usda");
    let groom = lock();
    let motion = MotionOptions { origin: FAR, ..MotionOptions::at_rate(24.0) };
    write(&groom, &frames(&groom, &[1.0, 2.0], false), &motion, &path);
    let text = std::fs::read_to_string(&path).unwrap();
    let (before, after) = text.split_once("xformOp:translate = (").unwrap();
    std::fs::write(&path, format!("{before}xformOp:translate = (inf, {}", after.split_once(',').unwrap().1))
        .unwrap();
    let keep = ReadOptions { keep_origin: true, ..ReadOptions::default() };
    let error = read_moving(&path, &keep).unwrap_err().to_string();
    assert!(
        error.contains("a.usda: place of /Groom") && error.contains("expected finite numbers"),
        "{error}"
    );
}

#[test]
fn any_time_can_be_read_in_any_order() {
    let folder = tempfile::tempdir().unwrap();
    let groom = lock();
    let written = frames(&groom, &[1.0, 2.0, 4.0], false);
    for ending in ENDINGS {
        let path = folder.path().join(format!("a.{ending}"));
        write(&groom, &written, &MotionOptions::at_rate(30.0), &path);
        let moving = read_moving(&path, &ReadOptions::default()).unwrap();
        assert_eq!(
            (&moving.still().times[..], moving.still().frame_rate),
            (&[1.0, 2.0, 4.0][..], Some(30.0))
        );
        for (time, (before, after), t) in [
            (3.0, (1, 2), 0.5),
            (-7.0, (0, 0), 0.0),
            (1.25, (0, 1), 0.25),
            (2.0, (1, 1), 0.0),
            (1e9, (2, 2), 0.0),
            (1.25, (0, 1), 0.25),
        ] {
            let found = moving.at(time).unwrap();
            let expected = |of: fn(&Frame) -> &[Vec3]| -> Vec<Vec3> {
                let ends = of(&written[before]).iter().zip(of(&written[after]));
                ends.map(|(a, b)| a.lerp(*b, t)).collect()
            };
            let close = |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).all(|(a, b)| a.abs_diff_eq(*b, 1e-4));
            assert_eq!(found.time, time);
            assert!(close(&found.positions, &expected(|f| &f.positions)), "{ending} at {time}");
            let velocities = found.velocities.unwrap();
            assert!(close(&velocities, &expected(|f| f.velocities.as_ref().unwrap())), "{ending} at {time}");
        }
        let error = moving.at(f64::NAN).unwrap_err().to_string();
        assert!(error.contains("time: found NaN, expected a finite number"), "{error}");
    }
}

#[test]
fn accelerations_come_back_where_there_is_a_place_for_them() {
    let folder = tempfile::tempdir().unwrap();
    let groom = lock();
    let written = frames(&groom, &[1.0, 2.0], true);
    for ending in ENDINGS {
        let path = folder.path().join(format!("a.{ending}"));
        let warnings = write(&groom, &written, &MotionOptions::at_rate(24.0), &path);
        let frame = read_moving(&path, &ReadOptions::default()).unwrap().at(1.0).unwrap();
        if ending == "abc" {
            assert_eq!(frame.accelerations, None);
            assert!(warnings[0].to_string().contains("cannot hold the attribute `acceleration`"));
        } else {
            assert_eq!((frame, &warnings[..]), (written[0].clone(), &[][..]));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn any_frames_come_back(
        counts in proptest::collection::vec(2_u32..6, 1..5),
        steps in proptest::collection::vec(1_u32..5000, 1..5),
        start in -100_000_i32..100_000,
        rate in prop::sample::select(vec![1.0, 23.976, 24.0, 25.0, 29.97, 30.0, 60.0, 1000.0]),
        origin in any::<[i32; 3]>(),
        bits in any::<u32>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let points: u32 = counts.iter().sum();
        let number = |i: u32| (bits.wrapping_add(i).wrapping_mul(2_654_435_761) as f32 - 2e9) * 1e-7;
        let offsets = std::iter::once(0).chain(counts.iter().scan(0, |sum, count| { *sum += count; Some(*sum) }));
        let positions = (0..points).map(|i| Vec3::splat(number(i))).collect();
        let groom = Groom::new(offsets.collect(), positions).unwrap();
        // Alembic's times are seconds: frames are meant to a thousandth.
        let mut time = start;
        let times: Vec<f64> = steps.iter().map(|step| { time += *step as i32; f64::from(time) / 1000.0 }).collect();
        let written = frames(&groom, &times, false);
        let motion = MotionOptions { origin: DVec3::from(origin.map(f64::from)) / 7.0, frame_rate: rate };
        for ending in ENDINGS {
            let path = folder.path().join(format!("a.{ending}"));
            write(&groom, &written, &motion, &path);
            let keep = ReadOptions { keep_origin: true, ..ReadOptions::default() };
            let moving = read_moving(&path, &keep).unwrap();
            if written.len() > 1 {
                prop_assert_eq!(&moving.still().times, &times);
                prop_assert_eq!(moving.still().frame_rate, Some(rate));
            }
            for frame in &written {
                prop_assert_eq!(&moving.at(frame.time).unwrap(), frame, "{}", ending);
            }
        }
    }
}
