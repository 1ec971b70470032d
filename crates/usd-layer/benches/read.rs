//! How fast 1.25 million points with widths, velocities and colours are read from a crate and a text, against
//! usd-core doing the same in the same run. Prints megabytes a second of processor time and the ratio of the two.
//!
//! The files are made by usd-core in `target/venv`; without it there is nothing to compare with.

#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]

use std::hint::black_box;
use std::path::Path;
use std::process::Command;

use usd_layer::Layer;

/// Runs of which the best counts.
const RUNS: usize = 7;

/// Makes the file if it is not there, then prints the best seconds of reading it.
const SCRIPT: &str = r#"
import os, sys, time
import numpy as np
from pxr import Sdf, Usd, UsdGeom, Vt
path, runs = sys.argv[1], int(sys.argv[2])
if not os.path.exists(path):
    stage = Usd.Stage.CreateNew(path)
    curves = UsdGeom.BasisCurves.Define(stage, "/Hair")
    random = np.random.default_rng(1)
    P = random.standard_normal((1_250_000, 3)).astype(np.float32)
    curves.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(P))
    curves.CreateVelocitiesAttr(Vt.Vec3fArray.FromNumpy(P[::-1].copy()))
    curves.CreateWidthsAttr(Vt.FloatArray.FromNumpy(np.abs(P[:, 0]).copy()))
    curves.CreateCurveVertexCountsAttr(Vt.IntArray([25] * 50_000))
    stage.GetRootLayer().Save()
    del stage, curves
best = 1e9
for _ in range(runs):
    start = time.process_time()
    stage = Usd.Stage.Open(path)
    curves = UsdGeom.BasisCurves(stage.GetPrimAtPath("/Hair"))
    arrays = [np.array(a.Get()) for a in (curves.GetPointsAttr(), curves.GetVelocitiesAttr(), curves.GetWidthsAttr(), curves.GetCurveVertexCountsAttr())]
    best = min(best, time.process_time() - start)
    del stage, curves, arrays
print(best)
"#;

/// Seconds that this thread has had a processor: other programs on the machine do not count.
fn processor_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
}

fn seconds(path: &Path) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let start = processor_seconds();
        let layer = Layer::read(std::fs::read(path).unwrap()).unwrap();
        let prim = layer.prim("/Hair").unwrap();
        let value = |name: &str| prim.attribute(name).unwrap().default.as_ref().unwrap();
        black_box(layer.values::<f32, 3>(value("points")).unwrap());
        black_box(layer.values::<f32, 3>(value("velocities")).unwrap());
        black_box(layer.numbers::<f32>(value("widths")).unwrap());
        black_box(layer.numbers::<i32>(value("curveVertexCounts")).unwrap());
        best = best.min(processor_seconds() - start);
    }
    best
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let python = root.join("target/venv/bin/python");
    if !python.exists() {
        println!("skipped: {} is missing: run `cargo xtask setup`", python.display());
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    for (ending, runs) in [("usdc", RUNS), ("usda", 2)] {
        let path = folder.path().join(format!("hair.{ending}"));
        let output =
            Command::new(&python).args(["-c", SCRIPT]).arg(&path).arg(runs.to_string()).output().unwrap();
        let theirs: f64 = String::from_utf8_lossy(&output.stdout).trim().parse().unwrap();
        let size = std::fs::metadata(&path).unwrap().len() as f64 / 1e6;
        let ours = seconds(&path);
        println!(
            "{ending}: {size:.1} MB, {:.0} MB/s ({ours:.4} s); usd-core {:.0} MB/s ({theirs:.4} s); {:.2} of its time",
            size / ours,
            size / theirs,
            ours / theirs,
        );
    }
}
