//! USD files of ours, loaded by Blender, where `GROOMKIT_BLENDER_PYTHON` names a Python that has it.

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{samples_dir, say_skipped, workspace};
use groom::{Groom, UpAxis};
use groom_formats::{Frame, MotionOptions, ReadOptions, WriteOptions};
use serde_json::{Value, json};

fn blender() -> Option<PathBuf> {
    let python = std::env::var_os("GROOMKIT_BLENDER_PYTHON").map(PathBuf::from);
    if python.is_none() {
        say_skipped("Blender does not judge our USD; set GROOMKIT_BLENDER_PYTHON to a Python that has bpy");
    }
    python
}

fn numbers(positions: &[glam::Vec3]) -> Vec<f32> {
    positions.iter().flat_map(|p| p.to_array()).collect()
}

fn expected(groom: &Groom) -> Value {
    let radii = groom.radii();
    let each = (0..groom.strand_count()).flat_map(|s| groom.strand_range(s).map(move |v| (s, v)));
    json!({
        "counts": groom.strands().map(<[glam::Vec3]>::len).collect::<Vec<_>>(),
        "positions": numbers(groom.positions()),
        "radii": each.map(|(strand, vertex)| radii.get(strand, vertex)).collect::<Vec<_>>(),
    })
}

fn judge(python: &Path, pairs: &[(PathBuf, Value)]) {
    let mut command = Command::new(python);
    command.arg(workspace().join("tests/blender/usd.py"));
    for (file, expected) in pairs {
        let answer = PathBuf::from(format!("{}.json", file.display()));
        std::fs::write(&answer, expected.to_string()).unwrap();
        command.args([file, &answer]);
    }
    let run = command.output().unwrap();
    let (said, told) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert_eq!(run.status.code(), Some(0), "{said}{told}");
}

#[test]
fn blender_sees_every_strand_and_radius() {
    let Some(python) = blender() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut pairs = Vec::new();
    for sample in ["wavy.hair", "arrays/all.hair", "arrays/points-thickness.hair"] {
        let mut groom =
            groom_formats::read(&samples_dir().join(sample), &ReadOptions::default()).unwrap().groom;
        groom.up_axis = UpAxis::Z;
        for ending in ["usda", "usdc", "usdz"] {
            let path = folder.path().join(format!("{}.{ending}", sample.replace(['/', '.'], "-")));
            groom_formats::write(&groom, &path, &WriteOptions::default()).unwrap();
            pairs.push((path, expected(&groom)));
        }
    }
    judge(&python, &pairs);
}

#[test]
fn blender_sees_motion() {
    let Some(python) = blender() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groom =
        groom_formats::read(&samples_dir().join("arrays/all.hair"), &ReadOptions::default()).unwrap().groom;
    let moved = |frame: u32| -> Vec<glam::Vec3> {
        groom.positions().iter().map(|p| *p + glam::Vec3::X * frame as f32).collect()
    };
    let mut pairs = Vec::new();
    for ending in ["usda", "usdc"] {
        let path = folder.path().join(format!("moving-{ending}.{ending}"));
        let mut frames = (1..=4)
            .map(|frame| Ok(Frame { time: f64::from(frame), positions: moved(frame), ..Frame::default() }));
        groom_formats::write_animation(
            &groom,
            &mut frames,
            &MotionOptions::at_rate(24.0),
            &path,
            &WriteOptions::default(),
        )
        .unwrap();
        let mut answer = expected(&groom);
        answer["positions"] = json!(numbers(&moved(1)));
        answer["frames"] = json!({ "1": numbers(&moved(1)), "3": numbers(&moved(3)) });
        pairs.push((path, answer));
    }
    judge(&python, &pairs);
}
