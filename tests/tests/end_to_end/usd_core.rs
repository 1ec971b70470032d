//! What is left to usd-core's subprocess: it checks, bakes and packages, says what it missed, and how to install it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{data_file, program, samples_dir, validators};
use groom_formats::{ReadOptions, read};
use usd_core::{BakeOptions, Severity, UsdCore, UsdCoreError};

/// Two strands below a transform that moves one unit a frame.
const MOVING: &str = r#"#usda 1.0
(
    defaultPrim = "Root"
    endTimeCode = 3
    metersPerUnit = 0.01
    startTimeCode = 1
    timeCodesPerSecond = 24
    upAxis = "Z"
)
def Xform "Root"
{
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 3: (2, 0, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def BasisCurves "Hair"
    {
        uniform token type = "linear"
        int[] curveVertexCounts = [2, 2]
        point3f[] points = [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1)]
        float[] widths = [0.1] (interpolation = "constant")
        int[] primvars:id = [7, 9] (interpolation = "uniform")
    }
}
"#;

/// Points that a baked stage and another have at the times of the other; prints the largest distance in sizes of the
/// model, and how many prims were compared.
const COMPARE: &str = r#"
import sys
import numpy as np
from pxr import Usd, UsdGeom

ours, theirs = map(Usd.Stage.Open, sys.argv[1:])
worst, count = 0.0, 0
for prim in theirs.Traverse():
    if not prim.IsA(UsdGeom.PointBased):
        continue
    expected, found = (UsdGeom.PointBased(stage.GetPrimAtPath(prim.GetPath())).GetPointsAttr() for stage in (theirs, ours))
    count += 1
    for time in expected.GetTimeSamples() or [Usd.TimeCode.Default()]:
        world = np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(prim))
        points = np.asarray(expected.Get(time), float) @ world[:3, :3] + world[3, :3]
        size = np.linalg.norm(points.max(axis=0) - points.min(axis=0))
        worst = max(worst, np.linalg.norm(np.asarray(found.Get(time), float) - points, axis=1).max() / size)
print(worst, count)
"#;

/// Runs the converter in a folder that is not the checkout's, with this Python.
fn convert(python: &Path, folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(program("cyhair-convert"));
    command.args(arguments).current_dir(folder).env("GROOMKIT_PYTHON", python).output().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder with a groom as it comes from others and a stage that moves.
fn inputs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("moving.usda"), MOVING).unwrap();
    let sample = fs::read_dir(samples_dir()).unwrap().map(|entry| entry.unwrap().path());
    let hair = sample.filter(|path| path.extension().is_some_and(|ending| ending == "hair")).min().unwrap();
    fs::copy(hair, folder.path().join("in.hair")).unwrap();
    folder
}

#[test]
fn what_is_written_is_checked_from_any_folder() {
    let Some(python) = validators::python() else { return };
    let folder = inputs();
    for output in ["out.usda", "out.usdc", "out.usdz"] {
        let run = convert(&python, folder.path(), &["in.hair", output, "--check"]);
        assert_eq!(run.status.code(), Some(0), "{}", told(&run));
        assert!(told(&run).contains(&format!("check: {output}: 0 errors")), "{}", told(&run));
    }
}

#[test]
fn stages_are_baked_before_they_are_read() {
    let Some(python) = validators::python() else { return };
    let folder = inputs();
    let run = convert(&python, folder.path(), &["moving.usda", "out.usdc", "--bake", "--check"]);
    assert_eq!(run.status.code(), Some(0), "{}", told(&run));
    let read = |time| {
        let options = ReadOptions { time: Some(time), ..ReadOptions::default() };
        read(&folder.path().join("out.usdc"), &options).unwrap()
    };
    let loaded = read(2.0);
    assert_eq!(loaded.times, [1.0, 2.0, 3.0]);
    let xs = |time| read(time).groom.positions().iter().map(|point| point.x).collect::<Vec<_>>();
    assert_eq!(xs(1.0), [0.0, 0.0, 1.0, 1.0]);
    assert_eq!(xs(3.0), [2.0, 2.0, 3.0, 3.0]);
    assert_eq!(loaded.groom.attribute("id").unwrap().values, groom::Values::Int(vec![7, 9]));
}

#[test]
fn a_missing_package_is_told_with_how_to_install_it() {
    let folder = inputs();
    let nobody = PathBuf::from("/no/such/python");
    for arguments in [["in.hair", "out.usdc", "--check"], ["moving.usda", "out.usdc", "--bake"]] {
        let run = convert(&nobody, folder.path(), &arguments);
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        let told = told(&run);
        assert!(told.contains("pip install usd-core") && told.contains("/no/such/python"), "{told}");
        assert!(!folder.path().join("out.usdc").exists());
    }
    // Nothing else needs it.
    let run = convert(&nobody, folder.path(), &["in.hair", "out.usdc"]);
    assert_eq!(run.status.code(), Some(0), "{}", told(&run));
}

#[test]
fn findings_name_what_is_wrong() {
    if validators::python().is_none() {
        return;
    }
    let usd = UsdCore::find().unwrap();
    let folder = inputs();
    let path = folder.path().join("moving.usda");
    fs::write(&path, MOVING.replace("[2, 2]", "[2, 3]")).unwrap();
    let found = usd.check(&path).unwrap();
    let count = found.iter().find(|finding| finding.rule == "count").unwrap();
    assert_eq!((count.severity, &*count.place), (Severity::Error, "/Root/Hair"));
    fs::write(&path, "#usda 1.0\ndef {").unwrap();
    let Err(UsdCoreError::Failed { file, .. }) = usd.check(&path) else {
        panic!("a broken stage is checked")
    };
    assert!(file.ends_with("moving.usda"));
}

#[test]
fn baking_and_packaging_fail_aloud_and_leave_the_old_file() {
    if validators::python().is_none() {
        return;
    }
    let usd = UsdCore::find().unwrap();
    let folder = inputs();
    let [moving, broken, baked, package] =
        ["moving.usda", "broken.usda", "out.usda", "out.usdz"].map(|name| folder.path().join(name));
    let halves = BakeOptions { step: Some(0.5), frames: Some((1.0, 2.0)), ..BakeOptions::default() };
    usd.bake(&moving, &baked, halves).unwrap();
    assert_eq!(read(&baked, &ReadOptions::default()).unwrap().times, [1.0, 1.5, 2.0]);
    usd.package(&baked, &package).unwrap();
    assert_eq!(read(&package, &ReadOptions::default()).unwrap().groom.strand_count(), 2);
    let old = fs::read(&package).unwrap();
    fs::write(&broken, "#usda 1.0\ndef {").unwrap();
    assert!(matches!(usd.bake(&broken, &baked, halves), Err(UsdCoreError::Failed { .. })));
    assert!(matches!(usd.package(&broken, &package), Err(UsdCoreError::Failed { .. })));
    assert_eq!(fs::read(&package).unwrap(), old);
}

#[test]
fn skins_and_blend_shapes_are_baked_as_openusd_bakes_them() {
    let Some(python) = validators::python() else { return };
    let usd = UsdCore::find().unwrap();
    let folder = tempfile::tempdir().unwrap();
    for name in ["lbs", "blendshapes"] {
        let source = data_file(&format!("usd/bakeskinning/{name}.usda"));
        let expected = data_file(&format!("usd/bakeskinning/{name}.baked.usda"));
        let (Some(source), Some(expected)) = (source, expected) else { return };
        let ours = folder.path().join(format!("{name}.usdc"));
        usd.bake(&source, &ours, BakeOptions::default()).unwrap();
        let run = Command::new(&python).args(["-c", COMPARE]).args([&ours, &expected]).output().unwrap();
        assert!(run.status.success(), "{}", told(&run));
        let answer = String::from_utf8(run.stdout).unwrap();
        let (worst, count) = answer.trim().split_once(' ').unwrap();
        assert!(count.parse::<usize>().unwrap() > 0);
        assert!(worst.parse::<f64>().unwrap() < 1e-5, "{name}: {worst} of the model's size");
    }
}
