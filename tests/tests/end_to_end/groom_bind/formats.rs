//! The outputs: all hold the same motion, and other people's programs find them sound.

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{validators, workspace};
use groom::UpAxis;
use groom_formats::{ReadOptions, WriteOptions, read, write};

use super::support::{Seen, attempt, bind, bind_json, farthest, frames, hair, head, names_in, three_strands};

const FRAMES: &str = "2-6:2";

/// Sixty strands on the nodding head, written as `name`.
fn nod(folder: &Path, name: &str, options: &[&str]) -> PathBuf {
    let small = folder.join("small.usda");
    if !small.exists() {
        let options = ReadOptions { up_axis: Some(UpAxis::Y), ..ReadOptions::default() };
        let groom = read(hair("curly.hair").as_ref(), &options).unwrap().groom;
        write(&groom.subsample_to(60), &small, &WriteOptions::default()).unwrap();
    }
    let mesh = head();
    let arguments = ["small.usda", "--mesh", &mesh, "--frames", FRAMES, "-o", name];
    bind(folder, &[&arguments[..], options].concat());
    folder.join(name)
}

#[test]
fn every_format_holds_the_same_motion() {
    let folder = tempfile::tempdir().unwrap();
    let (_, expected) = frames(&nod(folder.path(), "a.usdc", &[]));
    assert_eq!(expected.iter().map(|frame| frame.time).collect::<Vec<_>>(), [2.0, 4.0, 6.0]);
    for name in ["b.usda", "b.usdz", "b.abc"] {
        let (loaded, seen) = frames(&nod(folder.path(), name, &[]));
        assert_eq!(loaded.frame_rate, Some(24.0), "{name}");
        for (seen, expected) in seen.iter().zip(&expected) {
            assert_eq!(seen.time, expected.time, "{name}");
            assert!(seen.positions == expected.positions, "{name}, frame {}", seen.time);
            assert!(seen.velocities == expected.velocities, "{name}, frame {}", seen.time);
        }
    }
    nod(folder.path(), "c.####.hair", &[]);
    nod(folder.path(), "c.##.txt", &[]);
    for frame in &expected {
        for name in [format!("c.{:04}.hair", frame.time), format!("c.{:02}.txt", frame.time)] {
            let still = read(&folder.path().join(&name), &ReadOptions::default()).unwrap().groom;
            assert!(still.positions() == frame.positions, "{name}");
        }
    }
    let written: Vec<_> = names_in(folder.path()).into_iter().filter(|n| n.starts_with("c.")).collect();
    assert_eq!(written, ["c.0002.hair", "c.0004.hair", "c.0006.hair", "c.02.txt", "c.04.txt", "c.06.txt"]);
}

#[test]
fn a_still_format_takes_one_frame() {
    let folder = tempfile::tempdir().unwrap();
    let (_, expected) = frames(&nod(folder.path(), "a.usdc", &[]));
    let mesh = head();
    bind(folder.path(), &["small.usda", "--mesh", &mesh, "--frames", "4", "-o", "four.hair"]);
    let still = read(&folder.path().join("four.hair"), &ReadOptions::default()).unwrap().groom;
    assert!(still.positions() == expected[1].positions);
    let refused = attempt(folder.path(), &["small.usda", "--mesh", &mesh, "-o", "many.hair"]);
    let words = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2));
    assert!(words.contains("there are 25") && words.contains("many.####.hair"), "{words}");
}

/// Prints, for each time, the greatest distance from what OpenUSD makes of points and velocities at a frame to the
/// points that were written for a time beside it; and how far those are from the frame's.
const BETWEEN_FRAMES: &str = r#"
import sys
import numpy as np
from pxr import Usd, UsdGeom

coarse, fine = map(Usd.Stage.Open, sys.argv[1:3])
frame, time = map(float, sys.argv[3:5])
assert coarse.GetTimeCodesPerSecond() == 24
def curves(stage):
    return next(UsdGeom.BasisCurves(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves))
made = np.array(curves(coarse).ComputePointsAtTime(Usd.TimeCode(time), Usd.TimeCode(frame)))
there = np.array(curves(fine).GetPointsAttr().Get(time))
before = np.array(curves(fine).GetPointsAttr().Get(frame))
print(np.abs(made - there).max(), np.abs(before - there).max())
"#;

#[test]
fn openusd_finds_the_points_between_frames_by_their_velocities() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("straight.hair"));
    let common = [&hair, "--mesh", &mesh, "--up", "y", "--frames"];
    bind(folder.path(), &[&common[..], &["3-5", "--accelerations", "-o", "coarse.usdc"]].concat());
    bind(folder.path(), &[&common[..], &["3-5:0.125", "--no-velocity", "-o", "fine.usdc"]].concat());
    for time in ["3.875", "4.25", "4.125"] {
        let run = Command::new(&python)
            .args(["-c", BETWEEN_FRAMES, "coarse.usdc", "fine.usdc", "4", time])
            .current_dir(folder.path())
            .output()
            .unwrap();
        let (said, told) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        assert!(run.status.success(), "{told}");
        let numbers: Vec<f64> = said.split_whitespace().map(|word| word.parse().unwrap()).collect();
        // A key of the joints is at the frame: a corner in their motion, which differences round off. With the
        // wrong sign it would be twice the way, with the wrong unit many times.
        assert!(numbers[0] < 0.25 * numbers[1] && numbers[1] > 1e-4, "{time}: {numbers:?}");
    }
}

#[test]
fn openusd_skins_the_strands_as_far_off_as_the_program_says() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (_, carried) = frames(&nod(folder.path(), "carried.usdc", &[]));
    let mesh = head();
    let arguments = ["small.usda", "--mesh", &mesh, "--frames", FRAMES, "--as-skinned", "-o", "skinned.usdc"];
    let told = bind_json(folder.path(), &arguments)["skinned_error"].as_f64().unwrap();
    let bake = workspace().join("tools/usd/bake.py");
    let names = ["skinned.usdc", "baked.usdc"];
    let run = Command::new(python).arg(bake).args(names).current_dir(folder.path()).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let (_, baked) = frames(&folder.path().join("baked.usdc"));
    let distance = |frame: &Seen| {
        let same = baked.iter().find(|baked| baked.time == frame.time).unwrap();
        farthest(&same.positions, &frame.positions)
    };
    let found = carried.iter().map(distance).fold(0.0, f32::max);
    // USD keeps scales of joints in 16 bits; the morph of the scalp is what joints do not know.
    assert!((f64::from(found) - told).abs() < 0.02 * told, "{found}, told {told}");
    assert!(told < 0.03, "{told}");
}

#[test]
fn other_programs_find_nothing_wrong() {
    let (Some(python), Some(modules), Some(node)) =
        (validators::python(), validators::gltf(), validators::node())
    else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let attributes = ["--root-uv", "--root-normal", "--color-from-mesh", "--group-by-material"];
    let mut stages = vec![
        nod(folder.path(), "a.usda", &attributes),
        nod(folder.path(), "a.usdc", &["--accelerations"]),
        nod(folder.path(), "a.usdz", &["--shutter-samples", "2"]),
    ];
    let mut assets = vec![end_to_end_tests::samples_dir().join("nodding_head.glb")];
    stages.push(nod(folder.path(), "skinned.usdc", &["--as-skinned"]));
    assets.push(nod(folder.path(), "skinned.glb", &["--as-skinned"]));
    assets.push(nod(folder.path(), "morphs.glb", &attributes));
    assets.push(nod(folder.path(), "morphs.gltf", &[]));
    let passes = |command: &mut Command| {
        let run = command.output().unwrap();
        let (said, told) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        assert_eq!(run.status.code(), Some(0), "{said}{told}");
    };
    passes(Command::new(python).arg(workspace().join("tools/usd/check.py")).args(&stages));
    let script = workspace().join("tests/validators/check_gltf.mjs");
    passes(Command::new(node).arg(script).arg("--modules").arg(modules).args(&assets));
}

#[test]
fn a_character_far_away_keeps_the_shape_of_its_strands() {
    let folder = tempfile::tempdir().unwrap();
    let (_, groom) = three_strands(folder.path());
    let offset = glam::Vec3::new(1e6, 0.0, -2e6);
    super::support::moving_square(folder.path(), 2, |_, corner| corner + offset);
    // Bound at home, carried far away.
    std::fs::write(folder.path().join("square.0000.obj"), super::support::square(|corner| corner)).unwrap();
    bind(
        folder.path(),
        &["three.usda", "--mesh", "square.####.obj", "--rest", "0", "--frames", "1", "-o", "out.usda"],
    );
    let text = std::fs::read_to_string(folder.path().join("out.usda")).unwrap();
    assert!(text.contains("xformOp:translate") && text.contains("1000000"), "{}", &text[..2000]);
    // A reader of ours adds the transform, in 32 bits; the file's own points are as they were.
    let shape = farthest_shape(&text, &groom);
    assert!(shape < 1e-6, "{shape}");
}

/// How far segments in the file's text are from those of `groom`.
fn farthest_shape(text: &str, groom: &groom::Groom) -> f32 {
    let (_, points) = text.split_once("point3f[] points.timeSamples").unwrap();
    let (points, _) = points.split_once(']').unwrap();
    let numbers: Vec<f32> = points
        .split(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c)))
        .filter_map(|word| word.parse().ok())
        .skip(1) // the time
        .collect();
    let points: Vec<glam::Vec3> = numbers.as_chunks::<3>().0.iter().map(|&p| p.into()).collect();
    let relative = |points: &[glam::Vec3]| -> Vec<glam::Vec3> {
        points
            .chunks(4)
            .flat_map(|strand| strand.iter().map(|p| *p - strand[0]).collect::<Vec<_>>())
            .collect()
    };
    farthest(&relative(&points), &relative(groom.positions()))
}
