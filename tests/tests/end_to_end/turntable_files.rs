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
        ("render:\n  spp: lots\n", ":5:8: render.spp: is text \"lots\", expected a whole number"),
        ("mesh:\n  file: gone.obj\n", ":5:9: mesh.file: no file at"),
        ("render:\n  spp: 4\n  spp: 5\n", ":6:3: render: the key `spp` is there twice"),
        ("lights: {}\n", ":4:1: the key `lights` is there twice"),
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
        (["--json", "--progress=alf"], "--json and --progress would both write to stdout"),
        (
            ["--set", "render.spp=0"],
            "slip.yaml: render.spp: is 0, expected at least 1 (from `--set render.spp=0`)",
        ),
        (["--set", "groom.file=gone.hair"], "keep one (from `--set groom.file=gone.hair`)"),
    ] {
        let (told, code) = told(&[arguments[0], arguments[1], &path]);
        assert_eq!(code, Some(2));
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn bytes_that_are_no_text_are_placed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("turn.yaml");
    std::fs::write(&file, b"version: 1\nname: \xc3\xa4\xff\n").unwrap();
    let (told, code) = told(&[&file.display().to_string()]);
    assert_eq!(code, Some(2));
    assert!(told.contains("turn.yaml:2:8: byte 19 is not UTF-8"), "{told}");
}

#[test]
fn inputs_are_never_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let groom = folder.path().join("in.hair");
    std::fs::copy(end_to_end_tests::samples_dir().join("wavy.hair"), &groom).unwrap();
    let before = std::fs::read(&groom).unwrap();
    let file = folder.path().join("turn.yaml");
    let text =
        "version: 1\ngroom: {file: in.hair}\nconvert: [in.hair]\nlights: {environment: {studio: true}}\n";
    std::fs::write(&file, text).unwrap();
    let (told, code) = told(&["--out", &folder.path().display().to_string(), &file.display().to_string()]);
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains("would be written over, and is read"), "{told}");
    assert_eq!(std::fs::read(&groom).unwrap(), before);
}

#[test]
#[cfg(unix)]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("turn.yaml");
    let text = "version: 1\ngroom: {sample: {strands: 10}}\nlights: {environment: {studio: true}}\n";
    std::fs::write(&file, text).unwrap();
    std::fs::write(folder.path().join("taken"), "a file where a folder should be").unwrap();
    let out = folder.path().join("taken/out").display().to_string();
    let (told, code) = told(&["--out", &out, &file.display().to_string()]);
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains("taken/out: could not make the folder"), "{told}");
}
