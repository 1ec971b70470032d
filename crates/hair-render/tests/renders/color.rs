//! Colour that arrives, and what else a material can say to the renderer.

use crate::common::*;
use glam::{DVec3, Vec3};
use hair_render::*;

fn matching(color: Vec3) -> ColorMatching {
    ColorMatching { color, size: 24, spp: 64, ..Default::default() }
}

#[test]
fn the_colour_that_was_picked_arrives() {
    let mut scene = scene(
        vec![hair(tuft(200, 0.03), HairColor::default())],
        Some(Environment::studio(16).unwrap()),
        vec![],
    );
    let camera = front(&scene);
    let before = shoot(&scene, &camera, &settings(16, 4));
    let wanted = Vec3::new(0.6, 0.35, 0.15);
    let found = match_color(&mut scene, &camera, &settings(16, 4), &matching(wanted), &Silent).unwrap();
    assert!(found.is_reached(), "{found:?}");
    assert!(found.error < 0.01 && found.fit_error > 3.0 * found.error, "{found:?}");

    // The scene has its own light back, and the absorption that was found.
    let after = shoot(&scene, &camera, &settings(16, 4));
    assert_eq!(before.alpha, after.alpha);
    let absorption = HairColor::Absorption(Vec3::from_array(found.absorption));
    let studio = Environment::studio(16).unwrap();
    let by_hand = crate::common::scene(vec![hair(tuft(200, 0.03), absorption.clone())], Some(studio), vec![]);
    assert_eq!(shoot(&by_hand, &camera, &settings(16, 4)).beauty, after.beauty);

    // Other random numbers, other pixels, under even light: the colour is there.
    let white = crate::common::scene(vec![hair(tuft(200, 0.03), absorption)], Some(white()), vec![]);
    let seen = mean(&shoot(&white, &camera, &RenderSettings { seed: 7, ..settings(40, 128) }));
    assert!((seen - wanted.as_dvec3()).abs().max_element() < 0.012, "{seen}");
}

#[test]
fn colours_that_cannot_be_had_are_told() {
    let mut scene = scene(vec![hair(tuft(200, 0.03), HairColor::default())], Some(white()), vec![]);
    let camera = front(&scene);
    let look = |scene: &mut Scene, color, max_bounces| {
        let settings = RenderSettings { max_bounces, ..settings(8, 1) };
        match_color(scene, &camera, &settings, &matching(color), &Silent).unwrap()
    };
    let bright = look(&mut scene, Vec3::new(0.9, 0.2, 1.5), 2);
    assert_eq!(bright.reach, [Reach::TooBright, Reach::Reached, Reach::TooBright], "{bright:?}");
    assert_eq!((bright.absorption[0], bright.absorption[2]), (0.0, 0.0));
    let dark = look(&mut scene, Vec3::new(0.3, 0.2, 0.001), 256);
    assert_eq!(dark.reach, [Reach::Reached, Reach::Reached, Reach::TooDark], "{dark:?}");
    assert!(!dark.is_reached() && dark.error > 0.005);
}

struct Stop;

impl Progress for Stop {
    fn advance(&self, _: u64, _: u64) {}

    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn a_match_that_fails_leaves_the_scene_alone() {
    let mut scene = scene(vec![hair(tuft(50, 0.03), blond())], Some(white()), vec![]);
    let camera = front(&scene);
    let before = shoot(&scene, &camera, &settings(12, 4));
    let away = Camera::look_at(DVec3::Z * 9.0, DVec3::Z * 20.0, DVec3::Y, 0.3).unwrap();
    let good = matching(Vec3::splat(0.5));
    let cases = [
        ColorMatching { object: 1, ..good.clone() },
        ColorMatching { color: Vec3::NAN, ..good.clone() },
        ColorMatching { color: Vec3::new(0.5, -0.1, 0.5), ..good.clone() },
        ColorMatching { tolerance: 0.0, ..good.clone() },
        ColorMatching { size: 7, ..good.clone() },
        ColorMatching { spp: 0, ..good.clone() },
        ColorMatching { max_probes: 1, ..good.clone() },
        ColorMatching { patch: [0.5, 0.0, 0.5, 1.0], ..good.clone() },
        ColorMatching { patch: [0.0, 0.0, 1.0, f32::NAN], ..good.clone() },
    ];
    for case in cases {
        let refused = match_color(&mut scene, &camera, &settings(8, 1), &case, &Silent);
        assert!(matches!(refused, Err(RenderError::Argument { .. })), "{case:?}");
    }
    assert!(match_color(&mut scene, &away, &settings(8, 1), &good, &Silent).is_err());
    let stopped = match_color(&mut scene, &camera, &settings(8, 1), &good, &Stop);
    assert!(matches!(stopped, Err(RenderError::Cancelled)));
    assert_eq!(shoot(&scene, &camera, &settings(12, 4)).beauty, before.beauty);
}

#[test]
fn a_fixed_offset_takes_the_variation_across_the_fibre_away() {
    let with = |fixed_offset| {
        let mut object = hair(tuft(60, 0.05), blond());
        object.material.fixed_offset = fixed_offset;
        Scene::build(SceneDescription {
            hair: vec![object],
            environment: Some(white()),
            ..Default::default()
        })
    };
    assert!(with(Some(1.5)).is_err() && with(Some(f32::NAN)).is_err());
    let look = |offset| {
        let scene = with(offset).unwrap();
        mean(&shoot(&scene, &front(&scene), &settings(20, 64))).z
    };
    // At the rim all light is mirrored and nothing is absorbed.
    let (rim, middle, own) = (look(Some(1.0)), look(Some(0.0)), look(None));
    assert!((rim - 1.0).abs() < 0.02 && middle < own && own < rim, "{rim} {middle} {own}");
}

#[test]
fn another_material_on_the_same_tree_is_the_same_picture() {
    let mut changed = scene(vec![hair(tuft(80, 0.03), HairColor::default())], Some(white()), vec![]);
    let wanted = hair(tuft(80, 0.03), blond());
    changed.set_material(0, &wanted.groom, &wanted.material).unwrap();
    let built = scene(vec![wanted.clone()], Some(white()), vec![]);
    let camera = front(&built);
    assert_eq!(
        shoot(&changed, &camera, &settings(12, 4)).beauty,
        shoot(&built, &camera, &settings(12, 4)).beauty
    );
    assert!(changed.set_material(1, &wanted.groom, &wanted.material).is_err());
    assert!(changed.set_material(0, &tuft(81, 0.03), &wanted.material).is_err());
}

/// Elliptical fibres keep their frame: the same seed, the same picture, and another than round fibres give.
#[test]
fn elliptical_fibres_show_and_stay_put() {
    let with = |aspect| {
        let mut object = hair(tuft(60, 0.05), blond());
        object.material.fibre.parameters.aspect = aspect;
        let scene = scene(vec![object], Some(Environment::studio(16).unwrap()), vec![]);
        shoot(&scene, &front(&scene), &settings(16, 8)).beauty
    };
    assert_eq!(with(0.7), with(0.7));
    assert_ne!(with(0.7), with(1.0));
}
