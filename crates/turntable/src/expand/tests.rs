use proptest::prelude::*;

use super::*;

const GOOD: &str = "version: 1\ngroom: {sample: {}}\nlights: {environment: {studio: true}}\n";

fn good(more: &str) -> Vec<Variant> {
    of_text(&format!("{GOOD}{more}"), &[]).unwrap_or_else(|faults| panic!("{faults:#?}"))
}

fn told(more: &str) -> Vec<String> {
    words(of_text(&format!("{GOOD}{more}"), &[]))
}

fn words(result: Result<Vec<Variant>, Vec<Fault>>) -> Vec<String> {
    result.unwrap_err().iter().map(ToString::to_string).collect()
}

fn ids(variants: &[Variant]) -> Vec<&str> {
    variants.iter().map(|variant| variant.id.as_str()).collect()
}

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
fn every_combination_is_a_pipeline_of_its_own() {
    let variants = good(
        "variables: {low: 4, name: soft}\n\
         render: {spp: 1, width: 8}\n\
         matrix:\n  \
           look:\n    dark: {material: {melanin: 0.9}, render: {width: 16}}\n    blond: {material: {melanin: 0.1}, variables: {low: 2}}\n  \
           spp: {key: render.spp, values: [4, 16]}\n  \
           plain:\n    no:\n",
    );
    assert_eq!(ids(&variants), ["dark/4/no", "dark/16/no", "blond/4/no", "blond/16/no"]);
    let of = |f: fn(&Pipeline) -> (Option<f32>, u32, u32)| {
        variants.iter().map(|v| f(&v.pipeline)).collect::<Vec<_>>()
    };
    assert_eq!(
        of(|p| (p.material.melanin, p.render.spp, p.render.width)),
        [(Some(0.9), 4, 16), (Some(0.9), 16, 16), (Some(0.1), 4, 8), (Some(0.1), 16, 8)]
    );
    let axes: Vec<_> = variants[2].axes.iter().map(|(axis, name)| format!("{axis}={name}")).collect();
    assert_eq!(axes, ["look=blond", "spp=4", "plain=no"]);
}

#[test]
fn patches_use_variables_and_settings_lie_over_patches() {
    let text = format!(
        "{GOOD}variables: {{low: 4}}\nrender: {{spp: '${{low}}'}}\n\
         matrix:\n  quality:\n    draft: {{variables: {{low: 2}}}}\n    final: {{render: {{spp: 99, seed: '${{low}}'}}}}\n    plain:\n"
    );
    let render = |settings: &[&str]| -> Vec<(u32, u64)> {
        let variants = of_text(&text, settings).unwrap_or_else(|faults| panic!("{faults:#?}"));
        variants.iter().map(|v| (v.pipeline.render.spp, v.pipeline.render.seed)).collect()
    };
    assert_eq!(render(&[]), [(2, 0), (99, 4), (4, 0)]);
    assert_eq!(render(&["render.spp=7"]), [(7, 0), (7, 4), (7, 0)]);
    assert_eq!(render(&["variables.low=8"]), [(8, 0), (99, 8), (8, 0)]);
    assert_eq!(render(&["matrix.quality.final.render.spp=5"]), [(2, 0), (5, 4), (4, 0)]);
}

#[test]
fn what_is_excluded_is_no_variant() {
    let axes = "matrix:\n  look: {dark: {}, blond: {}}\n  light: {sky: {}, studio: {}, box: {}}\n  spp: {key: render.spp, values: [0.5e1, 16]}\n";
    let axes = axes.replace("0.5e1", "5");
    let with = |exclude: &str| good(&format!("{axes}  exclude: {exclude}\n"));
    assert_eq!(with("[]").len(), 12);
    assert_eq!(ids(&with("[{look: dark}, {light: [box, sky]}, {spp: 16}]")), ["blond/studio/5"]);
    assert_eq!(with("[{look: dark, light: sky}]").len(), 10);
    let told = |exclude: &str| told(&format!("{axes}  exclude: {exclude}\n")).remove(0);
    assert!(
        told("[{look: drak}]")
            .ends_with(":8:20: matrix.exclude.0.look: unknown name `drak`, did you mean `dark`?")
    );
    assert!(
        told("[{lok: dark}]").ends_with(":8:14: matrix.exclude.0: unknown axis `lok`, did you mean `look`?")
    );
    assert!(told("[{look: [dark, blond]}]").ends_with("matrix.exclude: leaves nothing"));
    assert!(
        told("[{}]")
            .ends_with("matrix.exclude.0: is keys and values, expected axes with names of their settings")
    );
    assert!(told("dark").contains("expected a list"));
}

#[test]
fn a_matrix_that_cannot_be_is_refused_where_it_is_written() {
    for (matrix, words) in [
        ("4", "turn.yaml:4:9: matrix: is a whole number `4`, expected axes"),
        ("{look: [dark]}", "matrix.look: is a list, expected names with the keys each changes"),
        ("{look: {}}", "matrix.look: is keys and values, expected names with the keys each changes"),
        ("{look: {dark: 4}}", "matrix.look.dark: is a whole number `4`, expected the keys it changes"),
        ("{look: {a/b: {}}}", "turn.yaml:4:17: matrix.look: `a/b` is no name for a folder"),
        ("{look: {..: {}}}", "`..` is no name for a folder"),
        ("{look: {a.png: {}}}", "`a.png` is no name for a folder"),
        ("{look: {frames: {}}}", "`frames` is the folder of all frames"),
        ("{look: {Dark: {}, dark: {}}}", "`dark` and `Dark` are the same folder"),
        ("{a b: {x: {}}}", "turn.yaml:4:10: matrix: `a b` is no name for a folder"),
        (
            "{look: {dark: {sheet: {}}}}",
            "turn.yaml:4:24: matrix.look.dark: `sheet` is the same for all variants",
        ),
        ("{s: {key: name, values: [1]}}", "matrix.s.key: `name` is the same for all variants"),
        ("{s: {key: render..spp, values: [1]}}", "`render..spp` is no key"),
        ("{s: {key: render.spp}}", "matrix.s.values: is missing"),
        (
            "{s: {key: render.spp, values: 4}}",
            "matrix.s.values: is a whole number `4`, expected a list of values",
        ),
        ("{s: {key: render.spp, values: []}}", "expected a list of values"),
        ("{s: {key: render.spp, value: [4]}}", "matrix.s: unknown key `value`, did you mean `values`?"),
        ("{s: {key: render.spp, values: [[1]]}}", "matrix.s.values.0: has no name of its own; give it one"),
        ("{s: {key: render.spp, values: ['${x}']}}", "has no name of its own"),
        ("{s: {key: render.spp, values: [1, 1]}}", "`1` and `1` are the same folder"),
    ] {
        let told = told(&format!("matrix: {matrix}\n"));
        assert!(told[0].contains(words), "{matrix}: {told:#?}");
    }
    let axis =
        |name: char| format!("  {name}: {{key: render.seed, values: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]}}\n");
    let axes: String = ('a'..='g').map(axis).collect();
    let told = told(&format!("matrix:\n{axes}"));
    assert!(
        told[0].ends_with("comes to 10 x 10 x 10 x 10 x 10 x 10 x 10 variants, expected at most 1000"),
        "{told:?}"
    );
}

#[test]
fn faults_of_variants_are_told_once_with_the_variant_where_it_matters() {
    let told = told(
        "render: {sppp: 4}\n\
         matrix:\n  \
           look:\n    dark: {material: {melanni: 0.9}}\n    blond: {}\n  \
           spp: {key: render.spp, values: [0, few, 4]}\n  \
           odd: {key: render.wdth, values: {a: 4}}\n",
    );
    assert_eq!(
        told,
        [
            "turn.yaml:4:10: render: unknown key `sppp`, did you mean `spp`?",
            "turn.yaml:10:36: render: unknown key `wdth`, did you mean `width`?",
            "turn.yaml:7:23: material: unknown key `melanni`, did you mean `melanin`? (in `dark/0/a` and 2 more)",
            "turn.yaml:9:35: render.spp: is 0, expected at least 1 (in `dark/0/a` and 1 more)",
            "turn.yaml:9:38: render.spp: is text \"few\", expected a whole number in 0..=4294967295 (in `dark/few/a` \
             and 1 more)",
        ]
    );
}

#[test]
fn variables_that_only_some_variants_use_may_be_set() {
    let text = format!("{GOOD}matrix:\n  look:\n    a: {{render: {{spp: '${{spp}}'}}}}\n    b: {{}}\n");
    assert!(of_text(&text, &["variables.spp=3"]).is_ok());
    let told = words(of_text(&text, &[]));
    assert!(
        told[0].ends_with("unknown variable `spp`; give it under `variables` or by `-D spp=...` (in `a`)"),
        "{told:?}"
    );
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

#[test]
fn hostile_texts_end_soon() {
    let bracket = words(of_text(&format!("convert: {}", "[".repeat(100_000)), &[]));
    assert!(bracket[0].contains("brackets are open"));
    assert!(!words(of_text(&format!("convert: {}a", "- ".repeat(100_000)), &[])).is_empty());
    let setting = format!("convert={}", "[".repeat(100_000));
    assert!(words(of_text(GOOD, &[&setting]))[0].contains("brackets are open"));
    let aliases = format!("{GOOD}video: [&a {{file: a.mp4}}, {{file: b.mp4}}]\n");
    assert_eq!(of_text(&aliases, &[]).unwrap()[0].pipeline.video.len(), 2);
}

#[test]
fn a_variant_in_yaml_reads_back_to_the_same() {
    let more = "name: 'a ${x} b'\nvariables: {x: '$${y}'}\nrender: {aovs: [R], seed: 18446744073709551615}\n\
        material: {beta_m: 0.1, color_ramp: [[0, [0.1, 0.2, 0.3]], [1, [1, 1, 1]]]}\n\
        video: [{}]\npage: {}\nsheet: {captions: [variant]}\nmotion: {blur: off}\n\
        matrix: {look: {a: {camera: {position: [0.1, 0.2, 0.3]}}, b: {tone: {curve: clip}}}}\n";
    for variant in good(more) {
        let text = variant.to_yaml().unwrap();
        assert!(text.contains("beta_m: 0.1\n") && !text.contains("null"), "{text}");
        let again = of_text(&text, &[]).unwrap_or_else(|faults| panic!("{faults:#?}"));
        assert_eq!(again[0].pipeline, variant.pipeline);
    }
}

/// Keys with values, in short YAML: good ones and bad ones.
fn some_keys() -> impl Strategy<Value = String> {
    let entry = prop::sample::select(vec![
        "render: {spp: 4}",
        "render: {width: 16, aovs: [R]}",
        "tone: {exposure: 1}",
        "tone: {background: [0, 0, 0], curve: clip}",
        "material: {melanin: 0.5}",
        "material: {melanin: 0.1, redness: 0.2}",
        "material: {beta_m: 0.3, lobes: {R: 2}}",
        "turntable: {frames: 2}",
        "camera: {fov: 40}",
        "video: [{file: a.mp4}]",
        "convert: [a.txt]",
        "attributes: {color: [1, 0, 0]}",
        "comp:",
        "render: {spp: 0}",
        "tone: {exposur: 1}",
    ]);
    prop::collection::btree_map(0..4_u8, entry, 0..4).prop_map(|entries| {
        // One of each key: the last.
        let keys: std::collections::BTreeMap<&str, &str> =
            entries.into_values().map(|entry| (entry.split(':').next().unwrap_or(entry), entry)).collect();
        keys.into_values().collect::<Vec<_>>().join("\n")
    })
}

fn indented(keys: &str) -> String {
    keys.lines().map(|line| format!("      {line}\n")).collect()
}

proptest! {
    /// A variant is what a file comes to that includes the pipeline and says the patch; with two axes, one file on
    /// the other.
    #[test]
    fn a_variant_is_a_file_over_the_pipeline(base in some_keys(), one in some_keys(), two in some_keys()) {
        let matrix = format!("matrix:\n  x:\n    a:\n{}  y:\n    b:\n{}", indented(&one), indented(&two));
        let found = of_text(&format!("{GOOD}{base}\n{matrix}"), &[]);
        let texts = [
            ("two.yaml", format!("include: one.yaml\n{two}\n")),
            ("one.yaml", format!("include: base.yaml\n{one}\n")),
            ("base.yaml", format!("{GOOD}{base}\n")),
        ];
        let texts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (*name, text.as_str())).collect();
        match (found, of_texts(&texts, &[])) {
            (Ok(found), Ok(expect)) => prop_assert_eq!(&found[0].pipeline, &expect[0].pipeline),
            (Err(found), Err(expect)) => {
                let words = |faults: Vec<Fault>| faults.into_iter().map(|f| (f.key, f.message)).collect::<Vec<_>>();
                prop_assert_eq!(words(found), words(expect));
            }
            (found, expect) => prop_assert!(false, "{found:?} {expect:?}"),
        }
    }

    #[test]
    fn no_text_brings_the_expansion_down(
        text in "(version: 1\n)?(matrix|include|variables|render|groom|x):[-a-c:{}\\[\\] \n&*!|>'\"$0-9.,#]{0,60}",
        setting in "(matrix|include|variables|render)?[.a-z0-9=${}\\[\\]]{0,12}",
    ) {
        let _ = of_text(&text, &[]);
        let _ = of_text(&text, &[&setting]);
    }
}

#[test]
fn many_variants_of_much_are_refused() {
    let axis =
        |name: char| format!("  {name}: {{key: render.seed, values: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]}}\n");
    let much = format!("render: {{aovs: [{}]}}\n", "R,".repeat(20_000));
    let told = told(&format!("{much}matrix:\n{}{}", axis('a'), axis('b')));
    assert!(told[0].contains("100 variants of 20"), "{told:?}");
}

#[test]
fn the_shipped_looks_are_what_they_say() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../pipelines/looks.yaml");
    let options = Options { variables: vec!["white=0.5".to_owned()], ..Options::default() };
    let expanded = expand(&file, &options).unwrap();
    assert_eq!(
        ids(&expanded.variants),
        ["brown/studio", "brown/window", "grey/studio", "grey/window", "wet/studio"]
    );
    let white = |v: &Variant| v.pipeline.material.variation.and_then(|variation| variation.white);
    assert_eq!(
        expanded.variants.iter().map(white).collect::<Vec<_>>(),
        [None, None, Some(0.5), Some(0.5), None]
    );
    assert!(expanded.variants.iter().all(|v| v.pipeline.render.spp == 16));
}
