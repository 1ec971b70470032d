//! What cyhair-convert writes, judged by other people's programs: usd-core and the Khronos validator.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{data_file, program, samples_dir, validators, workspace};
use groom::{Groom, UpAxis, names};
use groom_formats::ReadOptions;
use serde_json::Value;

/// Every committed sample, and the real inputs that are there.
fn inputs() -> Vec<PathBuf> {
    let mut found = hair_files(&samples_dir());
    found.extend(hair_files(&samples_dir().join("arrays")));
    found.sort();
    found.extend(["hair/straight.hair", "hair/bear_fur.hair"].into_iter().filter_map(data_file));
    assert!(!found.is_empty(), "no sample to convert");
    found
}

fn hair_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|path| path.extension().is_some_and(|ending| ending == "hair")).collect()
}

fn convert(input: &Path, output: &Path, options: &[&str]) -> Option<Value> {
    let run = Command::new(program("cyhair-convert"))
        .args([input, output])
        .arg("--json")
        .args(options)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&run.stderr);
    // A sample without geometry has nothing to judge.
    if told.contains("no points array") {
        assert_eq!(run.status.code(), Some(2));
        return None;
    }
    assert_eq!(run.status.code(), Some(0), "{}: {told}", input.display());
    Some(serde_json::from_slice(&run.stdout).unwrap())
}

fn passes(run: &Output) {
    let (said, told) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert_eq!(run.status.code(), Some(0), "{said}{told}");
}

#[test]
fn gltf_passes_the_khronos_validator() {
    let Some(modules) = validators::gltf() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut written = Vec::new();
    for (number, input) in inputs().iter().enumerate() {
        for ending in ["glb", "gltf"] {
            let output = folder.path().join(format!("hair {number}.{ending}"));
            if convert(input, &output, &["--meters-per-unit", "0.00254"]).is_some() {
                written.push(output);
            }
        }
    }
    let script = workspace().join("tests/validators/check_gltf.mjs");
    let run = Command::new("node").arg(script).arg("--modules").arg(modules).args(&written).output().unwrap();
    passes(&run);
}

#[test]
fn usda_passes_usd_core() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut written = Vec::new();
    for (number, input) in inputs().iter().enumerate() {
        let output = folder.path().join(format!("{number}.usda"));
        if convert(input, &output, &[]).is_some() {
            written.push(output);
        }
    }
    let run =
        Command::new(python).arg(workspace().join("tools/usd/check.py")).args(&written).output().unwrap();
    passes(&run);
}

#[test]
fn the_usd_rules_find_what_is_wrong() {
    let Some(python) = validators::python() else { return };
    let run = Command::new(python)
        .args(["-m", "unittest", "discover"])
        .current_dir(workspace().join("tools/usd"))
        .output()
        .unwrap();
    passes(&run);
}

#[test]
fn usd_core_reads_the_grooms_own_bits() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    for input in inputs() {
        let output = folder.path().join("a.usda");
        if convert(&input, &output, &["--up", "y", "--meters-per-unit", "0.00254"]).is_none() {
            continue;
        }
        let run =
            Command::new(&python).arg(workspace().join("tools/usd/dump.py")).arg(&output).output().unwrap();
        passes(&run);
        let mut groom = groom_formats::read(&input, &ReadOptions::default()).unwrap().groom;
        groom.turn_to(UpAxis::Y);
        same(&serde_json::from_slice(&run.stdout).unwrap(), &drawable(groom));
    }
}

/// Without the strands of one point, which USD cannot hold.
fn drawable(groom: Groom) -> Groom {
    if groom.strands().all(|points| points.len() > 1) {
        return groom;
    }
    let mut groom = groom;
    groom.repair();
    groom
}

fn same(stage: &Value, groom: &Groom) {
    assert_eq!((&stage["defaultPrim"], &stage["upAxis"]), (&"Groom".into(), &"Y".into()));
    assert_eq!(stage["metersPerUnit"], 0.00254);
    let curves = &stage["curves"][0];
    assert_eq!(curves["path"], "/Groom/Strands");
    assert_eq!(
        (&curves["type"], &curves["wrap"], &curves["widthsInterpolation"]),
        (&"linear".into(), &"nonperiodic".into(), &"vertex".into())
    );
    let bits = |values: &Value| -> Vec<u32> {
        values.as_array().unwrap().iter().map(|v| v.as_u64().unwrap() as u32).collect()
    };
    let counts: Vec<u32> = groom.strands().map(|points| points.len() as u32).collect();
    assert_eq!(bits(&curves["curveVertexCounts"]), counts);
    let points: Vec<u32> = groom.positions().iter().flat_map(|p| p.to_array()).map(f32::to_bits).collect();
    assert!(bits(&curves["points"]) == points, "points differ");
    let (mut widths, mut colors) = (Vec::new(), Vec::new());
    let view = groom.colors().unwrap();
    for strand in 0..groom.strand_count() {
        for vertex in groom.strand_range(strand) {
            widths.push((2.0 * groom.radii().get(strand, vertex)).to_bits());
            colors.extend(view.get(strand, vertex).to_array().map(f32::to_bits));
        }
    }
    assert!(bits(&curves["widths"]) == widths, "widths differ");
    let color = &curves["primvars"]["displayColor"];
    let expected = if color["interpolation"] == "constant" { &colors[..3] } else { &colors[..] };
    assert!(bits(&color["values"]) == expected, "displayColor differs");
    assert!(groom.attribute(names::TRANSPARENCY).is_some());
    assert!(curves["primvars"]["displayOpacity"]["values"].is_array());
}
