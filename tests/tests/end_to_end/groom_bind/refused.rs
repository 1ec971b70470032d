//! What cannot be done is said, with exit code 2 and no file.

use std::fs;

use super::support::{attempt, hair, head, moving_square, names_in, square, three_strands};

#[test]
fn bad_inputs_are_named_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    three_strands(folder.path());
    file("square.obj", &square(|corner| corner));
    file("broken.glb", "glTF?");
    file("empty.obj", "v 0 0 0\n");
    file("mesh.fbx", "");
    let before = names_in(folder.path());
    let mesh = head();
    for (arguments, says) in [
        (&["three.usda", "--mesh", "none.glb", "-o", "out.usdc"][..], "none.glb"),
        (&["none.hair", "--mesh", "square.obj", "-o", "out.usdc"], "none.hair"),
        (&["three.usda", "--mesh", "broken.glb", "-o", "out.usdc"], "broken.glb"),
        (&["three.usda", "--mesh", "empty.obj", "-o", "out.usdc"], "empty.obj"),
        (&["three.usda", "--mesh", "mesh.fbx", "-o", "out.usdc"], "fbx"),
        (&["mesh.fbx", "--mesh", "square.obj", "-o", "out.usdc"], "expected one of"),
        (&["three.usda", "--mesh", "square.obj", "-o", "out.xyz"], "expected one of"),
        (&["three.usda", "--mesh", "square.obj", "-o", "no/folder/out.usdc"], "no/folder"),
        (&["three.usda", "--mesh", &mesh, "--animation", "Walk", "-o", "out.usdc"], "Walk"),
        (&["three.usda", "--mesh", &mesh, "--animation", "7", "-o", "out.usdc"], "7"),
        (&["three.usda", "--mesh", "square.obj", "--bind-by", "id", "-o", "out.usdc"], "root_triangle"),
        (&["three.usda", "--mesh", "square.obj", "--bind-by", "uv", "-o", "out.usdc"], "texture coordinates"),
        (&["three.usda", "--mesh", "square.obj", "--as-skinned", "-o", "out.usdc"], "--as-skinned"),
        (&["three.usda", "--mesh", "square.obj", "--root-uv", "-o", "out.usdc"], "uv"),
        (&["three.usda", "--mesh", "square.obj", "-o", "square.obj"], "written over"),
        (&["three.usda", "--mesh", "square.obj", "-o", "./three.usda"], "written over"),
        (&["three.usda", "--mesh", "square.obj", "-o", "out.usdc", "--report", "out.txt"], ".json or .csv"),
        (
            &["three.usda", "--mesh", "square.obj", "-o", "o.csv.usdc", "--report", "three.usda"],
            ".json or .csv",
        ),
        (&["three.usda", "--mesh", "square.obj", "--report", "-", "--json"], "standard output"),
        (&["three.usda", "--mesh", &mesh, "--frames", "0-1:0.5", "-o", "out.####.hair"], "whole frames"),
        (&["three.usda", "--mesh", "square.obj", "--matrix", "1,2,3", "-o", "out.usdc"], "16 numbers"),
        (
            &[
                "three.usda",
                "--mesh",
                "square.obj",
                "--limit",
                "0",
                "--translate",
                "0,1,0",
                "--beyond",
                "drop",
                "-o",
                "o.usdc",
            ],
            "leaves no strand",
        ),
    ] {
        let refused = attempt(folder.path(), arguments);
        let words = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {words}");
        assert!(words.contains(says), "{arguments:?}: {words}");
        assert!(refused.stdout.is_empty() && names_in(folder.path()) == before, "{arguments:?}");
    }
}

#[test]
fn a_changed_topology_is_told_with_its_frame() {
    let folder = tempfile::tempdir().unwrap();
    three_strands(folder.path());
    moving_square(folder.path(), 5, |_, corner| corner);
    fs::write(folder.path().join("square.0003.obj"), "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n").unwrap();
    fs::write(folder.path().join("out.usdc"), "the old file").unwrap();
    let refused =
        attempt(folder.path(), &["three.usda", "--mesh", "square.####.obj", "--fps", "24", "-o", "out.usdc"]);
    let words = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{words}");
    assert!(words.contains("square.0003.obj") || words.contains("frame 3"), "{words}");
    assert_eq!(fs::read(folder.path().join("out.usdc")).unwrap(), b"the old file");
    assert!(!names_in(folder.path()).iter().any(|name| name.ends_with(".tmp")));
}

#[test]
fn animations_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = head();
    let listed = attempt(folder.path(), &["--mesh", &mesh, "--list-animations"]);
    let words = String::from_utf8_lossy(&listed.stdout).into_owned();
    let lines: Vec<&str> = words.lines().collect();
    assert!(lines.len() == 2 && lines[0].contains("0  Nod") && lines[1].contains("1  Shake"), "{words}");
    assert!(lines[0].contains("0.0000 to 24.0000 at 24"), "{words}");
    let as_json = attempt(folder.path(), &["--mesh", &mesh, "--list-animations", "--json"]);
    let all: serde_json::Value = serde_json::from_slice(&as_json.stdout).unwrap();
    assert_eq!((&all["animations"][1]["name"], &all["frame_rate"]), (&"Shake".into(), &24.0.into()));
    let _ = hair("wavy.hair");
}
