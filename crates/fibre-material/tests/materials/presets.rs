//! Every preset is a sound material, and what its name says.

use fibre_material::{Material, MaterialError, Preset};
use fibre_scattering::{HairBcsdf, Medulla};

#[test]
fn every_preset_is_sound_and_says_where_it_is_from() {
    let names: Vec<&str> = Material::preset_names().collect();
    assert!(names.len() >= 12);
    for (i, preset) in Preset::all().iter().enumerate() {
        let material = Material::preset(preset.name).unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        let parameters = material.constant().unwrap();
        HairBcsdf::new(&parameters.hair).unwrap();
        assert!(preset.source.len() > 8, "{} needs a source", preset.name);
        assert!(!names[..i].contains(&preset.name), "{} is there twice", preset.name);
        assert_eq!(preset.name.contains("fur"), material.medulla != Medulla::NONE, "{}", preset.name);
        assert_eq!(preset.name.ends_with("-wet"), parameters.hair.film.is_some(), "{}", preset.name);
    }
}

#[test]
fn unknown_presets_are_told_the_nearest_name() {
    let told = Material::preset("human-bron").unwrap_err();
    assert!(matches!(told, MaterialError::Preset { .. }));
    assert_eq!(told.to_string(), "unknown preset `human-bron`, did you mean `human-brown`?");
    assert!(Material::preset("cat").unwrap_err().to_string().contains("expected one of default, "));
}

#[test]
fn darker_hair_absorbs_more() {
    let green = |name| Material::preset(name).unwrap().constant().unwrap().hair.sigma_a.y;
    let order = ["human-white", "human-light-blond", "human-blond", "human-brown", "human-black"].map(green);
    assert!(order.windows(2).all(|pair| pair[0] < pair[1]), "{order:?}");
    assert_eq!(order[0], 0.0);
    // Golden blond is as dark in green as blond.
    assert!((green("human-golden-blond") / green("human-blond") - 1.0).abs() < 0.08);
}

#[test]
fn the_thesis_defaults_are_its_table() {
    let thesis = Material::preset("thesis-hair").unwrap();
    let parameters = thesis.parameters;
    assert_eq!((parameters.beta_m, parameters.beta_n, parameters.eta), (0.25, 0.3, 1.55));
    assert_eq!(parameters.alpha, 2.0_f32.to_radians());
    // Without its medulla, the fur is the hair.
    let fur = Material {
        medulla: Medulla::NONE,
        medulla_as_cortex: false,
        ..Material::preset("thesis-fur").unwrap()
    };
    assert_eq!(fur, thesis);
}
