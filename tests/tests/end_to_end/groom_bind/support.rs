//! Running the program, and meshes whose motion is known.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{program, samples_dir};
use glam::Vec3;
use groom::{Attribute, Groom, UpAxis, names};
use groom_formats::{Loaded, ReadOptions, WriteOptions, read_frames};
use serde_json::Value;

/// The character of the samples, and hair that grows on its head.
pub fn head() -> String {
    samples_dir().join("nodding_head.glb").display().to_string()
}

pub fn hair(name: &str) -> String {
    samples_dir().join(name).display().to_string()
}

/// Runs it in `folder`.
pub fn attempt(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(program("groom-bind")).args(arguments).current_dir(folder).output().unwrap()
}

/// Runs it in `folder`; it must succeed. Returns its words.
pub fn bind(folder: &Path, arguments: &[&str]) -> String {
    let run = attempt(folder, arguments);
    let words = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(0), "{arguments:?}: {words}");
    words
}

/// As [`bind`], with `--json`; returns what it says.
pub fn bind_json(folder: &Path, arguments: &[&str]) -> Value {
    let run = attempt(folder, &[arguments, &["--json"]].concat());
    let words = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(0), "{arguments:?}: {words}");
    serde_json::from_slice(&run.stdout).unwrap()
}

/// The names in a folder, in order.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A frame as it was read.
pub struct Seen {
    pub time: f64,
    pub positions: Vec<Vec3>,
    pub velocities: Option<Vec<Vec3>>,
    pub accelerations: Option<Vec<Vec3>>,
}

/// What a file that moves holds.
pub fn frames(path: &Path) -> (Loaded, Vec<Seen>) {
    let (loaded, frames) = read_frames(path, &ReadOptions::default()).unwrap();
    let seen = frames.map(|frame| {
        let frame = frame.unwrap();
        let (time, positions, velocities) = (frame.time, frame.positions, frame.velocities);
        Seen { time, positions, velocities, accelerations: frame.accelerations }
    });
    let seen = seen.collect();
    (loaded, seen)
}

/// The greatest distance between points.
pub fn farthest(a: &[Vec3], b: &[Vec3]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

/// A groom of three strands of four points, standing on the square of [`square`].
pub fn three_strands(folder: &Path) -> (PathBuf, Groom) {
    let strand =
        |x: f32, z: f32| (0..4).map(move |i| Vec3::new(x, 0.1 * i as f32, z + 0.02 * (i * i) as f32));
    let points = [(0.2, 0.3), (-0.4, 0.1), (0.5, -0.6)].into_iter().flat_map(|(x, z)| strand(x, z)).collect();
    let mut groom = Groom::new(vec![0, 4, 8, 12], points).unwrap();
    groom.up_axis = UpAxis::Y;
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.01)).unwrap();
    let path = folder.join("three.usda");
    groom_formats::write(&groom, &path, &WriteOptions::default()).unwrap();
    (path, groom)
}

/// A square of two by two in the plane y = 0, every corner moved by `motion`, as OBJ.
pub fn square(motion: impl Fn(Vec3) -> Vec3) -> String {
    let mut text = String::new();
    for (x, z) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)] {
        let corner = motion(Vec3::new(x, 0.0, z));
        writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z).unwrap();
    }
    text + "f 1 2 3 4\n"
}

/// Writes `square.0000.obj` and so on, the square of each frame moved by `motion`.
pub fn moving_square(folder: &Path, frames: u32, motion: impl Fn(u32, Vec3) -> Vec3) {
    for frame in 0..frames {
        let path = folder.join(format!("square.{frame:04}.obj"));
        std::fs::write(path, square(|corner| motion(frame, corner))).unwrap();
    }
}
