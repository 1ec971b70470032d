//! What holds for every pipeline.

use proptest::prelude::*;

use super::*;

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
}
