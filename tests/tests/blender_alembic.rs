//! Blender reads the Alembic we write and we read the one Blender writes, number by number.
//!
//! Runs where `$GROOMKIT_BLENDER_PYTHON` names a Python with `bpy` (Blender 4.2 or newer), and says aloud when
//! there is none.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{say_skipped, workspace};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Dialect, Frame, WriteOptions, write, write_animation};
use serde_json::{Value, json};

fn blender() -> Option<PathBuf> {
    let python = std::env::var_os("GROOMKIT_BLENDER_PYTHON").map(PathBuf::from);
    if python.is_none() {
        say_skipped("Blender: set GROOMKIT_BLENDER_PYTHON to a Python with bpy");
    }
    python
}

fn script(python: &Path, verb: &str, abc: &Path, numbers: &Value) {
    let json = abc.with_extension("json");
    std::fs::write(&json, numbers.to_string()).unwrap();
    let script = workspace().join("tests/blender/alembic.py");
    let run = Command::new(python).arg(script).arg(verb).arg(abc).arg(json).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{verb} {}: {said}", abc.display());
}

/// Strands of 3, 1 and 4 points.
fn groom(radius: Option<(Domain, Vec<f32>)>) -> Groom {
    let points = (0..8).map(|i| Vec3::new(i as f32 * 0.37, (i * i) as f32 * 0.11, 1.0 - i as f32 / 3.0));
    let mut groom = Groom::new(vec![0, 3, 4, 8], points.collect()).unwrap();
    if let Some((domain, values)) = radius {
        groom.set_attribute(names::RADIUS, Attribute { domain, values: Values::Float(values) }).unwrap();
    }
    groom
}

fn flat(positions: &[Vec3]) -> Vec<f32> {
    positions.iter().flat_map(|p| p.to_array()).collect()
}

fn numbers(groom: &Groom, frames: &[Frame]) -> Value {
    let counts: Vec<usize> = groom.strands().map(<[_]>::len).collect();
    let radii: Option<Vec<f32>> = groom.attribute(names::RADIUS).map(|_| {
        let strands = 0..groom.strand_count();
        strands.flat_map(|s| groom.strand_range(s).map(move |v| groom.radii().get(s, v))).collect()
    });
    let frames: Vec<Value> = frames
        .iter()
        .map(|frame| json!({ "frame": frame.time, "positions": flat(&frame.positions) }))
        .collect();
    json!({ "counts": counts, "radii": radii, "frame_rate": 24, "frames": frames })
}

fn still(groom: &Groom) -> Vec<Frame> {
    vec![Frame { time: 1.0, positions: groom.positions().to_vec(), velocities: None }]
}

#[test]
fn blender_reads_points_radii_and_counts() {
    let Some(python) = blender() else { return };
    let folder = tempfile::tempdir().unwrap();
    let radii = [
        None,
        Some((Domain::Groom, vec![0.25])),
        Some((Domain::Strand, vec![0.1, 0.2, 0.3])),
        Some((Domain::Vertex, (0..8).map(|i| i as f32 * 0.013).collect())),
    ];
    for (i, radius) in radii.into_iter().enumerate() {
        for dialect in [None, Some(Dialect::Blender)] {
            let groom = groom(radius.clone());
            let abc = folder.path().join(format!("still{i}{}.abc", dialect.is_some()));
            write(&groom, &abc, &WriteOptions { dialect, ..WriteOptions::default() }).unwrap();
            script(&python, "check", &abc, &numbers(&groom, &still(&groom)));
        }
    }
}

#[test]
fn blender_plays_ten_frames() {
    let Some(python) = blender() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groom = groom(Some((Domain::Groom, vec![0.5])));
    let frames: Vec<Frame> = (1..=10)
        .map(|time| {
            let moved = groom.positions().iter().map(|&p| p + Vec3::new(0.0, 0.5 * time as f32, p.x));
            Frame { time: time.into(), positions: moved.collect(), velocities: None }
        })
        .collect();
    let abc = folder.path().join("moving.abc");
    let mut given = frames.clone().into_iter().map(Ok);
    write_animation(&groom, &mut given, 24.0, &abc, &WriteOptions::default()).unwrap();
    script(&python, "check", &abc, &numbers(&groom, &frames));
}
