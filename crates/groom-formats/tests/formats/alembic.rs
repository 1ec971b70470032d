//! Alembic there and back, and what breaks it.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

use std::path::Path;

use crate::support::{any_groom, finite, from_bytes, full_groom, set};
use glam::{Vec2, Vec3};
use groom::{Domain, Groom, UpAxis, Values, names};
use groom_formats::{Dialect, Format, Frame, MotionOptions, ReadOptions, WriteOptions, write_animation};
use proptest::prelude::*;

fn written(groom: &Groom, dialect: Option<Dialect>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let options = WriteOptions { dialect, ..WriteOptions::default() };
    groom_formats::write_to(Format::Alembic, groom, &mut bytes, "memory", &options).unwrap();
    bytes
}

/// Equal to the bit, where `==` takes -0 for 0.
fn assert_same(read: &Groom, groom: &Groom) {
    assert_eq!(read, groom);
    let bits = |groom: &Groom| {
        let mut all: Vec<u32> = bytemuck::cast_slice(groom.positions()).to_vec();
        for (_, attribute) in groom.attributes() {
            match &attribute.values {
                Values::Float(values) => all.extend_from_slice(bytemuck::cast_slice(values)),
                Values::Vec2(values) => all.extend_from_slice(bytemuck::cast_slice(values)),
                Values::Vec3(values) => all.extend_from_slice(bytemuck::cast_slice(values)),
                Values::Int(values) => all.extend_from_slice(bytemuck::cast_slice(values)),
            }
        }
        all
    };
    assert_eq!(bits(read), bits(groom));
}

/// Every standard attribute, and every type in every domain.
fn everything() -> Groom {
    let mut groom = full_groom();
    set(&mut groom, names::GROUP, Domain::Strand, Values::Int(vec![0, 0, 1]));
    set(&mut groom, names::GUIDE, Domain::Strand, Values::Int(vec![1, 0, 0]));
    set(&mut groom, names::VELOCITY, Domain::Vertex, Values::Vec3(vec![Vec3::new(1.0, -0.0, 3.0); 8]));
    for domain in [Domain::Groom, Domain::Strand, Domain::Vertex] {
        let count = groom.domain_len(domain);
        let numbers = || (0..count).map(|i| i as f32 * 0.7);
        let name = |kind| format!("{kind} a {domain:?}");
        set(&mut groom, &name("float"), domain, Values::Float(numbers().collect()));
        set(&mut groom, &name("vec2"), domain, Values::Vec2(numbers().map(Vec2::splat).collect()));
        set(&mut groom, &name("vec3"), domain, Values::Vec3(numbers().map(Vec3::splat).collect()));
        set(&mut groom, &name("int"), domain, Values::Int((0..count as i32).map(|i| i - 1).collect()));
    }
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.00254;
    groom
}

#[test]
fn every_attribute_comes_back() {
    for dialect in [None, Some(Dialect::Blender), Some(Dialect::Houdini), Some(Dialect::Karma)] {
        let groom = everything();
        let loaded = from_bytes(Format::Alembic, &written(&groom, dialect)).unwrap();
        assert_eq!(loaded.warnings, []);
        assert_eq!((loaded.times, loaded.frame_rate), (vec![], None));
        assert_same(&loaded.groom, &groom);
    }
}

#[test]
fn radii_and_colours_keep_their_domain() {
    for domain in [Domain::Groom, Domain::Strand, Domain::Vertex] {
        let mut groom = everything();
        let count = groom.domain_len(domain);
        set(&mut groom, names::RADIUS, domain, Values::Float(vec![0.1; count]));
        set(&mut groom, names::COLOR, domain, Values::Vec3(vec![Vec3::splat(0.1); count]));
        assert_same(&from_bytes(Format::Alembic, &written(&groom, None)).unwrap().groom, &groom);
        // In Unreal's own space already: nothing is turned or scaled, so nothing may change.
        groom.meters_per_unit = 0.01;
        let unreal = written(&groom, Some(Dialect::Unreal));
        assert_same(&from_bytes(Format::Alembic, &unreal).unwrap().groom, &groom);
    }
}

#[test]
fn unreals_space_is_the_same_hair_in_centimetres() {
    let mut groom = everything();
    groom.up_axis = UpAxis::Y;
    groom.meters_per_unit = 1.0;
    let read = from_bytes(Format::Alembic, &written(&groom, Some(Dialect::Unreal))).unwrap().groom;
    assert_eq!((read.up_axis, read.meters_per_unit), (UpAxis::Z, 0.01));
    for (a, b) in read.positions().iter().zip(groom.positions()) {
        let expected = Vec3::new(b.x, -b.z, b.y) * 100.0;
        assert!((*a - expected).length() <= 1e-6 * expected.length(), "{a} {expected}");
    }
    assert!((read.radii().get(0, 2) - 100.0 * groom.radii().get(0, 2)).abs() < 1e-6);
}

#[test]
fn the_options_say_what_the_numbers_mean() {
    let bytes = written(&full_groom(), None);
    let options = ReadOptions {
        up_axis: Some(UpAxis::Z),
        meters_per_unit: Some(0.5),
        known_len: Some(bytes.len() as u64),
        ..ReadOptions::default()
    };
    let read = groom_formats::read_from(Format::Alembic, &bytes[..], "memory", &options).unwrap().groom;
    assert_eq!((read.up_axis, read.meters_per_unit), (UpAxis::Z, 0.5));
}

proptest! {
    #[test]
    fn any_groom_comes_back(groom in any_groom()) {
        assert_same(&from_bytes(Format::Alembic, &written(&groom, None)).unwrap().groom, &groom);
    }

    #[test]
    fn any_attribute_comes_back(values in prop::collection::vec(finite(), 8), name in "[^/\0]{1,300}") {
        let mut groom = full_groom();
        prop_assume!(!name.starts_with("groom_") && groom.attribute(&name).is_none());
        prop_assume!(!["Cd", "N", "uv", "group", "guide", "velocity", "width"].contains(&name.as_str()));
        set(&mut groom, &name, Domain::Vertex, Values::Float(values));
        assert_same(&from_bytes(Format::Alembic, &written(&groom, None)).unwrap().groom, &groom);
    }

    #[test]
    fn flipped_bytes_do_no_harm(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
        let mut bytes = written(&everything(), None);
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if let Ok(loaded) = from_bytes(Format::Alembic, &bytes) {
            prop_assert!(loaded.groom.point_count() <= bytes.len());
        }
    }
}

#[test]
fn every_truncation_is_refused() {
    let bytes = written(&everything(), None);
    for len in 0..bytes.len() {
        let error = from_bytes(Format::Alembic, &bytes[..len]).unwrap_err().to_string();
        assert!(error.starts_with("memory: byte ") && error.contains("expected"), "{len}: {error}");
    }
}

/// Ten frames of a groom, at `times`, in which every point goes its own way.
fn frames(groom: &Groom, times: &[f64], velocities: bool) -> Vec<Frame> {
    let at = |time: f64| {
        let wander =
            |(i, &p): (usize, &Vec3)| p + Vec3::new((i as f32 + time as f32).sin(), time as f32, -0.0);
        let positions: Vec<Vec3> = groom.positions().iter().enumerate().map(wander).collect();
        let velocities = velocities.then(|| positions.iter().map(|p| *p * 24.0).collect());
        Frame { time, positions, velocities, ..Frame::default() }
    };
    times.iter().map(|&time| at(time)).collect()
}

fn animated(groom: &Groom, frames: &[Frame], rate: f64, path: &Path) {
    let mut given = frames.iter().cloned().map(Ok);
    let warnings =
        write_animation(groom, &mut given, &MotionOptions::at_rate(rate), path, &WriteOptions::default())
            .unwrap();
    assert_eq!(warnings, []);
}

#[test]
fn frames_come_back_at_their_times() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moving.abc");
    let mut groom = everything();
    groom.remove_attribute(names::VELOCITY);
    let even: Vec<f64> = (1..=10).map(f64::from).collect();
    let fine: Vec<f64> = (0..10).map(|i| 1001.0 + f64::from(i) * 0.25).collect();
    let odd = vec![-3.0, 0.0, 0.5, 7.0, 7.125, 8.0, 9.0, 20.0, 21.0, 48.0];
    for (times, rate) in [(&even, 24.0), (&fine, 30.0), (&odd, 25.0), (&even, 23.976)] {
        for velocities in [false, true] {
            let frames = frames(&groom, times, velocities);
            animated(&groom, &frames, rate, &path);
            for frame in &frames {
                let options = ReadOptions { time: Some(frame.time), ..ReadOptions::default() };
                let loaded = groom_formats::read(&path, &options).unwrap();
                assert_eq!((&loaded.times, loaded.frame_rate), (times, Some(rate)));
                let mut expected = groom.clone();
                expected.positions_mut().copy_from_slice(&frame.positions);
                if let Some(velocities) = &frame.velocities {
                    set(&mut expected, names::VELOCITY, Domain::Vertex, Values::Vec3(velocities.clone()));
                }
                assert_same(&loaded.groom, &expected);
            }
        }
    }
}

#[test]
fn between_frames_points_lie_between() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moving.abc");
    let groom = full_groom();
    let frames = frames(&groom, &[1.0, 3.0], false);
    animated(&groom, &frames, 24.0, &path);
    let at = |time: Option<f64>| {
        let options = ReadOptions { time, ..ReadOptions::default() };
        groom_formats::read(&path, &options).unwrap().groom.positions().to_vec()
    };
    let middle: Vec<Vec3> =
        frames[0].positions.iter().zip(&frames[1].positions).map(|(a, &b)| a.lerp(b, 0.25)).collect();
    assert_eq!(at(Some(1.5)), middle);
    for (time, frame) in [(None, 0), (Some(-10.0), 0), (Some(1e6), 1)] {
        assert_eq!(at(time), frames[frame].positions);
    }
}

#[test]
fn frames_that_do_not_fit_are_refused_and_the_old_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moving.abc");
    std::fs::write(&path, "old").unwrap();
    let groom = full_groom();
    let good = frames(&groom, &[1.0, 2.0], false);
    let refused = |change: &dyn Fn(&mut Vec<Frame>), rate: f64, words: &str| {
        let mut frames = good.clone();
        change(&mut frames);
        let mut given = frames.into_iter().map(Ok);
        let error = write_animation(
            &groom,
            &mut given,
            &MotionOptions::at_rate(rate),
            &path,
            &WriteOptions::default(),
        )
        .unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
    };
    refused(&|_| {}, 0.0, "frame rate: found 0");
    refused(&|frames| frames.clear(), 24.0, "frames: found none");
    refused(&|frames| frames[1].time = 1.0, 24.0, "time of frame 1: found 1, expected more than 1");
    refused(
        &|frames| frames[1].positions.truncate(7),
        24.0,
        "position of frame 1: found 7 values, expected 8",
    );
    refused(&|frames| frames[0].positions[3].y = f32::NAN, 24.0, "position of frame 0: found");
    refused(
        &|frames| frames[1].velocities = Some(vec![]),
        24.0,
        "velocities of frame 1: found some, expected none",
    );
}
