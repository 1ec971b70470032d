//! From one text to one pipeline.

use super::*;

#[test]
fn unknown_keys_are_named_with_line_and_nearest_name() {
    for (more, words) in [
        ("grom: {file: a}\n", "turn.yaml:4:1: unknown key `grom`, did you mean `groom`?"),
        (
            "render:\n  width: 4\n  heigth: 4\n",
            "turn.yaml:6:3: render: unknown key `heigth`, did you mean `height`?",
        ),
        ("bind:\n  matrx: 1\n", "turn.yaml:5:3: bind: unknown key `matrx`, did you mean `matrix`?"),
        ("tone: {curve: clp}\n", "turn.yaml:4:15: tone.curve: unknown word `clp`, did you mean `clip`?"),
        (
            "render: {spp: -4}\n",
            "turn.yaml:4:15: render.spp: is a whole number `-4`, expected a whole number in 0",
        ),
        ("render: 1.5\n", "turn.yaml:4:9: render: is a number `1.5`, expected keys and values"),
        (
            "material:\n  color: [1, 2]\n",
            "turn.yaml:5:10: material.color: is a list of 2, expected 3 entries",
        ),
        ("render:\n  spp: 4\n  spp: 5\n", "turn.yaml:6:3: render: the key `spp` is there twice"),
    ] {
        let told = told(more);
        assert!(told[0].starts_with(words), "{told:#?}");
    }
}

#[test]
fn all_faults_of_all_kinds_are_told_at_once() {
    let told = told("render: {spp: many, widht: 3, height: 0}\nsimulate: true\ntone: {exposure: 70}\n");
    assert_eq!(told.len(), 5, "{told:#?}");
    for part in
        ["simulated here", "`widht`", "render.spp: is text", "render.height: is 0", "tone.exposure: is 70"]
    {
        assert!(told.iter().any(|t| t.contains(part)), "{part}: {told:#?}");
    }
    // What follows from a fault is no other fault.
    let told = words(of_text("version: 1\ngroom: {fil: a}\nlights: {environment: {studio: ja}}\n", &[]));
    assert_eq!(told.len(), 2, "{told:#?}");
}

#[test]
fn settings_lie_over_the_text() {
    let text = format!("{GOOD}render: {{spp: 64}}\n")
        .replace("{environment", "{area: [{size: [1, 1]}], environment");
    let with = |setting: &str| of_text(&text, &[setting]);
    let pipeline = |setting: &str| with(setting).unwrap().remove(0).pipeline;
    assert_eq!(pipeline("render.spp=4").render.spp, 4);
    assert_eq!(pipeline("lights.area.0.size.1=9").lights.area[0].size, [1.0, 9.0]);
    assert_eq!(pipeline("material.color=[1, 0.5, 0]").material.color, Some([1.0, 0.5, 0.0]));
    for (setting, part) in [
        ("render.sppp=4", "did you mean `spp`?"),
        ("render.spp=x", "turn.yaml: render.spp: is text \"x\""),
        ("render.spp", "expected `key.key=value`"),
        ("lights.area.3.size=1", "none of the 1 entries"),
        ("render.spp.x=1", "no keys below"),
        ("=1", "a key is empty"),
        ("groom.file=gone.hair", "turn.yaml:2:8: groom: has both `file` and `sample`; keep one"),
        ("variables.x=1", "turn.yaml: variables.x: no `${x}` is used"),
    ] {
        let told = words(with(setting));
        assert!(told[0].contains(part) && told[0].contains(&format!("(from `--set {setting}`)")), "{told:?}");
    }
}

#[test]
fn an_empty_text_is_a_pipeline_that_says_nothing() {
    for text in ["", "# only a comment\n", "---\n", "render:\nlights:\n  # nothing\n"] {
        let told = words(of_text(text, &[]));
        assert_eq!(told.len(), 3, "{told:#?}");
        assert!(told[0].contains("version: is missing"), "{told:#?}");
    }
    assert_eq!(ids(&good("")), [""]);
    assert_eq!(ids(&good("matrix:\n")), [""]);
}

#[test]
fn paths_count_from_the_file_they_are_written_in() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    std::fs::create_dir(folder.path().join("common")).unwrap();
    write("common/plate.png", "");
    write("common/own.yaml", "beta_m: 0.2\n");
    write(
        "common/look.yaml",
        "comp: {plate: plate.png}\nmaterial: {file: own.yaml}\nmatrix: {x: {a: {}, b: {}}}\n",
    );
    write("turn.yaml", &format!("include: common/look.yaml\n{GOOD}"));
    let file = folder.path().join("turn.yaml");
    let expanded = expand(&file, &Options::default()).unwrap();
    assert_eq!(ids(&expanded.variants), ["a", "b"]);
    assert_eq!(expanded.variants[0].pipeline.comp.plate, Some("common/plate.png".into()));
    assert_eq!(expanded.variants[0].pipeline.material.file, Some("common/own.yaml".into()));
    assert_eq!(expanded.inputs, [file.clone(), folder.path().join("common/look.yaml")]);
    assert_eq!((expanded.name.as_str(), expanded.output), ("turn", "out/turn".into()));
}
