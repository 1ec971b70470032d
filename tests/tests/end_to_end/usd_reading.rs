//! What groomkit reads from USD is what usd-core reads.

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{data_dir, say_skipped, validators};
use groom::{Attribute, Domain, Groom, Values};
use groom_formats::ReadOptions;
use serde_json::Value;

/// Exports a stage in every form, and prints what usd-core reads from its curves at their first time: control
/// points in the stage's space, counts, widths, and the tokens.
const SCRIPT: &str = r#"
import json, os, sys
import numpy as np
from pxr import Sdf, Usd, UsdGeom, UsdUtils

source, folder = sys.argv[1:]
stage = Usd.Stage.Open(source)
stem = os.path.splitext(os.path.basename(source))[0]
files = [source]
for ending in ("usda", "usdc"):
    files.append(os.path.join(folder, f"{stem}.{ending}"))
    stage.GetRootLayer().Export(files[-1])
files.append(os.path.join(folder, f"{stem}.usdz"))
UsdUtils.CreateNewUsdzPackage(files[-2], files[-1])
bits = lambda values, kind: np.ascontiguousarray(values, kind).view(np.uint32).ravel().tolist()
curves = []
for prim in stage.Traverse():
    if not prim.IsA(UsdGeom.BasisCurves) or UsdGeom.Imageable(prim).ComputePurpose() == "guide":
        continue
    curve = UsdGeom.BasisCurves(prim)
    times = curve.GetPointsAttr().GetTimeSamples()
    time = times[0] if times else Usd.TimeCode.Default()
    world = np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(prim))
    points = np.asarray(curve.GetPointsAttr().Get(time), np.float32).reshape(-1, 3)
    if not np.array_equal(world, np.eye(4)):
        points = (points.astype(np.float64) @ world[:3, :3] + world[3, :3]).astype(np.float32)
    widths = curve.GetWidthsAttr().Get(time)
    curves.append({
        "path": str(prim.GetPath()), "counts": list(curve.GetCurveVertexCountsAttr().Get(time)), "times": times,
        "points": bits(points, np.float32), "moved": not np.array_equal(world, np.eye(4)),
        "widths": None if widths is None else bits(widths, np.float32),
        "interpolation": str(curve.GetWidthsInterpolation()),
        "type": curve.GetTypeAttr().Get(), "basis": curve.GetBasisAttr().Get(), "wrap": curve.GetWrapAttr().Get(),
    })
json.dump({"files": files, "curves": curves, "up": str(UsdGeom.GetStageUpAxis(stage)),
           "unit": UsdGeom.GetStageMetersPerUnit(stage)}, sys.stdout)
"#;

fn run(python: &Path, script: &str, arguments: &[&Path]) -> Value {
    let output = Command::new(python).arg("-c").arg(script).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn floats(value: &Value) -> Vec<f32> {
    value.as_array().unwrap().iter().map(|bits| f32::from_bits(bits.as_u64().unwrap() as u32)).collect()
}

/// Stages of the real inputs that hold curves.
fn stages() -> Vec<PathBuf> {
    let Some(folder) = data_dir() else {
        say_skipped("the real USD files are not there; set GROOMKIT_DATA to the folder of real inputs");
        return Vec::new();
    };
    let names = ["BasisCurves1.usda", "BasisCurves2.usda", "bunnyCurves.usda", "bakeskinning/lbs.usda"];
    names.map(|name| folder.join("usd").join(name)).into()
}

/// Where the control points that a curve goes through are in the strands.
fn same_ends(groom: &Groom, curves: &[Value]) {
    let mut strand = 0;
    for curve in curves {
        let points = floats(&curve["points"]);
        let mut first = 0;
        for count in curve["counts"].as_array().unwrap() {
            let count = count.as_u64().unwrap() as usize;
            // A bezier curve ends with its last whole span.
            let bezier = curve["basis"] == "bezier" && curve["type"] == "cubic";
            let last = first + if bezier { (count - 1) / 3 * 3 } else { count - 1 };
            let ends = [&points[3 * first..3 * first + 3], &points[3 * last..3 * last + 3]];
            let found = groom.strand(strand);
            let linear = curve["type"] == "linear";
            if linear {
                let all: Vec<f32> = found.iter().flat_map(|point| point.to_array()).collect();
                assert_close(&all, &points[3 * first..3 * (first + count)], curve["moved"] == true);
            }
            if curve["wrap"] != "periodic" && (linear || curve["basis"] == "bezier") {
                assert_close(&found[0].to_array(), ends[0], curve["moved"] == true);
                assert_close(&found[found.len() - 1].to_array(), ends[1], curve["moved"] == true);
            }
            first += count;
            strand += 1;
        }
    }
    assert_eq!(strand, groom.strand_count());
}

/// Bit for bit; where the points were moved, numpy and glam may add in another order.
fn assert_close(found: &[f32], expected: &[f32], moved: bool) {
    let size = expected.iter().fold(1.0_f32, |size, value| size.max(value.abs()));
    let near = |(a, b): (&f32, &f32)| a.to_bits() == b.to_bits() || moved && (a - b).abs() <= 2e-7 * size;
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(near), "{found:?} {expected:?}");
}

#[test]
fn real_stages_in_every_form_have_the_numbers_of_usd_core() {
    let Some(python) = validators::python() else { return };
    for stage in stages() {
        let folder = tempfile::tempdir().unwrap();
        let report = run(&python, SCRIPT, &[&stage, folder.path()]);
        let curves = report["curves"].as_array().unwrap();
        let mut first: Option<Groom> = None;
        for file in report["files"].as_array().unwrap() {
            let loaded =
                groom_formats::read(Path::new(file.as_str().unwrap()), &ReadOptions::default()).unwrap();
            let groom = loaded.groom;
            assert_eq!(format!("{:?}", groom.up_axis), report["up"].as_str().unwrap());
            assert_eq!(groom.meters_per_unit, report["unit"].as_f64().unwrap());
            if let [only] = &curves[..] {
                let times: Vec<f64> =
                    only["times"].as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect();
                assert_eq!(loaded.times, if times.len() > 1 { times } else { Vec::new() });
                check_radii(&groom, only);
            }
            same_ends(&groom, curves);
            let first = first.get_or_insert_with(|| groom.clone());
            assert!(*first == groom, "{file} differs from {}", stage.display());
        }
    }
}

/// Radii of one prim that is not moved: half the widths, those of curves at every strand's ends.
fn check_radii(groom: &Groom, curve: &Value) {
    if curve["widths"].is_null() || curve["moved"] == true {
        return;
    }
    let widths = floats(&curve["widths"]);
    let Some(Attribute { domain, values: Values::Float(radii) }) = groom.attribute("radius") else {
        panic!("no radius");
    };
    match curve["interpolation"].as_str().unwrap() {
        "constant" => assert_eq!((domain, radii[0]), (&Domain::Groom, 0.5 * widths[0])),
        "uniform" => assert!(radii.iter().zip(&widths).all(|(r, w)| *r == 0.5 * w)),
        "vertex" => {
            let mut control = 0;
            for (strand, count) in curve["counts"].as_array().unwrap().iter().enumerate() {
                let range = groom.strand_range(strand);
                let count = count.as_u64().unwrap() as usize;
                assert_eq!(radii[range.start], 0.5 * widths[control]);
                assert_eq!(radii[range.end - 1], 0.5 * widths[control + count - 1]);
                control += count;
            }
        }
        // At the ends of spans, which bezier curves have every third point.
        "varying" => {
            assert_eq!((&curve["basis"], &curve["wrap"]), (&"bezier".into(), &"nonperiodic".into()));
            let mut first = 0;
            for (strand, count) in curve["counts"].as_array().unwrap().iter().enumerate() {
                let range = groom.strand_range(strand);
                let count = (count.as_u64().unwrap() as usize - 1) / 3 + 1;
                assert_eq!(radii[range.start], 0.5 * widths[first]);
                assert_eq!(radii[range.end - 1], 0.5 * widths[first + count - 1]);
                first += count;
            }
        }
        other => panic!("{other} is not tried here"),
    }
}

/// A stage with large arrays of every kind in a crate; prints the sums of what is in it.
const LARGE: &str = r#"
import json, sys
import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

stage = Usd.Stage.CreateNew(sys.argv[1])
prim = UsdGeom.BasisCurves.Define(stage, "/Hair")
n, random = 100_000, np.random.default_rng(7)
P = random.standard_normal((n, 3)).astype(np.float32)
prim.CreateTypeAttr("linear"); prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(P))
counts = np.full(n // 10, 10, np.int32); counts[::7] += 3; counts[1::7] -= 3
counts[-1] += n - counts.sum()
prim.CreateCurveVertexCountsAttr(Vt.IntArray.FromNumpy(counts))
prim.CreateWidthsAttr(Vt.FloatArray.FromNumpy(np.tile(np.float32([0.1, 0.2, 0.3, 0.4]), n // 4)))
api = UsdGeom.PrimvarsAPI(prim)
def primvar(name, kind, interpolation, values):
    api.CreatePrimvar(name, kind, interpolation).Set(values)
T = Sdf.ValueTypeNames
primvar("id", T.IntArray, "uniform", Vt.IntArray.FromNumpy(random.permutation(len(counts)).astype(np.int32)))
primvar("whole", T.FloatArray, "vertex", Vt.FloatArray.FromNumpy(np.arange(n).astype(np.float32)))
primvar("long", T.Int64Array, "uniform", Vt.Int64Array.FromNumpy(np.arange(len(counts)).astype(np.int64) * 3 - 11))
primvar("half", T.HalfArray, "vertex", Vt.HalfArray.FromNumpy(P[:, 0].astype(np.float16)))
primvar("table", T.HalfArray, "vertex", Vt.HalfArray.FromNumpy(np.tile(np.float16([0.5, 0.25]), n // 2)))
primvar("double", T.DoubleArray, "vertex", Vt.DoubleArray.FromNumpy(P[:, 1].astype(np.float64)))
primvar("steps", T.DoubleArray, "vertex", Vt.DoubleArray.FromNumpy(np.floor(P[:, 1] * 9).astype(np.float64)))
primvar("st", T.TexCoord2fArray, "uniform", Vt.Vec2fArray.FromNumpy(P[:len(counts), :2].copy()))
primvar("half3", T.Half3Array, "uniform", Vt.Vec3hArray.FromNumpy(P[:len(counts)].astype(np.float16)))
primvar("displayColor", T.Color3fArray, "uniform", Vt.Vec3fArray.FromNumpy(P[:3].copy()))
api.GetPrimvar("displayColor").SetIndices(Vt.IntArray.FromNumpy((np.arange(len(counts)) % 3).astype(np.int32)))
primvar("turns", T.QuatfArray, "constant", Vt.QuatfArray([Gf.Quatf(1, 2, 3, 4)] * 50))
primvar("frames", T.Matrix4dArray, "constant", Vt.Matrix4dArray([Gf.Matrix4d(1)] * 50))
primvar("words", T.TokenArray, "uniform", Vt.TokenArray(["a", "b"] * (len(counts) // 2)))
stage.GetRootLayer().Save()
bits = lambda values: np.ascontiguousarray(values, np.float32).view(np.uint32).ravel().tolist()
whole = {name: bits(np.asarray(api.GetPrimvar(name).ComputeFlattened())) for name in
         ("whole", "half", "table", "double", "steps", "st", "half3", "displayColor")}
ints = {name: np.asarray(api.GetPrimvar(name).Get()).tolist() for name in ("id", "long")}
json.dump({"points": bits(P), "counts": counts.tolist(), "values": whole, "ints": ints}, sys.stdout)
"#;

#[test]
fn large_arrays_of_every_kind_are_bit_equal() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    for ending in ["usdc", "usda"] {
        let path = folder.path().join(format!("large.{ending}"));
        let report = run(&python, LARGE, &[&path]);
        let loaded = groom_formats::read(&path, &ReadOptions::default()).unwrap();
        let groom = &loaded.groom;
        let points: Vec<f32> = groom.positions().iter().flat_map(|point| point.to_array()).collect();
        assert!(points == floats(&report["points"]), "points");
        let counts: Vec<u64> = groom.strands().map(|strand| strand.len() as u64).collect();
        assert_eq!(
            counts,
            report["counts"].as_array().unwrap().iter().map(|c| c.as_u64().unwrap()).collect::<Vec<_>>()
        );
        for (name, expected) in report["values"].as_object().unwrap() {
            let ours = match &**name {
                "st" => "root_uv",
                "displayColor" => "color",
                name => name,
            };
            let attribute = groom.attribute(ours).unwrap_or_else(|| panic!("{name} is missing"));
            let found: Vec<f32> = match &attribute.values {
                Values::Float(values) => values.clone(),
                Values::Vec2(values) => values.iter().flat_map(|v| v.to_array()).collect(),
                Values::Vec3(values) => values.iter().flat_map(|v| v.to_array()).collect(),
                Values::Int(_) => Vec::new(),
            };
            assert!(found == floats(expected), "{name}");
        }
        for (name, expected) in report["ints"].as_object().unwrap() {
            let Some(Attribute { values: Values::Int(found), .. }) = groom.attribute(name) else {
                panic!("{name} is missing")
            };
            assert_eq!(
                found.iter().map(|&v| i64::from(v)).collect::<Vec<_>>(),
                expected.as_array().unwrap().iter().map(|v| v.as_i64().unwrap()).collect::<Vec<_>>()
            );
        }
        // What a groom cannot hold is told.
        let told: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        for name in ["turns", "frames", "words"] {
            assert!(told.iter().any(|warning| warning.contains(&format!("primvars:{name}"))), "{told:?}");
        }
        assert_eq!(told.len(), 3);
    }
}
