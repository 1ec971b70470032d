//! Grooms that move through the converter: sequences of files, USD and Alembic.

use std::path::{Path, PathBuf};
use std::process::Output;

use end_to_end_tests::{run, samples_dir};
use glam::Vec3;
use groom_formats::{Frame, MotionOptions, ReadOptions, WriteOptions, read, read_frames, write_animation};
use tempfile::TempDir;

const FRAMES: usize = 4;

/// A folder with `walk.0001.hair` and so on, each a step farther along y.
fn walk() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for frame in 1..=FRAMES {
        let (name, step) = (format!("walk.{frame:04}.hair"), format!("0,{frame},0"));
        convert(folder.path(), &[&sample(), &name, "--max-strands", "50", "--translate", &step]);
    }
    folder
}

fn sample() -> String {
    samples_dir().join("wavy.hair").display().to_string()
}

/// Names of groom files are taken to be in `folder`; the conversion must succeed.
fn convert(folder: &Path, arguments: &[&str]) -> String {
    let run = attempt(folder, arguments);
    let words = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success(), "{arguments:?}: {words}");
    words
}

fn attempt(folder: &Path, arguments: &[&str]) -> Output {
    let placed: Vec<PathBuf> = arguments
        .iter()
        .enumerate()
        .map(|(i, argument)| if i < 2 { folder.join(argument) } else { argument.into() })
        .collect();
    run("cyhair-convert", &placed)
}

/// Times and points of every frame, and the frame rate.
fn frames(path: &Path) -> (Vec<(f64, Vec<Vec3>)>, Option<f64>) {
    let (loaded, frames) = read_frames(path, &ReadOptions::default()).unwrap();
    let frames = frames.map(|frame| frame.map(|frame| (frame.time, frame.positions)).unwrap());
    (frames.collect(), loaded.frame_rate)
}

#[test]
fn a_sequence_moves_through_usd_and_alembic_to_the_bit() {
    let folder = walk();
    let expected: Vec<_> = (1..=FRAMES)
        .map(|frame| {
            let path = folder.path().join(format!("walk.{frame:04}.hair"));
            (frame as f64, read(&path, &ReadOptions::default()).unwrap().groom.positions().to_vec())
        })
        .collect();
    let steps = [
        ["walk.####.hair", "a.usdc"],
        ["a.usdc", "b.abc"],
        ["b.abc", "c.usda"],
        ["c.usda", "d.usdz"],
        ["d.usdz", "e.usdc"],
    ];
    for (i, step) in steps.into_iter().enumerate() {
        let rate: &[&str] = if i == 0 { &["--fps", "30"] } else { &[] };
        let words = convert(folder.path(), &[&step[..], rate].concat());
        assert!(words.contains("4 frames"), "{words}");
        assert!(frames(&folder.path().join(step[1])) == (expected.clone(), Some(30.0)), "{step:?}");
    }
}

#[test]
fn a_part_and_a_still_are_taken_as_asked() {
    let folder = walk();
    let path = |name: &str| folder.path().join(name);
    convert(folder.path(), &["walk.####.hair", "part.usdc", "--frames", "2-3"]);
    let times = |name: &str| frames(&path(name)).0.iter().map(|frame| frame.0).collect::<Vec<_>>();
    assert_eq!(times("part.usdc"), [2.0, 3.0]);
    convert(folder.path(), &["part.usdc", "one.usdc", "--time", "3"]);
    assert!(times("one.usdc").len() < 2);
    convert(folder.path(), &["part.usdc", "first.hair"]);
    convert(folder.path(), &["part.usdc", "last.hair", "--time", "3"]);
    let points = |name: &str| read(&path(name), &ReadOptions::default()).unwrap().groom.positions().to_vec();
    assert!(points("first.hair") == points("walk.0002.hair"));
    assert!(points("last.hair") == points("walk.0003.hair"));
    let refused = attempt(folder.path(), &["part.usdc", "none.abc", "--frames", "8-9"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("its frames are 2 to 3"));
}

#[test]
fn accelerations_are_left_out_with_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let groom = read(Path::new(&sample()), &ReadOptions::default()).unwrap().groom;
    let mut given = (0..2).map(|time| {
        let rates = Some(vec![Vec3::X; groom.point_count()]);
        Ok(Frame {
            time: f64::from(time),
            positions: groom.positions().to_vec(),
            velocities: rates.clone(),
            accelerations: rates,
        })
    });
    let path = folder.path().join("a.usdc");
    let motion = MotionOptions::at_rate(24.0);
    write_animation(&groom, &mut given, &motion, &path, &WriteOptions::default()).unwrap();
    let words = convert(folder.path(), &["a.usdc", "b.usdc"]);
    assert!(words.contains("`accelerations`") && words.contains("left out"), "{words}");
    assert!(!convert(folder.path(), &["b.usdc", "c.usdc"]).contains("warning"));
}

#[test]
fn attributes_that_change_are_named_and_other_shapes_refused() {
    let folder = walk();
    assert!(!convert(folder.path(), &["walk.####.hair", "out.usdc"]).contains("warning"));
    convert(folder.path(), &["walk.0002.hair", "walk.0002.hair", "--width", "0.5"]);
    let words = convert(folder.path(), &["walk.####.hair", "out.usdc"]);
    assert!(words.contains("`radius`") && words.contains("first frame's is kept"), "{words}");
    convert(folder.path(), &["walk.0003.hair", "walk.0003.hair", "--resample", "5"]);
    let old = std::fs::read(folder.path().join("out.usdc")).unwrap();
    let refused = attempt(folder.path(), &["walk.####.hair", "out.usdc"]);
    assert_eq!(refused.status.code(), Some(2));
    let words = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(words.contains("walk.0003.hair: 50 strands of 250 points"), "{words}");
    assert!(std::fs::read(folder.path().join("out.usdc")).unwrap() == old);
}
