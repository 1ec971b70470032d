//! Laws of energy and of sampling: what a render must be, whatever its noise.

use crate::common::*;
use fibre_material::Field;
use fibre_scattering::{HairParameters, Medulla, WaterFilm};
use glam::{DVec3, Vec3};
use hair_render::*;
use moving_mesh::TriangleMesh;

#[test]
fn white_hair_vanishes_in_a_white_furnace() {
    let white_hair = hair(tuft(300, 0.02), HairColor::Absorption(Vec3::ZERO));
    let scene = scene(vec![white_hair], Some(white()), vec![]);
    for (light_sampling, tolerance) in [
        (LightSampling::Both, 5e-3),
        (LightSampling::ScatteringOnly, 5e-3),
        (LightSampling::LightsOnly, 2e-2),
    ] {
        let settings = RenderSettings {
            max_bounces: 512,
            roulette_start: 513,
            light_sampling,
            background: Background::Visible,
            ..settings(24, 64)
        };
        let frame = shoot(&scene, &front(&scene), &settings);
        let mean = frame.beauty.iter().map(|b| b.as_dvec3()).sum::<DVec3>() / frame.beauty.len() as f64;
        assert!((mean - DVec3::ONE).abs().max_element() < tolerance, "{light_sampling:?}: {mean}");
        if light_sampling == LightSampling::ScatteringOnly {
            let worst = frame.beauty.iter().map(|b| (*b - Vec3::ONE).abs().max_element()).fold(0.0, f32::max);
            assert!(worst < 5e-3, "worst pixel is {worst} off");
        }
    }
}

/// Every kind of fibre, white, gives back what it gets: wet, elliptical, seen from afar, fur.
#[test]
fn every_white_fibre_vanishes_in_a_white_furnace() {
    let medulla = Medulla { kappa: 0.86, sigma_s: 3.15, g: 0.79, ..Medulla::NONE };
    let hair = |parameters| Material { parameters, ..Material::default() };
    let plain = HairParameters::default();
    let kinds = [
        ("wet", hair(HairParameters { film: Some(WaterFilm::default()), ..plain })),
        ("elliptical", hair(HairParameters { aspect: 0.6, ..plain })),
        ("layered", hair(HairParameters { cuticle_layers: Some(2.45), ..plain })),
        ("far", Material { field: Field::Far { nodes: 16 }, ..hair(plain) }),
        ("fur", Material { medulla, ..hair(plain) }),
    ];
    for (name, fibre) in kinds {
        let fibre = Material { color: HairColor::Absorption(Vec3::ZERO), ..fibre };
        let material = HairMaterial { fibre, ..HairMaterial::default() };
        let scene = scene(vec![HairObject::still(tuft(300, 0.02), material)], Some(white()), vec![]);
        let settings = RenderSettings {
            max_bounces: 512,
            roulette_start: 513,
            light_sampling: LightSampling::ScatteringOnly,
            background: Background::Visible,
            ..settings(16, 16)
        };
        let frame = shoot(&scene, &front(&scene), &settings);
        let mean = frame.beauty.iter().map(|b| b.as_dvec3()).sum::<DVec3>() / frame.beauty.len() as f64;
        assert!((mean - DVec3::ONE).abs().max_element() < 5e-3, "{name}: {mean}");
        let both = RenderSettings { light_sampling: LightSampling::Both, ..settings };
        let frame = shoot(&scene, &front(&scene), &both);
        let mean = frame.beauty.iter().map(|b| b.as_dvec3()).sum::<DVec3>() / frame.beauty.len() as f64;
        assert!((mean - DVec3::ONE).abs().max_element() < 2e-2, "{name}, lights too: {mean}");
    }
}

#[test]
fn fur_has_a_pass_for_what_its_medulla_scatters() {
    let medulla = Medulla { kappa: 0.86, sigma_s: 3.15, g: 0.79, ..Medulla::NONE };
    let fibre = Material { medulla, color: blond(), ..Material::default() };
    let material = HairMaterial { fibre, ..HairMaterial::default() };
    let scene = scene(vec![HairObject::still(tuft(200, 0.02), material)], Some(white()), vec![]);
    let frame = shoot(&scene, &front(&scene), &settings(16, 8).with_aov(Aov::Scattered).with_aov(Aov::R));
    let light = |aov| frame.pass(aov).unwrap().iter().map(|p| p.element_sum()).sum::<f32>();
    assert!(light(Aov::Scattered) > light(Aov::R), "most of what this fur returns is scattered");
    let table = scene.medulla_tables().next().unwrap();
    assert!(table.object == 0 && table.bytes > 1000 && table.bytes <= 512 * 1024, "{table:?}");
}

#[test]
fn passes_add_up_to_the_beauty_and_change_nothing() {
    let floor = TriangleMesh {
        positions: vec![Vec3::new(-3.0, 0.0, -3.0), Vec3::new(0.0, 0.0, 4.0), Vec3::new(3.0, 0.0, -3.0)],
        triangles: vec![[0, 1, 2]],
        normals: None,
    };
    let scene = Scene::build(SceneDescription {
        hair: vec![hair(tuft(200, 0.02), blond())],
        meshes: vec![MeshObject::still(floor, Vec3::new(0.7, 0.5, 0.3))],
        environment: Some(Environment::studio(64).unwrap()),
        lights: vec![
            AreaLight::facing(DVec3::new(1.0, 4.0, 1.0), DVec3::Y, 1.0, 1.0, Vec3::splat(5.0)).unwrap(),
        ],
        ..Default::default()
    })
    .unwrap();
    for background in [Background::Visible, Background::Transparent] {
        let plain = RenderSettings { background, ..settings(24, 8) };
        let all = RenderSettings { aovs: AovSet::all(), ..plain.clone() };
        let (plain, all) = (shoot(&scene, &front(&scene), &plain), shoot(&scene, &front(&scene), &all));
        assert!(plain.beauty == all.beauty && plain.alpha == all.alpha && plain.passes.is_empty());
        let mut seen = [false; 7];
        for (i, beauty) in all.beauty.iter().enumerate() {
            let sum: Vec3 = all.passes.iter().map(|(_, pixels)| pixels[i]).sum();
            assert!((sum - *beauty).abs().max_element() <= 1e-5 * beauty.max_element().max(1e-6));
            for (k, (_, pixels)) in all.passes.iter().enumerate() {
                seen[k] |= pixels[i] != Vec3::ZERO;
            }
        }
        // Hair has no medulla that could scatter.
        assert_eq!(seen, [true, true, true, true, false, true, background == Background::Visible]);
    }
}

#[test]
fn all_ways_of_finding_light_agree() {
    let picture = (0..128).map(|i| Vec3::splat(if i == 37 { 6.0 } else { 0.3 + 0.1 * (i % 7) as f32 }));
    let environment = Environment::from_pixels(16, 8, picture.collect()).unwrap().rotated(0.4);
    let light =
        |size| AreaLight::facing(DVec3::new(2.0, 3.0, 1.5), DVec3::Y, size, size, Vec3::splat(6.0)).unwrap();
    let scenes = [
        scene(vec![hair(tuft(150, 0.03), blond())], Some(environment), vec![]),
        scene(vec![hair(tuft(150, 0.03), blond())], None, vec![light(7.0)]),
        scene(
            vec![hair(tuft(150, 0.03), HairColor::Color(Vec3::new(0.4, 0.2, 0.1)))],
            Some(Environment::constant(Vec3::splat(0.2)).unwrap()),
            vec![light(4.0), AreaLight { two_sided: true, ..light(1.0) }],
        ),
    ];
    for (index, scene) in scenes.iter().enumerate() {
        for max_bounces in [0, 256] {
            let run = |light_sampling| {
                spread(scene, &RenderSettings { light_sampling, max_bounces, ..settings(16, 32) })
            };
            let (both, error) = run(LightSampling::Both);
            for way in [LightSampling::LightsOnly, LightSampling::ScatteringOnly] {
                let (other, other_error) = run(way);
                let sigma = (error * error + other_error * other_error).sqrt();
                println!(
                    "scene {index}, {max_bounces} bounces, {way:?}: {both} +- {error}, {other} +- {other_error}"
                );
                assert!(
                    (both - other).abs() < 4.0 * sigma + 0.002 * both,
                    "scene {index}, {max_bounces} bounces, {way:?}"
                );
            }
        }
    }
}

#[test]
fn roulette_changes_no_mean_and_bounces_only_add() {
    let scene = scene(vec![hair(tuft(200, 0.03), blond())], Some(white()), vec![]);
    let run = |roulette_start, max_bounces| {
        mean(&shoot(
            &scene,
            &front(&scene),
            &RenderSettings { roulette_start, max_bounces, ..settings(20, 256) },
        ))
    };
    let (late, early) = (run(1000, 1000), run(0, 1000));
    assert!(((late - early) / late).abs().max_element() < 0.01, "{late} {early}");
    let (none, some) = (run(16, 0), run(16, 8));
    assert!(none.x < some.x && some.x < late.x * 1.01);
}

/// A matte plane under a square light: the irradiance is the light's radiance times pi times the form
/// factor of a rectangle over a point below its corner (Siegel and Howell, configuration B-3), four times.
#[test]
fn a_matte_floor_gets_what_the_form_factor_says() {
    let (half, height, radiance, albedo) = (0.5f64, 0.8f64, 3.0, 0.6);
    let floor = TriangleMesh {
        positions: [(-9.0, -9.0), (-9.0, 9.0), (9.0, 9.0), (9.0, -9.0)]
            .map(|(x, z)| Vec3::new(x, 0.0, z))
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: None,
    };
    let light =
        AreaLight::facing(DVec3::Y * height, DVec3::ZERO, 1.0, 1.0, Vec3::splat(radiance as f32)).unwrap();
    let scene = Scene::build(SceneDescription {
        meshes: vec![MeshObject::still(floor, Vec3::splat(albedo as f32))],
        lights: vec![light],
        ..Default::default()
    })
    .unwrap();
    let a = half / height;
    let corner = a / (1.0 + a * a).sqrt() * (a / (1.0 + a * a).sqrt()).atan() / std::f64::consts::PI;
    let expected = albedo * radiance * 4.0 * corner;
    let camera = Camera::look_at(DVec3::new(0.0, 1.0, 5.0), DVec3::ZERO, DVec3::Y, 1e-3).unwrap();
    for light_sampling in [LightSampling::Both, LightSampling::LightsOnly, LightSampling::ScatteringOnly] {
        let frame = shoot(&scene, &camera, &RenderSettings { light_sampling, ..settings(8, 1024) });
        let off = mean(&frame).x / expected - 1.0;
        assert!(off.abs() < 0.01, "{light_sampling:?}: {off}");
    }
}

#[test]
fn the_error_estimate_is_honest() {
    let scene = scene(vec![hair(tuft(200, 0.02), blond())], Some(Environment::studio(64).unwrap()), vec![]);
    let camera = front(&scene);
    let reference = shoot(&scene, &camera, &RenderSettings { seed: 99, ..settings(32, 1024) });
    for spp in [8, 15, 64] {
        let runs: Vec<Frame> = (0..4)
            .map(|seed| shoot(&scene, &camera, &RenderSettings { seed, ..settings(32, spp) }))
            .collect();
        let told: f64 = runs.iter().map(|f| f.report.rel_mse.unwrap()).sum::<f64>() / 4.0;
        let true_error: f64 = runs.iter().map(|f| rel_mse(f, &reference)).sum::<f64>() / 4.0;
        let ratio = told / (true_error - reference.report.rel_mse.unwrap());
        assert!((0.75..1.3).contains(&ratio), "{spp} spp: told {told}, true {true_error}");
        assert_eq!(runs[0].report.relative_error, Some(runs[0].report.rel_mse.unwrap().sqrt()));
    }
    assert_eq!(shoot(&scene, &camera, &settings(8, 1)).report.relative_error, None);
}
