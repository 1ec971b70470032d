//! Real hair on real characters, where the data is there.

use std::path::Path;

use end_to_end_tests::{data_file, run};
use glam::Vec3;
use groom::Groom;
use groom_formats::{ReadOptions, read};
use serde_json::Value;

use super::support::{bind_json, frames};

/// Tenths of an inch, z up, made for a face that looks along +y and a head that is rounder: found by looking.
const YUKSEL_TO_FACE: &str = "-0.00254,0,0,0, 0,0,0.00254,0.012, 0,0.00254,0,-0.04, 0,0,0,1";

/// Binds, and holds roots and lengths against what must be; returns what the program says.
fn carry(folder: &Path, arguments: &[&str]) -> Value {
    let output = folder.join("out.usdc");
    let name = output.display().to_string();
    let done = bind_json(folder, &[arguments, &["-o", &name]].concat());
    let size = done["mesh_size"].as_f64().unwrap();
    let error = done["root_error"].as_f64().unwrap();
    assert!(error <= 1e-5 * size, "a root is {error} off, on a mesh of {size}");
    // Where limbs fold, some triangles turn over.
    assert!(done["held"].as_u64().unwrap() * 20 <= done["strands"].as_u64().unwrap(), "{done}");
    let (loaded, seen) = frames(&output);
    assert_eq!(seen.len() as u64, done["frames"].as_u64().unwrap());
    let lengths = |positions: &[Vec3]| lengths(&loaded.groom, positions);
    let first = lengths(&seen[0].positions);
    for frame in &seen {
        assert!(frame.positions.iter().chain(frame.velocities.iter().flatten()).all(|p| p.is_finite()));
        let longest = first.iter().fold(0.0, |a: f64, b| a.max(*b));
        for (now, then) in lengths(&frame.positions).iter().zip(&first) {
            // Points are stored in 32 bits: a step there is 6e-8 of how far they are from the origin.
            assert!((now - then).abs() < 1e-6 * size.max(longest), "frame {}: {now}, {then}", frame.time);
        }
    }
    done
}

fn lengths(groom: &Groom, positions: &[Vec3]) -> Vec<f64> {
    let strands = (0..groom.strand_count()).map(|strand| &positions[groom.strand_range(strand)]);
    strands.flat_map(|points| points.windows(2).map(|w| w[0].as_dvec3().distance(w[1].as_dvec3()))).collect()
}

fn near(value: &Value, expected: f64) {
    let value = value.as_f64().unwrap();
    assert!((value - expected).abs() < 0.05 * expected, "{value}, expected {expected}");
}

#[test]
fn straight_hair_on_a_face() {
    let (Some(hair), Some(mesh)) = (data_file("hair/straight.hair"), data_file("meshes/jolt_face.glb"))
    else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let (hair, mesh) = (hair.display().to_string(), mesh.display().to_string());
    let common = [&hair, "--mesh", &mesh, "--matrix", YUKSEL_TO_FACE];
    let done = carry(folder.path(), &[&common[..], &["--frames", "0-359:60"]].concat());
    near(&done["distance"]["median"], 0.0054);
    near(&done["distance"]["max"], 0.0173);
    assert_eq!((done["strands"].as_u64(), done["frame_rate"].as_f64()), (Some(10_000), Some(30.0)));
    assert_eq!(done["warnings"].as_array().unwrap().len(), 0, "{done}");
}

#[test]
fn the_bears_fur_on_the_walking_bear() {
    let (Some(fur), Some(mesh)) = (data_file("hair/bear_fur.hair"), data_file("meshes/tressfx_bear.glb"))
    else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let (fur, mesh) = (fur.display().to_string(), mesh.display().to_string());
    let done = carry(folder.path(), &[&fur, "--mesh", &mesh, "--up", "y", "--frames", "0-40:8"]);
    near(&done["distance"]["median"], 0.36);
    near(&done["distance"]["max"], 4.67);
    assert_eq!(done["strands"], 48_113);
}

#[test]
fn grown_fur_on_the_running_fox() {
    let Some(mesh) = data_file("meshes/Fox.glb") else { return };
    let folder = tempfile::tempdir().unwrap();
    let mesh = mesh.display().to_string();
    let fur = folder.path().join("fur.hair").display().to_string();
    let made = run("groom-samples", &["fur", "--mesh", &mesh, "--strands", "5000", "-o", &fur]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let done = carry(
        folder.path(),
        &[
            &fur,
            "--mesh",
            &mesh,
            "--up",
            "y",
            "--rest",
            "nodes",
            "--animation",
            "Run",
            "--frames",
            "0-27:3",
            "--fps",
            "24",
        ],
    );
    // It grows where it is bound.
    let (size, most) = (done["mesh_size"].as_f64().unwrap(), done["distance"]["max"].as_f64().unwrap());
    assert!(most < 1e-6 * size, "{most} on a mesh of {size}");
    let rest = read(fur.as_ref(), &ReadOptions::default()).unwrap().groom;
    assert_eq!(done["strands"].as_u64(), Some(rest.strand_count() as u64));
}
