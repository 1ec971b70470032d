//! What a matrix comes to, and what it may not say.

use super::*;

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
        ("{look: {Nul.1: {}}}", "`Nul.1` is a device's name on some systems"),
        ("{look: {com7: {}}}", "`com7` is a device's name on some systems"),
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
fn names_stay_paths_that_can_be_opened() {
    let faults = |matrix: &str| told(&format!("matrix: {{{matrix}}}\n"));
    assert_eq!(good(&format!("matrix: {{look: {{{}: {{}}}}}}\n", "髪".repeat(21))).len(), 1);
    let long = faults(&format!("look: {{{}: {{}}}}", "髪".repeat(22)));
    assert!(long[0].ends_with("is a name of 66 bytes, expected at most 64"), "{long:?}");
    let axes: Vec<String> = (0..16).map(|i| format!("a{i}: {{{}: {{}}}}", "x".repeat(64))).collect();
    let far = faults(&axes.join(", "));
    assert!(far[0].contains("1040 bytes long together, expected at most 1000"), "{far:?}");
    assert_eq!(good("matrix: {look: {connie: {}, com: {}, com10: {}, lpt0: {}, auxiliary: {}}}\n").len(), 5);
    let many: Vec<String> = (0..1001).map(|i| format!("x{i}: {{}}")).collect();
    let many = faults(&format!("look: {{{}}}", many.join(", ")));
    assert!(many[0].contains("matrix.look: comes to 1001 variants, expected at most 1000"), "{many:?}");
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
