//! Material files: what they say is what comes out, and what they may not say is refused at its place.

use std::path::Path;

use fibre_material::{Field, HairColor, Material, PigmentSet, Preset, WhiteColor};
use fibre_scattering::{CyclesHair, CyclesParametrization};
use glam::Vec3;
use proptest::prelude::*;

fn read(text: &str) -> Material {
    Material::from_yaml(text, "a.yaml").unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn refused(text: &str) -> String {
    Material::from_yaml(text, "a.yaml").expect_err(text).to_string()
}

#[test]
fn an_empty_file_is_the_default() {
    assert_eq!(read(""), Material::default());
    assert_eq!(read("# nothing\n"), Material::default());
    assert_eq!(read("preset: default\n"), Material::default());
}

#[test]
fn each_way_of_giving_the_colour() {
    for (text, color) in [
        ("color: [0.5, 0.2, 0.1]", HairColor::Color(Vec3::new(0.5, 0.2, 0.1))),
        ("fur: {base_color: [0.5, 0.2, 0.1]}", HairColor::Color(Vec3::new(0.5, 0.2, 0.1))),
        ("absorption: [1, 2, 3]", HairColor::Absorption(Vec3::new(1.0, 2.0, 3.0))),
        ("melanin: 0.5\nredness: 0.2", HairColor::Melanin { concentration: 0.5, redness: 0.2 }),
        ("melanin: 0.5", HairColor::Melanin { concentration: 0.5, redness: 0.0 }),
        ("eumelanin: 1.3", HairColor::Pigments { eumelanin: 1.3, pheomelanin: 0.0 }),
        ("pheomelanin: 1.3", HairColor::Pigments { eumelanin: 0.0, pheomelanin: 1.3 }),
        ("groom: {}", HairColor::default()),
        ("groom: {color: [1, 1, 1]}", HairColor::Groom { fallback: Vec3::ONE }),
        ("groom: {melanin: 0.3}", HairColor::GroomMelanin { concentration: 0.3, redness: 0.0 }),
    ] {
        assert_eq!(read(text).color, color, "{text}");
    }
    let HairColor::Ramp(ramp) = read("color_ramp: [[0, [0, 0, 0]], [1, [1, 1, 1]]]").color else {
        panic!("not a ramp")
    };
    assert_eq!(ramp.at(0.25), Vec3::splat(0.25));
}

#[test]
fn everything_else_that_can_be_said() {
    let text = "
beta_m: 0.2
beta_n: 0.4
roughness_scales: {tt: 0.7, trt: 1.5}
alpha: 3
eta: 1.6
lobes: {R: 0, scattered: 2}
film: {eta: 1.4}
cuticle_layers: 1.5
medulla: {kappa: 0.5, sigma_s: 2, sigma_a: [0.1, 0.2, 0.3], g: -0.5}
variation: {seed: 7, pigment: 0.1, hue: 18, roughness: 0.2, white: 0.15, white_melanin: 0.05}
along: {absorption: [[0, 1.5], [1, 0.5]]}
field: far
nodes: 8
";
    let material = read(text);
    let p = material.parameters;
    assert_eq!((p.beta_m, p.beta_n, p.eta), (0.2, 0.4, 1.6));
    assert_eq!(read("aspect: 0.8").parameters.aspect, 0.8);
    assert_eq!((p.roughness_scales.tt, p.roughness_scales.trt), (0.7, 1.5));
    assert_eq!(p.alpha, 3.0_f32.to_radians());
    assert_eq!(p.lobe_weights, [0.0, 1.0, 1.0, 1.0, 2.0]);
    assert_eq!(p.film.map(|film| (film.eta, film.roughness)), Some((1.4, 0.1)));
    assert_eq!(p.cuticle_layers, Some(1.5));
    let m = material.medulla;
    assert_eq!((m.kappa, m.sigma_s, m.g), (0.5, 2.0, -0.5));
    assert!(!material.medulla_as_cortex);
    let v = &material.variation;
    assert_eq!((v.seed, v.pigment, v.roughness, v.white.share), (7, 0.1, 0.2, 0.15));
    assert!((v.hue - 0.05).abs() < 1e-7);
    assert_eq!(v.white.color, WhiteColor::Melanin(0.05));
    assert_eq!(v.along.absorption.as_ref().map(|ramp| ramp.at(0.5)), Some(1.0));
    assert_eq!(material.field, Field::Far { nodes: 8 });
}

#[test]
fn faults_have_their_file_line_key_value_and_range() {
    for (text, told) in [
        ("beta_n: 0.3\nbeta_m: 7", "a.yaml:2:9: beta_m: must lie in [0.001, 1], found 7"),
        ("beta_m: nearly", "a.yaml:1:9: beta_m: is text \"nearly\", expected a number"),
        ("alpha: 95", "a.yaml:1:8: alpha: is 95, expected above -90, below 90 degrees"),
        ("melanin: 1.2", "a.yaml:1:10: melanin: is 1.2, expected 0..1"),
        ("redness: 0.2", "a.yaml:1:10: redness: needs `melanin` beside it"),
        ("eumelanin: -1", "a.yaml:1:12: eumelanin: is -1, expected 0..10000"),
        ("color: [1, 2, 3]", "a.yaml:1:8: color: is [1.0, 2.0, 3.0], expected three numbers in 0..1"),
        ("color: [1, 1, 1]\nmelanin: 1", "a.yaml:2:10: melanin: the colour is said by `color` too"),
        ("lobes: {TRT: -1}", "a.yaml:1:14: lobes.TRT: "),
        ("lobes: {TRTT: 1}", "a.yaml:1:9: lobes: unknown key `TRTT`, did you mean `TRT`?"),
        ("wet: false\nfilm: {}", "a.yaml:2:7: film: contradicts `wet: false`; keep one"),
        ("film: {eta: 0.5}", "a.yaml:1:13: film.eta: must lie in"),
        (
            "aspect: 0.8\nmedulla: {kappa: 0.5}",
            "a.yaml:1:9: aspect: must lie in [1, 1]: a fibre with a medulla is round",
        ),
        ("cycles: {}\npbrt: {}", "a.yaml:2:7: pbrt: contradicts `cycles`; keep one"),
        ("cycles: {roughness: 7}", "a.yaml:1:21: cycles.roughness: must lie in [0.001, 1], found 7"),
        ("cycles: {offset: 120}", "a.yaml:1:18: cycles.offset: must lie in (-90, 90) degrees, found 120"),
        (
            "mitsuba: {scale_tilt: 120}",
            "a.yaml:1:23: mitsuba.scale_tilt: must lie in (-90, 90) degrees, found 120",
        ),
        ("arnold: {ior: 0}", "a.yaml:1:15: arnold.ior: must lie in [1.0001, 3], found 0"),
        ("cycles: {rough: 7}", "cycles: unknown key `rough`, expected one of `parametrization`"),
        ("renderman: {specularConeAngle: 7}", "did you mean `specularConeAngleR`?"),
        ("preset: default\ncycles: {}", "a.yaml:2:9: cycles: is beside `preset` or `file`"),
        ("medulla: {kappa: 1.2}", "a.yaml:1:18: medulla.kappa: "),
        ("medulla: {}\nfur: {}", "medulla: contradicts `fur`; keep one"),
        ("fur: {medulla_index: 2}", "a.yaml:1:22: fur.medulla_index: is 2, expected 0..1"),
        ("variation: {white: 1.5}", "a.yaml:1:20: variation.white: is 1.5, expected 0..1"),
        ("variation: {hue: 200}", "a.yaml:1:18: variation.hue: is 200, expected 0..180 degrees"),
        ("variation: {white_melanin: 0.1}", "add `white: 0.1`"),
        (
            "melanin: 1\nvariation: {hue: 20}",
            "a.yaml:2:18: variation.hue: is 20, expected 0: it is for color",
        ),
        (
            "beta_m: 0.9\nvariation: {roughness: 0.5}",
            "a.yaml:2:24: variation.roughness: is 0.5, which takes beta_m from 0.4500 to 1.3500",
        ),
        (
            "color: [1, 1, 1]\nalong: {melanin: [[0, 1]]}",
            "a.yaml:2:18: along.melanin: is there, expected melanin as the colour",
        ),
        ("along: {absorption: [[1, 1], [0, 2]]}", "a.yaml:1:21: along.absorption: ramp is `1:1,0:2`"),
        ("color_ramp: [[0, [2, 0, 0]]]", "a.yaml:1:13: color_ramp: "),
        ("nodes: 8", "a.yaml:1:8: nodes: needs `field: far` beside it"),
        ("eta: 1.5\nfile: none.yaml", "a.yaml:2:7: file: none.yaml: No such file"),
        ("field: fra", "unknown word `fra`, did you mean `far`?"),
        (
            "preset: human-bron",
            "a.yaml:1:9: preset: unknown preset `human-bron`, did you mean `human-brown`?",
        ),
        ("texture: {file: nowhere.png}", "a.yaml:1:17: texture.file: nowhere.png: No such file"),
        ("beta_m: 0.3\nbeta_m: 0.3", "a.yaml:2:1: the key `beta_m` is there twice"),
        ("colour: [1, 1, 1]", "a.yaml:1:1: unknown key `colour`, did you mean `color`?"),
    ] {
        let found = refused(text);
        assert!(found.contains(told), "{text}: {found}");
    }
    // Every fault is told at once.
    assert_eq!(refused("beta_m: 7\nbeta_n: 7\nalpha: 100").lines().count(), 3);
}

#[test]
fn other_programs_fibres() {
    let material = read(
        "cycles: {parametrization: melanin, melanin: 0.5, melanin_redness: 0.3, random_color: 0.4, offset: 3}",
    );
    let color = HairColor::Melanin { concentration: 0.5, redness: 0.3 };
    assert_eq!((&material.color, material.pigments), (&color, PigmentSet::Cycles));
    assert_eq!((material.variation.pigment, material.parameters.alpha), (0.4, 3.0_f32.to_radians()));
    let theirs = CyclesHair {
        parametrization: CyclesParametrization::Melanin,
        melanin: 0.5,
        melanin_redness: 0.3,
        offset: 3.0_f32.to_radians(),
        ..CyclesHair::default()
    };
    assert_eq!(material.constant().unwrap().hair, theirs.parameters().unwrap());
    // In Cycles a direct colour does not vary.
    assert_eq!(read("cycles: {random_color: 0.4, random_roughness: 0.2}").variation.pigment, 0.0);
    // Other keys change what was imported.
    let changed = read("pbrt: {beta_m: 0.4, beta_n: 0.5}\nbeta_m: 0.2\nmelanin: 0");
    assert_eq!((changed.parameters.beta_m, changed.parameters.beta_n), (0.2, 0.5));
    assert_eq!(changed.constant().unwrap().hair.sigma_a, Vec3::ZERO);
    let spreads =
        "materialx: {roughness_R: [0.04, 0.1], roughness_TT: [0.01, 0.1], roughness_TRT: [0.16, 0.1]}";
    assert!((read(spreads).parameters.lobe_spreads()[0][0] - 0.04).abs() < 1e-6);
    assert!(refused("materialx: {}").starts_with("a.yaml:1:12: materialx: roughness_TT s must lie in"));
}

#[test]
fn files_begin_with_files_and_presets() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("deeper")).unwrap();
    std::fs::write(path("deeper/base.yaml"), "preset: human-brown\nbeta_m: 0.2\n").unwrap();
    std::fs::write(path("own.yaml"), "file: deeper/base.yaml\nbeta_n: 0.5\nvariation: {white: 0.1}\n")
        .unwrap();
    let own = Material::open(&path("own.yaml")).unwrap();
    assert_eq!((own.parameters.beta_m, own.parameters.beta_n), (0.2, 0.5));
    assert_eq!(own.color, Material::preset("human-brown").unwrap().color);
    std::fs::write(path("round.yaml"), "file: round.yaml\n").unwrap();
    let told = Material::open(&path("round.yaml")).unwrap_err().to_string();
    assert!(told.contains("files that do not begin with each other"), "{told}");
    assert!(told.contains("round.yaml:1:7: file: "), "{told}");
    let told = Material::open(&path("none.yaml")).unwrap_err().to_string();
    assert!(told.contains("none.yaml: No such file"), "{told}");
    std::fs::write(path("endless.yaml"), "#".repeat(2 << 20)).unwrap();
    let told = Material::open(&path("endless.yaml")).unwrap_err().to_string();
    assert!(told.ends_with("endless.yaml: more than 1048576 bytes, expected a material file"), "{told}");
    // A fault in what a file begins with is told where it is.
    std::fs::write(path("deeper/base.yaml"), "\nbeta_m: 2\n").unwrap();
    let told = Material::open(&path("own.yaml")).unwrap_err().to_string();
    assert!(told.contains("deeper/base.yaml:2:9: beta_m: "), "{told}");
}

#[test]
fn every_sample_file_is_sound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/materials");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "yaml") {
            Material::open(&path).unwrap_or_else(|error| panic!("{error}"));
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("# "), "{} says nothing about itself", path.display());
            count += 1;
        }
    }
    assert!(count >= 6, "{count}");
}

/// Words a file may hold, and some it may not.
fn keys() -> impl Strategy<Value = String> {
    let words = "[a-z_]{1,12}|color|melanin|redness|eumelanin|groom|texture|beta_m|alpha|eta|lobes|film|fur|medulla|\
                 variation|along|field|nodes|preset|file|white|kappa|TT|absorption|color_ramp|wet|pigment|v";
    proptest::string::string_regex(words).unwrap()
}

fn values() -> impl Strategy<Value = String> {
    let plain = prop_oneof![
        any::<f32>().prop_map(|v| format!("{v}")),
        (0.0_f32..2.0).prop_map(|v| format!("{v}")),
        Just("[0.1, 0.2, 0.3]".to_owned()),
        Just("[[0, 1], [1, 2]]".to_owned()),
        Just(".nan".to_owned()),
        Just(".inf".to_owned()),
        Just("far".to_owned()),
        Just("true".to_owned()),
        Just("human-brown".to_owned()),
        "[ -~]{0,8}".prop_map(|s| s),
    ];
    plain.prop_recursive(2, 8, 3, |inner| {
        proptest::collection::vec((keys(), inner), 0..3).prop_map(|pairs| {
            let pairs: Vec<String> = pairs.into_iter().map(|(k, v)| format!("{k}: {v}")).collect();
            format!("{{{}}}", pairs.join(", "))
        })
    })
}

#[test]
fn texts_made_to_exhaust_the_reader_end_soon() {
    let bomb = (1..12).fold("lobes: &a0 [x, x]\n".to_owned(), |text, i| {
        let all = vec![format!("*a{}", i - 1); 9].join(", ");
        format!("{text}k{i}: &a{i} [{all}]\n")
    });
    for text in [
        "- ".repeat(200_000),
        "a: ".repeat(100_000),
        "? ".repeat(200_000),
        "[".repeat(200_000),
        format!("color: {}", "&a ".repeat(100_000)),
        format!("color_ramp: [{}]", "[0, [0, 0, 0]], ".repeat(30_000)),
        bomb,
    ] {
        assert!(Material::from_yaml(&text, "a.yaml").is_err(), "{}", &text[..40]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn texts_make_materials_or_faults(pairs in proptest::collection::vec((keys(), values()), 0..6)) {
        let text: String = pairs.iter().map(|(key, value)| format!("{key}: {value}\n")).collect();
        match Material::from_yaml(&text, "a.yaml") {
            Ok(material) => prop_assert!(material.check().is_ok()),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn any_text_is_survived(text in "\\PC{0,200}") {
        let _ = Material::from_yaml(&text, "a.yaml");
    }

    #[test]
    fn every_cut_of_a_file_is_survived(cut in 0_usize..400) {
        let text: String = Preset::all().iter().map(|p| p.keys).filter(|k| !k.is_empty()).collect::<Vec<_>>().join(", ");
        let text = format!("{{{text}}}");
        let cut = text.char_indices().map(|(i, _)| i).nth(cut).unwrap_or(text.len());
        let _ = Material::from_yaml(&text[..cut], "a.yaml");
    }
}
