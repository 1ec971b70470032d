//! What cyhair-convert writes, judged by other people's programs: usd-core and the Khronos validator.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{data_file, program, samples_dir, validators, workspace};
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};
use groom_formats::{ReadOptions, WriteOptions};
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
    let (Some(modules), Some(node)) = (validators::gltf(), validators::node()) else { return };
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
    let run = Command::new(node).arg(script).arg("--modules").arg(modules).args(&written).output().unwrap();
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
        .args(["-B", "-m", "unittest", "discover"])
        .current_dir(workspace().join("tools/usd"))
        .output()
        .unwrap();
    passes(&run);
    // Older Pythons are content when they find no test.
    let told = String::from_utf8_lossy(&run.stderr);
    assert!(told.contains("OK") && !told.contains("Ran 0 tests"), "{told}");
}

#[test]
fn usd_core_reads_the_grooms_own_bits() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut written = Vec::new();
    for (number, input) in inputs().into_iter().enumerate() {
        let output = folder.path().join(format!("{number}.usda"));
        if convert(&input, &output, &["--up", "y", "--meters-per-unit", "0.00254"]).is_some() {
            written.push((input, output));
        }
    }
    for ((input, _), stage) in written.iter().zip(dump(&python, written.iter().map(|(_, output)| output))) {
        let mut groom = groom_formats::read(input, &ReadOptions::default()).unwrap().groom;
        groom.turn_to(UpAxis::Y);
        same(&stage, &drawable(groom));
    }
}

#[test]
fn usd_core_reads_every_attribute_whatever_its_name() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usda");
    let points = (0..5).map(|i| [i as f32 * 0.1, -1e-20, 1e20].into()).collect();
    let mut groom = Groom::new(vec![0, 2, 5], points).unwrap();
    groom.meters_per_unit = 1e-7;
    let mut set =
        |name: &str, domain, values| groom.set_attribute(name, Attribute { domain, values }).unwrap();
    set("2nd clump-id", Domain::Strand, Values::Int(vec![i32::MIN, i32::MAX]));
    set(
        "haar länge:\"}",
        Domain::Vertex,
        Values::Float(vec![f32::NAN, f32::INFINITY, -f32::MAX, -0.0, 1e-45]),
    );
    set("def", Domain::Groom, Values::Vec2(vec![[0.1, 16_777_217.0].into()]));
    set(
        "widths",
        Domain::Strand,
        Values::Vec3(vec![[1e-7, 1e16, 3.0].into(), [f32::NEG_INFINITY, 0.0, 1.0].into()]),
    );
    set(names::ID, Domain::Strand, Values::Int(vec![-1, 7]));
    let told = groom_formats::write(&groom, &path, &WriteOptions::default()).unwrap();
    assert_eq!(told.len(), 3, "{told:?}");
    passes(&Command::new(&python).arg(workspace().join("tools/usd/check.py")).arg(&path).output().unwrap());
    let stage = dump(&python, [&path]).remove(0);
    assert_eq!(stage["metersPerUnit"], 1e-7);
    let found = &stage["curves"][0]["primvars"];
    let is = |name: &str, kind: &str, interpolation: &str, values: &[u32]| {
        let primvar = &found[name];
        assert_eq!(
            (&primvar["type"], &primvar["interpolation"]),
            (&kind.into(), &interpolation.into()),
            "{name}"
        );
        assert_eq!(bits(&primvar["values"]), values, "{name}");
    };
    is("_2nd_clump_id", "int[]", "uniform", &[i32::MIN as u32, i32::MAX as u32]);
    is(
        "haar_l_nge___",
        "float[]",
        "vertex",
        &[f32::NAN, f32::INFINITY, -f32::MAX, -0.0, 1e-45].map(f32::to_bits),
    );
    is("def", "float2[]", "constant", &[0.1_f32, 16_777_217.0].map(f32::to_bits));
    let vectors = [1e-7_f32, 1e16, 3.0, f32::NEG_INFINITY, 0.0, 1.0].map(f32::to_bits);
    is("widths_2", "float3[]", "uniform", &vectors);
    is("id", "int[]", "uniform", &[u32::MAX, 7]);
}

/// What usd-core sees in the files, asked in one run of Python.
fn dump<'a>(python: &Path, files: impl IntoIterator<Item = &'a PathBuf>) -> Vec<Value> {
    let run = Command::new(python).arg(workspace().join("tools/usd/dump.py")).args(files).output().unwrap();
    passes(&run);
    serde_json::from_slice(&run.stdout).unwrap()
}

/// 32-bit values from the hexadecimal digits of their bytes.
fn bits(values: &Value) -> Vec<u32> {
    let digits = values.as_str().unwrap().as_bytes();
    assert!(digits.len().is_multiple_of(8));
    let word = |eight: &[u8]| u32::from_str_radix(std::str::from_utf8(eight).unwrap(), 16).unwrap();
    digits.chunks(8).map(word).collect()
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
    assert!(curves["primvars"]["displayOpacity"]["values"].is_string());
}
