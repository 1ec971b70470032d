//! cyhair-convert --report: its figures against those measured here.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::program;
use glam::DVec3;
use groom::Groom;
use groom_formats::ReadOptions;
use serde_json::Value;

fn sample() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../samples/curly.hair")
}

fn convert(folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(program("cyhair-convert"));
    program.current_dir(folder).arg(sample()).args(arguments).output().unwrap()
}

fn good(folder: &Path, arguments: &[&str]) {
    let run = convert(folder, arguments);
    assert!(run.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&run.stderr));
}

fn groom(path: &Path) -> Groom {
    groom_formats::read(path, &ReadOptions::default()).unwrap().groom
}

/// The farthest and the root mean square, from every point of `a` to the same strand of `b`, by looking at all segments.
fn one_way(a: &Groom, b: &Groom) -> Vec<f64> {
    let to_segment = |p: DVec3, (a, b): (DVec3, DVec3)| {
        let along = b - a;
        let t = if along == DVec3::ZERO {
            0.0
        } else {
            ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0)
        };
        p.distance(a + t * along)
    };
    let strands = a.strands().zip(b.strands());
    let far = strands.flat_map(|(from, to)| {
        let segments: Vec<_> = to.windows(2).map(|s| (s[0].as_dvec3(), s[1].as_dvec3())).collect();
        let nearest =
            move |p: DVec3| segments.iter().map(|&s| to_segment(p, s)).fold(f64::INFINITY, f64::min);
        from.iter().map(move |p| nearest(p.as_dvec3())).collect::<Vec<_>>()
    });
    far.collect()
}

/// Largest and root mean square distance, both ways.
fn distance(a: &Groom, b: &Groom) -> (f64, f64) {
    assert_eq!(a.strand_count(), b.strand_count());
    let all = [one_way(a, b), one_way(b, a)].concat();
    let squares = all.iter().map(|d| d * d).sum::<f64>();
    (all.iter().copied().fold(0.0, f64::max), (squares / all.len() as f64).sqrt())
}

fn close(found: &Value, expected: f64, what: &str) {
    let found = found.as_f64().unwrap();
    assert!((found - expected).abs() <= 1e-9 + 1e-6 * expected, "{what}: {found}, measured {expected}");
}

/// Holds one point of the report against a file that was written with the same options.
fn check(point: &Value, full: &Groom, file: &Path) {
    let label = point["label"].as_str().unwrap();
    let (max, rms) = distance(full, &groom(file));
    close(&point["error"], max, label);
    close(&point["more"]["rms distance"], rms, label);
    close(&point["more"]["bytes"], file.metadata().unwrap().len() as f64, label);
    close(&point["more"]["points"], groom(file).point_count() as f64, label);
    assert!(point["seconds"].as_f64().unwrap() > 0.0);
}

#[test]
fn figures_are_those_of_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let sweeps = ["--sweep-quantize", "6,10,14", "--sweep-tolerance", "0,0.002,0.05"];
    let asked = ["out.hair", "--quantize", "9", "--tolerance", "0.001", "--report", "report.json"];
    good(folder.path(), &[&asked[..], &sweeps[..]].concat());
    let report: Value = serde_json::from_slice(&std::fs::read(path("report.json")).unwrap()).unwrap();
    assert_eq!(report["schema"], "error-report/1");
    let series = |label: &str| {
        let all = report["series"].as_array().unwrap();
        all.iter().find(|s| s["label"] == label).unwrap()["points"].as_array().unwrap().clone()
    };
    let full = groom(&sample());
    check(&series("not reduced")[0], &full, &sample());
    check(&series("as asked")[0], &full, &path("out.hair"));
    for (point, bits) in series("--quantize").iter().zip(["6", "10", "14"]) {
        assert_eq!(point["label"], format!("--tolerance 0.001 --quantize {bits}"));
        good(folder.path(), &["one.hair", "--tolerance", "0.001", "--quantize", bits]);
        check(point, &full, &path("one.hair"));
    }
    let tolerances = series("--tolerance");
    for (point, tolerance) in tolerances.iter().zip(["0", "0.002", "0.05"]) {
        good(folder.path(), &["one.hair", "--tolerance", tolerance, "--quantize", "9"]);
        check(point, &full, &path("one.hair"));
    }
    let bytes = |point: &Value| point["more"]["bytes"].as_f64().unwrap();
    assert!(bytes(&tolerances[2]) < bytes(&tolerances[0]), "a looser tolerance leaves fewer bytes");
}

#[test]
fn edits_before_are_not_counted_as_error() {
    let folder = tempfile::tempdir().unwrap();
    good(folder.path(), &["moved.hair", "--translate", "1,2,3", "--resample", "9"]);
    let asked = ["out.hair", "--translate", "1,2,3", "--resample", "9", "--tolerance", "0.01"];
    good(folder.path(), &[&asked[..], &["--report", "r.json"]].concat());
    let report: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("r.json")).unwrap()).unwrap();
    let full = groom(&folder.path().join("moved.hair"));
    assert_eq!(report["series"][0]["points"][0]["error"], 0.0);
    check(&report["series"][1]["points"][0], &full, &folder.path().join("out.hair"));
}

#[test]
fn reports_have_three_endings_and_binary_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for output in ["o.glb", "o.gltf", "o.usdc", "o.txt"] {
        good(folder.path(), &[output, "--quantize", "12", "--report", "r.html", "--sweep-tolerance", "0.01"]);
        let page = std::fs::read_to_string(path("r.html")).unwrap();
        assert!(page.contains("<svg") && page.contains("--quantize 12"), "{output}");
    }
    good(folder.path(), &["o.hair", "--report", "r.csv"]);
    let table = std::fs::read_to_string(path("r.csv")).unwrap();
    assert!(table.lines().next().unwrap().ends_with("seconds,error,bytes,points,rms distance"), "{table}");
    assert_eq!(table.lines().count(), 2);
}

#[test]
fn a_report_nobody_can_read_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, told) in [
        (&["o.hair", "--report", "r.pdf"][..], "expected an ending among .html, .csv, .json"),
        (&["o.hair", "--sweep-quantize", "8"], "--report"),
        (&["o.hair", "--report", "r.csv", "--sweep-quantize", "8,25"], "25"),
        (&["o.hair", "--report", "r.csv", "--sweep-tolerance", "0.1,-1"], "-1"),
    ] {
        let run = convert(folder.path(), arguments);
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        let words = String::from_utf8_lossy(&run.stderr);
        assert!(words.contains(told), "{words}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
