//! What strands learn from the mesh, and what the report says of them.

use groom::{Attribute, Domain, Values, names};
use groom_formats::{ReadOptions, read};
use serde_json::Value;

use super::support::{attempt, bind, bind_json, hair, head, three_strands};

#[test]
fn strands_learn_coordinates_normals_colours_and_groups() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("wavy.hair"));
    let options = ["--root-uv", "--root-normal", "--color-from-mesh", "--group-by-material"];
    let arguments =
        [&[hair.as_str(), "--mesh", &mesh, "--up", "y", "--frames", "0", "-o", "a.usdc"][..], &options];
    bind(folder.path(), &arguments.concat());
    let groom = read(&folder.path().join("a.usdc"), &ReadOptions::default()).unwrap().groom;
    let values = |name: &str| {
        let Some(Attribute { domain: Domain::Strand, values }) = groom.attribute(name) else {
            panic!("{name}: {:?}", groom.attribute(name))
        };
        values.clone()
    };
    let Values::Vec2(uvs) = values(names::ROOT_UV) else { panic!("uvs") };
    // The seam is at the back, u = 0.5 in front; v is up, and hair grows on the upper part.
    for (strand, uv) in uvs.iter().enumerate() {
        let root = groom.strand(strand)[0];
        let turn = (f64::from(root.x)).atan2(f64::from(root.z)) / std::f64::consts::TAU + 0.5;
        let off = (f64::from(uv.x) - turn).abs();
        // At the crown all turns meet.
        let is_crown = root.y > 0.1;
        assert!(is_crown || off.min(1.0 - off) < 0.02, "strand {strand}: {uv}, expected {turn}");
        assert!((0.25..=1.0).contains(&uv.y), "strand {strand}: {uv}");
    }
    let Values::Vec3(normals) = values("root_normal") else { panic!("normals") };
    for (strand, normal) in normals.iter().enumerate() {
        let root = groom.strand(strand)[0];
        assert!((normal.length() - 1.0).abs() < 1e-4 && normal.dot(root) > 0.0, "strand {strand}: {normal}");
    }
    let Values::Vec3(colors) = values(names::COLOR) else { panic!("colours") };
    let scalp = glam::Vec3::new(0.30, 0.17, 0.10);
    let on_scalp = colors.iter().filter(|color| color.distance(scalp) < 1e-4).count();
    let Values::Int(groups) = values(names::GROUP) else { panic!("groups") };
    let first = groups.iter().filter(|&&group| group == 0).count();
    // Roots grow on the scalp; at the hairline a few are on triangles that are not.
    assert_eq!(on_scalp, first);
    assert!(first * 10 > groups.len() * 9, "{first} of {}", groups.len());
}

#[test]
fn the_report_tells_of_every_strand_and_frame() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("straight.hair"));
    let common = [&hair, "--mesh", &mesh, "--up", "y"];
    bind(
        folder.path(),
        &[&common[..], &["--report", "a.json", "--limit", "0.002", "--frames", "0-3", "-o", "a.abc"]]
            .concat(),
    );
    let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    let heights = report["strands"]["height"].as_array().unwrap();
    assert_eq!(heights.len(), 3000);
    let beyond = heights.iter().filter(|height| height.as_f64().unwrap().abs() > 0.002).count();
    assert_eq!(report["beyond"].as_array().unwrap().len(), beyond);
    let bins = report["histogram"].as_array().unwrap().iter().map(|bin| bin["strands"].as_u64().unwrap());
    assert_eq!(bins.sum::<u64>(), 3000);
    assert_eq!(report["frames"].as_array().unwrap().len(), 4);
    assert!(report["frames"][3]["root_error"].as_f64().unwrap() < 1e-6);

    // Without an output, and as a table.
    bind(folder.path(), &[&common[..], &["--report", "a.csv"]].concat());
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert_eq!(table.lines().count(), 3001);
    assert!(table.starts_with("strand,id,triangle,u,v,height,distance,beyond\n0,0,"));
    let run = attempt(folder.path(), &[&common[..], &["--report", "-"]].concat());
    let said: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(said["strands"]["height"], report["strands"]["height"]);
}

#[test]
fn strands_beyond_the_limit_are_kept_snapped_or_dropped() {
    let folder = tempfile::tempdir().unwrap();
    let (path, groom) = three_strands(folder.path());
    let mut groom = groom;
    groom.positions_mut()[4..8].iter_mut().for_each(|point| point.y += 0.5);
    groom_formats::write(&groom, &path, &Default::default()).unwrap();
    std::fs::write(folder.path().join("square.obj"), super::support::square(|corner| corner)).unwrap();
    let common = ["three.usda", "--mesh", "square.obj", "-o", "out.usda"];
    let heights = |options: &[&str]| -> Vec<f32> {
        bind(folder.path(), &[&common[..], options].concat());
        let bound = read(&folder.path().join("out.usda"), &ReadOptions::default()).unwrap().groom;
        bound.strands().map(|strand| strand[0].y).collect()
    };
    let near = |found: Vec<f32>, expected: &[f32]| {
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}");
    };
    near(heights(&[]), &[0.0, 0.5, 0.0]);
    near(heights(&["--limit", "0.1"]), &[0.0, 0.5, 0.0]);
    near(heights(&["--limit", "0.1", "--beyond", "snap"]), &[0.0; 3]);
    near(heights(&["--limit", "0.1", "--beyond", "drop"]), &[0.0; 2]);
    let words = bind(folder.path(), &[&common[..], &["--limit", "0.1"]].concat());
    assert!(words.contains("1 of 3 strands are farther than 0.1"), "{words}");
    let done = bind_json(folder.path(), &[&common[..], &["--limit", "0.1", "--beyond", "drop"]].concat());
    assert_eq!((done["beyond"].as_u64(), done["strands"].as_u64()), (Some(1), Some(2)));
}

#[test]
fn other_units_and_axes_are_warned_of_with_what_to_try() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("straight.hair"));
    // HAIR says no axis: z is taken.
    let words = bind(folder.path(), &[&hair, "--mesh", &mesh, "--report", "a.csv", "--scale", "100"]);
    assert!(words.contains("try --up y --scale 1 ("), "{words}");
    let words = bind(folder.path(), &[&hair, "--mesh", &mesh, "--report", "a.csv", "--up", "y"]);
    assert!(!words.contains("warning"), "{words}");
}
