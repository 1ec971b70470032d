//! glTF files as other programs see them: the Khronos validator and Blender.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{data_file, samples_dir, say_skipped, validators, workspace};
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Mesh, ReadOptions, WriteOptions, read, write};

/// Every way to write, by name.
fn ways() -> Vec<(&'static str, WriteOptions)> {
    let plain = WriteOptions::default;
    let mesh = |mesh| WriteOptions { mesh: Some(mesh), ..plain() };
    vec![
        ("lines", plain()),
        ("all", WriteOptions { all_attributes: true, ..plain() }),
        ("12 bits", WriteOptions { quantize: Some(12), ..plain() }),
        ("20 bits", WriteOptions { quantize: Some(20), ..plain() }),
        ("16 bits, all", WriteOptions { quantize: Some(16), all_attributes: true, ..plain() }),
        ("tubes", mesh(Mesh::Tubes { sides: 3 })),
        ("tubes, 12 bits", WriteOptions { quantize: Some(12), ..mesh(Mesh::Tubes { sides: 4 }) }),
        ("ribbons", mesh(Mesh::Ribbons)),
        (
            "ribbons, 16 bits, all",
            WriteOptions { quantize: Some(16), all_attributes: true, ..mesh(Mesh::Ribbons) },
        ),
    ]
}

/// Samples and real hair that can be drawn, in metres.
fn grooms() -> Vec<Groom> {
    let folders = [samples_dir(), samples_dir().join("arrays")];
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "hair"));
    paths.sort();
    paths.extend(["hair/straight.hair", "hair/bear_fur.hair"].into_iter().filter_map(data_file));
    let options = ReadOptions { meters_per_unit: Some(0.00254), ..ReadOptions::default() };
    // One sample has no points.
    let mut grooms: Vec<Groom> =
        paths.iter().filter_map(|path| read(path, &options).ok()).map(|loaded| loaded.groom).collect();
    assert!(!grooms.is_empty(), "no sample to write");
    grooms.push(dressed());
    grooms
}

/// Two strands with every standard attribute and others.
fn dressed() -> Groom {
    let points = (0..7).map(|i| [0.1 * i as f32, 0.02 * (i * i) as f32, 0.3].into()).collect();
    let mut groom = Groom::new(vec![0, 3, 7], points).unwrap();
    let mut set =
        |name: &str, domain, values| groom.set_attribute(name, Attribute { domain, values }).unwrap();
    set(names::RADIUS, Domain::Vertex, Values::Float((1..8).map(|i| i as f32 * 1e-3).collect()));
    set(names::COLOR, Domain::Strand, Values::Vec3(vec![[1.0, 0.5, 0.0].into(), [0.0, 0.2, 1.0].into()]));
    set(names::TRANSPARENCY, Domain::Groom, Values::Float(vec![0.4]));
    set(names::ID, Domain::Strand, Values::Int(vec![-7, 1 << 20]));
    set(names::GROUP, Domain::Strand, Values::Int(vec![1, 2]));
    set(names::ROOT_UV, Domain::Strand, Values::Vec2(vec![[0.25, 0.5].into(), [2.0, -1.0].into()]));
    set(names::VELOCITY, Domain::Vertex, Values::Vec3(vec![[0.0, -3.0, 1.0].into(); 7]));
    set("curl #2", Domain::Vertex, Values::Float((0..7).map(|i| i as f32).collect()));
    groom
}

fn passes(run: &Output) {
    let (said, told) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert_eq!(run.status.code(), Some(0), "{said}{told}");
}

#[test]
fn every_way_of_writing_passes_the_khronos_validator() {
    let (Some(modules), Some(node)) = (validators::gltf(), validators::node()) else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut written = Vec::new();
    for (number, groom) in grooms().iter().enumerate() {
        for (way, options) in ways() {
            let ending = if number % 3 == 1 { "gltf" } else { "glb" };
            let path = folder.path().join(format!("{number}, {way}.{ending}"));
            write(groom, &path, &options).unwrap();
            written.push(path);
        }
    }
    let script = workspace().join("tests/validators/check_gltf.mjs");
    let run = Command::new(node).arg(script).arg("--modules").arg(modules).args(&written).output().unwrap();
    passes(&run);
}

#[test]
fn real_hair_comes_back_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    for (number, mut groom) in grooms().into_iter().enumerate() {
        groom.repair();
        groom.turn_to(groom::UpAxis::Y);
        groom.meters_per_unit = 1.0;
        let path = folder.path().join(format!("{number}.glb"));
        write(&groom, &path, &WriteOptions { all_attributes: true, ..WriteOptions::default() }).unwrap();
        let back = read(&path, &ReadOptions::default()).unwrap().groom;
        assert_eq!(back.offsets(), groom.offsets());
        assert!(back.positions() == groom.positions(), "positions of groom {number} differ");
        let names = |groom: &Groom| groom.attributes().map(|(name, _)| name.to_owned()).collect::<Vec<_>>();
        assert_eq!(names(&back), names(&groom));
        assert_eq!(back.attribute(names::RADIUS), groom.attribute(names::RADIUS));
    }
}

/// `$GROOMKIT_BLENDER_PYTHON` is a Python in which `import bpy` works.
#[test]
fn blender_loads_lines_and_tubes() {
    let Some(python) = std::env::var_os("GROOMKIT_BLENDER_PYTHON") else {
        say_skipped("GROOMKIT_BLENDER_PYTHON is not set; Blender has not been asked");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let mut asked = vec![];
    let mut grooms = vec![("dressed", dressed())];
    let bear =
        data_file("hair/bear_fur.hair").map(|path| read(&path, &ReadOptions::default()).unwrap().groom);
    grooms.extend(bear.map(|groom| ("bear", groom)));
    for (name, groom) in grooms {
        for (way, options) in ways() {
            // Several custom attributes of different sizes are what its importer stumbles over.
            if options.all_attributes {
                continue;
            }
            let path = folder.path().join(format!("{name}, {way}.glb"));
            write(&groom, &path, &options).unwrap();
            let sides = match options.mesh {
                None => 0,
                Some(Mesh::Tubes { sides }) => sides,
                Some(Mesh::Ribbons) => 2,
            };
            asked.push(question(&groom, &path, sides));
        }
    }
    let questions = folder.path().join("questions.json");
    std::fs::write(&questions, serde_json::to_vec(&asked).unwrap()).unwrap();
    let script = workspace().join("tests/blender/gltf.py");
    passes(&Command::new(python).arg(script).arg(&questions).output().unwrap());
}

/// What Blender should find in the file: z up, metres.
fn question(groom: &Groom, path: &Path, sides: u32) -> serde_json::Value {
    let mut groom = groom.clone();
    groom.repair();
    groom.turn_to(groom::UpAxis::Z);
    let points: Vec<[f64; 3]> = groom
        .positions()
        .iter()
        .map(|p| p.to_array().map(|v| f64::from(v) * groom.meters_per_unit))
        .collect();
    let strands = groom.strand_count();
    let widths: Vec<f64> = (0..strands)
        .flat_map(|strand| groom.strand_range(strand).map(move |vertex| (strand, vertex)))
        .map(|(strand, vertex)| 2.0 * f64::from(groom.radii().get(strand, vertex)) * groom.meters_per_unit)
        .collect();
    let (segments, sides_and_caps) = (groom.segment_count(), sides as usize);
    let (edges, faces) = match sides {
        0 => (segments, 0),
        2 => (0, 2 * segments),
        _ => (0, 2 * (sides_and_caps * segments + (sides_and_caps - 2) * strands)),
    };
    serde_json::json!({
        "path": path, "sides": sides, "points": points, "widths": widths, "edges": edges, "faces": faces
    })
}
