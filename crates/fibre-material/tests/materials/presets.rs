//! Every preset is a sound material, and what its name says.

use fibre_material::{Material, MaterialError, Preset};
use fibre_scattering::{HairBcsdf, Medulla, beta_m_from_variance, beta_n_from_scale};

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

#[test]
fn the_fur_sets_have_the_published_spreads() {
    // Deviations in degrees, along and around the fibre.
    for (name, along, around, kappa) in
        [("fur-kappa-0.86", 9.45_f64, 17.63_f64, 0.86), ("fur-kappa-0.88", 11.64, 7.49, 0.88)]
    {
        let material = Material::preset(name).unwrap();
        let beta_m = beta_m_from_variance(along.to_radians().powi(2) as f32).unwrap();
        let scale = (2.0 * around.to_radians().powi(2) * 24.0 / std::f64::consts::PI.powi(3)).sqrt();
        let beta_n = beta_n_from_scale(scale as f32).unwrap();
        let p = material.parameters;
        assert!((p.beta_m - beta_m).abs() < 1e-5 && (p.beta_n - beta_n).abs() < 1e-5, "{beta_m} {beta_n}");
        assert_eq!((p.roughness_scales.tt, p.roughness_scales.trt), (1.0, 1.5));
        assert_eq!(material.medulla.kappa, kappa);
    }
}

#[test]
fn other_programs_defaults_are_theirs() {
    use fibre_scattering::{ArnoldHair, CyclesHair, MitsubaHair, PbrtHair, PxrMarschnerHair};
    for (name, theirs) in [
        ("arnold-default", ArnoldHair::default().parameters()),
        ("cycles-default", CyclesHair::default().parameters()),
        ("mitsuba-default", MitsubaHair::default().parameters()),
        ("pbrt-default", PbrtHair::default().parameters()),
        ("renderman-default", PxrMarschnerHair::default().parameters()),
    ] {
        assert_eq!(Material::preset(name).unwrap().constant().unwrap().hair, theirs.unwrap(), "{name}");
    }
}
