//! Laws of energy for what moves: blur spreads light, and neither makes nor loses any.

use glam::{DVec3, Vec3};
use hair_render::*;

use crate::common::*;

fn build(hair: Vec<HairObject>, environment: Environment, shape: ShutterShape) -> Scene {
    let shutter = Shutter::new(-0.25, 0.25, shape).unwrap();
    Scene::build(SceneDescription { hair, environment: Some(environment), shutter, ..Default::default() })
        .unwrap()
}

#[test]
fn white_hair_that_spins_vanishes_in_a_white_furnace() {
    let white_hair = HairColor::Absorption(Vec3::ZERO);
    for shape in [ShutterShape::Box, ShutterShape::Trapezoid { opening: 0.5, closing: 0.1 }] {
        let scene = build(vec![spinning(tuft(300, 0.02), white_hair.clone(), 0.8, 3)], white(), shape);
        let keys = [0.1, 0.5].map(|azimuth| Camera::orbit(DVec3::Y * 0.7, 4.0, azimuth, 0.2, 0.6).unwrap());
        let camera = MovingCamera::new(keys.to_vec()).unwrap();
        let settings = RenderSettings {
            max_bounces: 512,
            roulette_start: 513,
            light_sampling: LightSampling::ScatteringOnly,
            background: Background::Visible,
            ..settings(24, 32)
        };
        let frame = render_moving(&scene, &camera, &settings, &Silent).unwrap();
        assert_eq!(frame.report.rejected_samples, 0);
        let worst = frame.beauty.iter().map(|b| (*b - Vec3::ONE).abs().max_element()).fold(0.0, f32::max);
        assert!(worst < 5e-3, "worst pixel is {worst} off");
    }
}

/// All light of a picture is the same whether what it shows stands or is on its way across.
#[test]
fn going_straight_on_spreads_light_and_keeps_it() {
    const SEEDS: usize = 8;
    let tuft = tuft(60, 0.02);
    let camera = Camera::look_at(DVec3::new(0.0, 0.7, 400.0), DVec3::Y * 0.7, DVec3::Y, 0.01).unwrap();
    // Light and coverage of the whole picture, and the standard errors of both.
    let all_light = |scene: &Scene| -> [(f64, f64); 2] {
        let of_seed = |seed| {
            let settings = RenderSettings { seed: seed as u64, max_bounces: 4, ..settings(32, 16) };
            let frame = shoot(scene, &camera, &settings);
            let light = frame.beauty.iter().map(|b| f64::from(b.x)).sum::<f64>();
            [light, frame.alpha.iter().map(|&a| f64::from(a)).sum()]
        };
        let runs: Vec<[f64; 2]> = (0..SEEDS).map(of_seed).collect();
        [0, 1].map(|of| {
            let mean = runs.iter().map(|run| run[of]).sum::<f64>() / SEEDS as f64;
            let squares = runs.iter().map(|run| (run[of] - mean).powi(2)).sum::<f64>();
            (mean, (squares / (SEEDS * (SEEDS - 1)) as f64).sqrt())
        })
    };
    let still = all_light(&build(vec![hair(tuft.clone(), blond())], white(), ShutterShape::Box));
    for shape in [ShutterShape::Box, ShutterShape::Triangle, ShutterShape::Curve(vec![1.0, 0.0, 3.0])] {
        let velocities = vec![Vec3::new(3.0, 0.5, 0.0); tuft.point_count()];
        let motion = Motion::velocities(tuft.positions(), &velocities, [-0.25, 0.25]).unwrap();
        let moving = HairObject { motion, ..hair(tuft.clone(), blond()) };
        let blurred = all_light(&build(vec![moving], white(), shape.clone()));
        for (what, (a, b)) in ["light", "coverage"].into_iter().zip(still.into_iter().zip(blurred)) {
            let (off, sigma) = (b.0 / a.0 - 1.0, a.1.hypot(b.1) / a.0);
            println!("{shape}: {what} {off:.5} off, standard error {sigma:.5}");
            assert!(sigma < 0.01 && off.abs() < 4.0 * sigma + 1e-3, "{shape}: {what} {off} off");
        }
    }
}

#[test]
fn the_error_estimate_is_honest_under_blur() {
    let tuft = spinning(tuft(200, 0.02), blond(), 0.6, 5);
    let scene = build(vec![tuft], Environment::studio(64).unwrap(), ShutterShape::Triangle);
    let camera = front(&scene);
    let reference = shoot(&scene, &camera, &RenderSettings { seed: 99, ..settings(24, 1024) });
    for spp in [8, 15, 64] {
        let runs: Vec<Frame> = (0..4)
            .map(|seed| shoot(&scene, &camera, &RenderSettings { seed, ..settings(24, spp) }))
            .collect();
        let told: f64 = runs.iter().map(|f| f.report.rel_mse.unwrap()).sum::<f64>() / 4.0;
        let true_error: f64 = runs.iter().map(|f| rel_mse(f, &reference)).sum::<f64>() / 4.0;
        let ratio = told / (true_error - reference.report.rel_mse.unwrap());
        println!("{spp} spp: told {told}, true {true_error}, ratio {ratio}");
        assert!((0.7..1.4).contains(&ratio), "{spp} spp: told {told}, true {true_error}");
    }
}

#[test]
fn the_bits_of_a_blurred_picture_do_not_depend_on_the_threads() {
    let scene = build(vec![spinning(tuft(60, 0.03), blond(), 0.6, 4)], white(), ShutterShape::Cosine);
    let frames = [1, 3].map(|threads| {
        shoot(&scene, &front(&scene), &RenderSettings { threads: Some(threads), ..settings(33, 5) })
    });
    assert!(frames[0].beauty == frames[1].beauty && frames[0].alpha == frames[1].alpha);
}
