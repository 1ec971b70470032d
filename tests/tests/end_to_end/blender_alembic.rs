//! Blender reads the Alembic we write and we read the one Blender writes, number by number.
//!
//! Runs where `$GROOMKIT_BLENDER_PYTHON` names a Python with `bpy` (Blender 4.2 or newer), and says aloud when
//! there is none.

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{say_skipped, workspace};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{
    Dialect, Frame, MotionOptions, ReadOptions, WriteOptions, read_frames, write, write_animation,
};
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
    vec![Frame { time: 1.0, positions: groom.positions().to_vec(), ..Frame::default() }]
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
            Frame { time: time.into(), positions: moved.collect(), ..Frame::default() }
        })
        .collect();
    let abc = folder.path().join("moving.abc");
    let mut given = frames.clone().into_iter().map(Ok);
    write_animation(&groom, &mut given, &MotionOptions::at_rate(24.0), &abc, &WriteOptions::default())
        .unwrap();
    script(&python, "check", &abc, &numbers(&groom, &frames));
}

/// Where Blender's z-up point is in its Alembic, which is y up.
fn y_up(p: Vec3) -> Vec3 {
    Vec3::new(p.x, p.z, -p.y)
}

fn assert_near(read: &[Vec3], expected: &[Vec3]) {
    assert_eq!(read.len(), expected.len());
    for (a, b) in read.iter().zip(expected) {
        assert!((*a - *b).length() <= 1e-5, "{a} {b}");
    }
}

#[test]
fn we_read_what_blender_writes() {
    let Some(python) = blender() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groom = groom(Some((Domain::Vertex, (1..9).map(|i| i as f32 * 0.25).collect())));
    let mut wanted = numbers(&groom, &still(&groom));
    wanted["location"] = json!([1, 2, 3]);
    let abc = folder.path().join("still.abc");
    script(&python, "export", &abc, &wanted);
    let loaded = groom_formats::read(&abc, &ReadOptions::default()).unwrap();
    let expected: Vec<Vec3> = groom.positions().iter().map(|&p| y_up(p + Vec3::new(1.0, 2.0, 3.0))).collect();
    assert_near(loaded.groom.positions(), &expected);
    assert_eq!((loaded.groom.offsets(), loaded.times.len()), (groom.offsets(), 0));
    assert_eq!(loaded.groom.attribute(names::RADIUS), groom.attribute(names::RADIUS));

    // Carried by a transform that moves.
    wanted["move"] = json!([[1, [0, 0, 0]], [3, [2, 0, 0]]]);
    wanted["range"] = json!([1, 3]);
    let abc = folder.path().join("moving.abc");
    script(&python, "export", &abc, &wanted);
    let (loaded, frames) = read_frames(&abc, &ReadOptions::default()).unwrap();
    assert_eq!((&loaded.times[..], loaded.frame_rate), (&[1.0, 2.0, 3.0][..], Some(24.0)));
    let frames: Vec<Frame> = frames.map(Result::unwrap).collect();
    assert_eq!(frames.len(), 3);
    for (frame, x) in frames.iter().zip([0.0, 1.0, 2.0]) {
        let expected: Vec<Vec3> = groom.positions().iter().map(|&p| y_up(p + Vec3::X * x)).collect();
        assert_near(&frame.positions, &expected);
    }

    // Catmull-Rom curves go through their points.
    let mut round = numbers(&groom, &still(&groom));
    round["type"] = json!("catmull_rom");
    round["counts"] = json!([4, 4]);
    let abc = folder.path().join("round.abc");
    script(&python, "export", &abc, &round);
    let fine = ReadOptions { curve_error: Some(1e-4), ..ReadOptions::default() };
    let read = groom_formats::read(&abc, &fine).unwrap().groom;
    assert_eq!(read.strand_count(), 2);
    assert!(read.point_count() > 16);
    for &point in groom.positions() {
        assert!(read.positions().iter().any(|p| p.distance(y_up(point)) < 1e-5), "{point}");
    }
}
