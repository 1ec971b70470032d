//! The committed pipelines, and what a pipeline that is wrong is told.

use std::path::Path;

use end_to_end_tests::{run, workspace};

fn pipeline(name: &str) -> String {
    workspace().join("pipelines").join(name).display().to_string()
}

/// Words on stderr, and the exit code.
fn told(arguments: &[&str]) -> (String, Option<i32>) {
    let output = run("turntable", arguments);
    (String::from_utf8_lossy(&output.stderr).into_owned(), output.status.code())
}

#[test]
fn the_quickstart_plans_what_it_promises() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").display().to_string();
    let output = run("turntable", &["--explain", "--json", "--out", &out, &pipeline("quickstart.yaml")]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let remarks: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let made: Vec<&str> = remarks
        .as_array()
        .unwrap()
        .iter()
        .filter(|r| r["action"] == "make")
        .map(|r| r["what"].as_str().unwrap())
        .collect();
    for name in
        ["wavy.txt", "wavy.glb", "wavy.usda", "frames/frame.0001.exr", "frames/frame.0008.exr", "sheet.png"]
    {
        assert!(made.contains(&name), "{name} is not planned: {made:?}");
    }
    assert!(!Path::new(&out).exists(), "an explanation must write nothing");
    let check = run("turntable", &["--check", "--out", &out, &pipeline("quickstart.yaml")]);
    assert_eq!(check.status.code(), Some(1), "something is left to make");
}

#[test]
fn the_real_groom_pipeline_asks_for_its_files() {
    let (words, code) = told(&["--explain", &pipeline("real-groom.yaml")]);
    assert_eq!(code, Some(2));
    assert!(words.contains("groom: needs `file: PATH`"), "{words}");
    assert!(words.contains("lights.environment: needs one of"), "{words}");
}

#[test]
fn slips_are_named_with_file_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("slip.yaml");
    let good = "version: 1\ngroom: {sample: {strands: 10}}\nlights: {environment: {studio: true}}\n";
    for (more, words) in [
        ("render:\n  widht: 10\n", ":5:3: render: unknown key `widht`, did you mean `width`?"),
        ("rendr: {}\n", ":4:1: unknown key `rendr`, did you mean `render`?"),
        ("render:\n  spp: lots\n", ":5:8: render.spp: invalid type"),
        ("mesh:\n  file: gone.obj\n", ":5:9: mesh.file: no file at"),
        ("turntable:\n  frames: 0\n", ":5:11: turntable.frames: is 0, expected 1..=9999"),
    ] {
        std::fs::write(&file, format!("{good}{more}")).unwrap();
        let (told, code) = told(&[&file.display().to_string()]);
        assert_eq!(code, Some(2), "{told}");
        assert!(told.contains(&format!("{}{words}", file.display())), "{told}");
    }
    std::fs::write(&file, good).unwrap();
    let path = file.display().to_string();
    for (arguments, words) in [
        (["--frames", "13-20"], "the turntable has frames 1-12"),
        (["--frames", "5-1"], "runs backwards"),
        (["--set", "render.sppp=1"], "did you mean `spp`?"),
    ] {
        let (told, code) = told(&[arguments[0], arguments[1], &path]);
        assert_eq!(code, Some(2));
        assert!(told.contains(words), "{told}");
    }
}
