//! The JSON Schema of pipelines: what another program makes of it.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use end_to_end_tests::{run, validators, workspace};
use serde_json::Value;

/// What the Python package `jsonschema` finds wrong with each document; `None` where it is not there.
fn judged(texts: &[String]) -> Option<Vec<Vec<String>>> {
    let python = validators::python()?;
    let documents: Vec<Value> = texts.iter().map(|text| strict_yaml::parse(text).unwrap()).collect();
    let mut child = Command::new(python)
        .arg(workspace().join("tests/validators/check_schema.py"))
        .arg(workspace().join("pipelines/turntable.schema.json"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(serde_json::to_string(&documents).unwrap().as_bytes()).unwrap();
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    assert!(
        output.status.success(),
        "jsonschema does not take the schema, or is not installed: cargo xtask setup"
    );
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

/// Every pipeline that is shipped, and the parts they include.
fn shipped() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![workspace().join("pipelines")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "yaml") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

#[test]
fn the_program_prints_the_schema_that_is_shipped() {
    let output = run("turntable", &["schema"]);
    assert!(output.status.success());
    let kept = std::fs::read_to_string(workspace().join("pipelines/turntable.schema.json")).unwrap();
    assert!(
        String::from_utf8(output.stdout).unwrap() == kept.replace('\r', ""),
        "run `turntable schema > pipelines/turntable.schema.json`"
    );
}

#[test]
fn shipped_pipelines_name_the_schema_and_hold_to_it() {
    let files = shipped();
    let texts: Vec<String> = files.iter().map(|file| std::fs::read_to_string(file).unwrap()).collect();
    for (file, text) in files.iter().zip(&texts) {
        let depth = file.strip_prefix(workspace().join("pipelines")).unwrap().components().count() - 1;
        let first = format!("# yaml-language-server: $schema={}turntable.schema.json", "../".repeat(depth));
        assert_eq!(text.lines().next(), Some(&*first), "{}", file.display());
    }
    let Some(judged) = judged(&texts) else { return };
    for (file, faults) in files.iter().zip(judged) {
        assert_eq!(faults, [""; 0], "{}", file.display());
    }
}

#[test]
fn schema_and_program_agree_on_what_is_good() {
    let good = "version: 1\ngroom: {sample: {strands: 10}}\nlights: {environment: {studio: true}}\n";
    let cases = [
        ("", true),
        ("render:\nmaterial:\nsheet:\nconvert:\n", true),
        ("render: {spp: 4, aovs: [R], precision: half}\n", true),
        ("render: {spp: 0}\n", false),
        ("render: {spp: 4.5}\n", false),
        ("render: {spp: four}\n", false),
        ("render: {sppp: 4}\n", false),
        ("rendr: {}\n", false),
        (
            "variables: {n: 4, look: {melanin: 0.3}}\nrender: {spp: '${n}'}\nmaterial: ${look}\nname: a-${n}\n",
            true,
        ),
        ("variables: [n]\n", false),
        ("variables: {2n: 1}\n", false),
        ("tone: {curve: clip}\n", true),
        ("tone: {curve: clap}\n", false),
        ("variables: {c: clip}\ntone: {curve: '${c}'}\n", true),
        ("tone: {background: [1, 0, 0]}\n", true),
        ("tone: {background: [1, 0]}\n", false),
        ("tone: {background: [2, 0, 0]}\n", false),
        ("material: {color_ramp: [[0, [1, 1, 1]], [1, [0, 0, 0]]]}\n", true),
        ("material: {color_ramp: [[0, [1, 1]]]}\n", false),
        ("material: {lobes: {TT: 2}, beta_m: 0.2}\n", true),
        ("material: {beta_m: 2}\n", false),
        ("camera: {fov: 180}\n", false),
        ("video: [{file: a.mp4, codec: h264}, {file: b.mov, codec: prores4444}]\npage: {}\n", true),
        ("video: {file: a.mp4}\n", false),
        ("motion: {blur: positions, shutter: [0, 0.5]}\n", true),
        ("motion: {blur: yes}\n", false),
        ("matrix: {look: {dark: {material: {melanin: 0.9}}, blond: }}\n", true),
        ("matrix: {look: {dark: {material: {melanni: 0.9}}}}\n", false),
        ("matrix: {look: {dark: {sheet: {}}}}\n", false),
        ("matrix: {look: {a/b: {}}}\n", false),
        ("matrix: {look: {dark: 4}}\n", false),
        ("matrix: {spp: {key: render.spp, values: [4, 16]}, exclude: [{spp: 4}]}\n", true),
        ("matrix: {spp: {key: render.spp, values: {low: 4, high: 16}}}\n", true),
        ("matrix: {spp: {key: render.spp, values: []}}\n", false),
        ("matrix: {spp: {key: render.spp, value: [4]}}\n", false),
        ("matrix: {spp: {key: render.spp, values: [4]}, exclude: spp}\n", false),
        ("include: 4\n", false),
        ("include: []\n", true),
    ];
    let texts: Vec<String> = cases.iter().map(|(more, _)| format!("{good}{more}")).collect();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("turn.yaml");
    for (text, (more, expect)) in texts.iter().zip(cases) {
        std::fs::write(&file, text).unwrap();
        let output = run("turntable", &["check", &file.display().to_string()]);
        let told = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(i32::from(!expect)), "{more}{told}");
    }
    let Some(judged) = judged(&texts) else { return };
    for ((more, expect), faults) in cases.iter().zip(judged) {
        assert_eq!(faults.is_empty(), *expect, "{more}{faults:?}");
    }
}
