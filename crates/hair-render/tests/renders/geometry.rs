//! Where things are: mirrors, directions, units, far and tiny scenes.

use crate::common::*;
use glam::{DVec3, Vec3};
use groom::{Attribute, Groom, UpAxis, names};
use hair_render::*;

/// One thick straight fibre along `along` through the origin.
fn rod(along: Vec3, radius: f32) -> Groom {
    let mut groom = Groom::new(vec![0, 2], vec![-along * 5.0, along * 5.0]).unwrap();
    groom.set_attribute(names::RADIUS, Attribute::constant_float(radius)).unwrap();
    groom
}

/// A nearly mirror-like fibre that only reflects at its surface.
fn mirror(groom: Groom) -> HairObject {
    let parameters = fibre_scattering::HairParameters {
        beta_m: 0.02,
        beta_n: 0.02,
        alpha: 0.0,
        lobe_weights: [1.0, 0.0, 0.0, 0.0, 0.0],
        ..Default::default()
    };
    let color = HairColor::Absorption(Vec3::ZERO);
    let fibre = Material { parameters, color, ..Default::default() };
    HairObject::still(groom, HairMaterial { fibre, ..Default::default() })
}

/// A fibre lit by one far, small light must glint where the law of reflection on its round surface says,
/// on the light's side, whichever way the fibre runs.
#[test]
fn glints_sit_where_the_surface_mirrors_the_light() {
    for along in [Vec3::Y, Vec3::NEG_Y, Vec3::X, Vec3::new(0.3, 1.0, 0.0).normalize()] {
        let across = Vec3::Z.cross(along).normalize();
        let toward_light = (across * 0.8 + Vec3::Z * 0.6).normalize();
        let place = (toward_light * 200.0).as_dvec3();
        let light = AreaLight::facing(place, DVec3::ZERO, 6.0, 6.0, Vec3::splat(1e4)).unwrap();
        let scene = scene(vec![mirror(rod(along, 0.5))], None, vec![light]);
        let camera =
            Camera::look_at(DVec3::Z * 30.0, DVec3::ZERO, DVec3::Y, 2.0 * (0.6f64 / 30.0).atan()).unwrap();
        let size = 120;
        let frame = shoot(&scene, &camera, &RenderSettings { max_bounces: 0, ..settings(size, 16) });
        // Brightness by place, against the normal that bisects light and view.
        let (mut found, mut weight) = (0.0, 0.0);
        for (i, beauty) in frame.beauty.iter().enumerate() {
            let x = ((i as u32 % size) as f32 + 0.5) / size as f32 * 1.2 - 0.6;
            let y = 0.6 - ((i as u32 / size) as f32 + 0.5) / size as f32 * 1.2;
            found += beauty.x * Vec3::new(x, y, 0.0).dot(across);
            weight += beauty.x;
        }
        assert!(weight > 0.0, "{along}: no glint");
        // In the plane across the fibre the azimuth of the normal is half way between light and view.
        let light_azimuth = toward_light.dot(across).atan2(toward_light.dot(Vec3::Z));
        let expected = 0.5 * (0.5 * light_azimuth).sin();
        assert!(
            (found / weight - expected).abs() < 0.02,
            "{along}: glint at {}, not {expected}",
            found / weight
        );
    }
}

#[test]
fn light_comes_from_where_the_picture_has_it() {
    // White in the columns around +X (u = 1/4), black elsewhere.
    let pixels = (0..32 * 16).map(|i| if (6..10).contains(&(i % 32)) { Vec3::ONE } else { Vec3::ZERO });
    let environment = Environment::from_pixels(32, 16, pixels.collect()).unwrap();
    let camera = Camera::orbit(DVec3::ZERO, 10.0, 0.0, 0.0, 0.15).unwrap();
    for (turn, right_is_brighter) in [(0.0f32, true), (180.0, false)] {
        let lit = environment.clone().rotated(turn.to_radians());
        let scene = scene(vec![mirror(rod(Vec3::Y, 0.5))], Some(lit), vec![]);
        let frame = shoot(&scene, &camera, &RenderSettings { max_bounces: 0, ..settings(32, 16) });
        let side = |right: bool| -> f32 {
            (0..frame.beauty.len()).filter(|i| (i % 32 >= 16) == right).map(|i| frame.beauty[i].x).sum()
        };
        assert!(side(right_is_brighter) > 5.0 * side(!right_is_brighter));
    }
}

#[test]
fn z_up_grooms_stand_upright() {
    let mut groom = rod(Vec3::Z, 0.2);
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.01;
    let scene = scene(vec![hair(groom, blond())], Some(white()), vec![]);
    let bounds = scene.bounds().unwrap();
    assert!(((bounds.max - bounds.min) - DVec3::new(0.0, 0.1, 0.0)).length() < 1e-7);
    let frame = shoot(&scene, &front(&scene), &settings(33, 4));
    let covered = |x: usize, y: usize| frame.alpha[y * 33 + x] > 0.5;
    assert!(covered(16, 6) && covered(16, 26) && !covered(6, 16) && !covered(26, 16));
}

/// The same groom at the origin and a million units away, on coordinates that both places can hold.
#[test]
fn far_away_is_like_here() {
    let mut near = tuft(100, 0.03);
    for p in near.positions_mut() {
        *p = (*p * 8.0).round() / 8.0; // an ulp at 2^20 is 1/8
    }
    let mut far = near.clone();
    let offset = Vec3::new(1_048_576.0, -1_048_576.0, 524_288.0);
    for p in far.positions_mut() {
        *p += offset;
    }
    let frame = |groom: Groom| {
        let scene = scene(vec![hair(groom, blond())], Some(Environment::studio(32).unwrap()), vec![]);
        shoot(&scene, &front(&scene), &settings(24, 64))
    };
    let (here, there) = (frame(near), frame(far));
    // Long paths magnify the last bit of the camera's place, so the noise differs, and nothing else.
    let covers: f32 = here.alpha.iter().zip(&there.alpha).map(|(a, b)| (a - b).abs()).sum();
    assert!(covers < 0.01 * here.alpha.iter().sum::<f32>());
    let off = rel_mse(&there, &here);
    assert!(off < 3.0 * here.report.rel_mse.unwrap(), "{off}");
    assert!(((mean(&here) - mean(&there)) / mean(&here)).abs().max_element() < 0.05);
}

/// The unit is no more than a scale: kilometres and micrometres give the same picture.
#[test]
fn tiny_and_huge_scenes_look_alike() {
    let frame = |unit: f64| {
        let mut groom = tuft(100, 0.03);
        groom.meters_per_unit = unit;
        let scene = scene(vec![hair(groom, blond())], Some(Environment::studio(32).unwrap()), vec![]);
        shoot(&scene, &front(&scene), &settings(24, 64))
    };
    let here = frame(1.0);
    for unit in [1.0 / 1_048_576.0, 1024.0] {
        let there = frame(unit);
        let off = rel_mse(&there, &here);
        assert!(off < 3.0 * here.report.rel_mse.unwrap(), "{unit}: {off}");
        assert!(((mean(&here) - mean(&there)) / mean(&here)).abs().max_element() < 0.05);
    }
}

#[test]
fn an_empty_scene_is_an_empty_picture() {
    let scene = scene(vec![], Some(white()), vec![]);
    assert_eq!(scene.bounds(), None);
    let frame = shoot(&scene, &front(&scene), &settings(4, 2));
    assert!(frame.alpha.iter().all(|&a| a == 0.0) && frame.beauty.iter().all(|&b| b == Vec3::ZERO));
    assert_eq!(frame.report.rel_mse, Some(0.0));
    let seen = RenderSettings { background: Background::Visible, ..settings(4, 2) };
    let frame = shoot(&scene, &front(&scene), &seen);
    assert!(frame.alpha.iter().all(|&a| a == 1.0) && frame.beauty.iter().all(|&b| b == Vec3::ONE));
}

#[test]
fn a_camera_inside_the_hair_sees_hair() {
    let scene = scene(vec![hair(tuft(500, 0.05), blond())], Some(white()), vec![]);
    let camera = Camera::look_at(DVec3::new(0.0, 0.3, 0.0), DVec3::X, DVec3::Y, 1.5).unwrap();
    let frame = shoot(&scene, &camera, &settings(16, 8));
    assert!(frame.alpha.iter().sum::<f32>() > 100.0);
    assert!(frame.beauty.iter().all(|b| b.is_finite()));
}

#[test]
fn transparency_thins_hair_only_when_asked() {
    let mut groom = rod(Vec3::Y, 0.5);
    groom.set_attribute(names::TRANSPARENCY, Attribute::constant_float(0.25)).unwrap();
    let alpha = |transparency| {
        let mut object = hair(groom.clone(), blond());
        object.material.transparency = transparency;
        let scene = scene(vec![object], Some(white()), vec![]);
        let camera = Camera::orbit(DVec3::ZERO, 10.0, 0.0, 0.0, 0.05).unwrap();
        let frame = shoot(&scene, &camera, &settings(16, 64));
        frame.alpha.iter().sum::<f32>() / 256.0
    };
    assert_eq!(alpha(Transparency::Ignored), 1.0);
    assert!((alpha(Transparency::Stochastic) - 0.75).abs() < 0.02);
}
