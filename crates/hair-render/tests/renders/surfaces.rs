//! Meshes: smooth, matte and closed.

use std::f32::consts::PI;

use crate::common::*;
use glam::{DVec3, Vec3};
use hair_render::*;
use moving_mesh::TriangleMesh;

/// A ball of radius 1 about the origin, of `rows` x `2 rows` facets.
pub fn ball(rows: u32, smooth: bool) -> TriangleMesh {
    let columns = 2 * rows;
    let point = |i: u32| {
        let (down, around) = ((i / columns) as f32 / rows as f32 * PI, (i % columns) as f32 / columns as f32);
        let (sin, cos) = (2.0 * PI * around).sin_cos();
        Vec3::new(down.sin() * sin, down.cos(), down.sin() * cos)
    };
    let positions: Vec<Vec3> = (0..(rows + 1) * columns).map(point).collect();
    let facet = |i: u32| {
        let (row, column) = (i / columns, i % columns);
        let at = |row: u32, column: u32| row * columns + column % columns;
        let [a, b, c, d] =
            [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
        [[a, b, c], [a, c, d]]
    };
    let triangles = (0..rows * columns).flat_map(facet).collect();
    let normals = smooth.then(|| positions.clone());
    TriangleMesh { positions, triangles, normals }
}

fn lit(mesh: TriangleMesh, albedo: f32, environment: Environment) -> Scene {
    Scene::build(SceneDescription {
        meshes: vec![MeshObject::still(mesh, Vec3::splat(albedo))],
        environment: Some(environment),
        ..Default::default()
    })
    .unwrap()
}

/// Nothing of a convex body hides light from another part of it: one that shadowed itself by rounding
/// would show its triangles as a pattern.
#[test]
fn a_ball_under_even_light_is_as_bright_as_its_albedo_everywhere() {
    let scene = lit(ball(24, false), 0.8, white());
    let settings = RenderSettings { light_sampling: LightSampling::ScatteringOnly, ..settings(64, 16) };
    let frame = shoot(&scene, &front(&scene), &settings);
    let mut covered = 0;
    for (beauty, alpha) in frame.beauty.iter().zip(&frame.alpha) {
        assert!((beauty.x - 0.8 * alpha).abs() < 1e-5, "{} at alpha {alpha}", beauty.x);
        covered += usize::from(*alpha == 1.0);
    }
    assert!(covered > 500);
}

/// Under light from one side a smooth ball follows the cosine of its round shape, not of its facets.
#[test]
fn normals_make_a_coarse_ball_round() {
    let light = AreaLight::facing(DVec3::new(0.0, 0.0, 300.0), DVec3::ZERO, 30.0, 30.0, Vec3::splat(100.0));
    let light = light.unwrap();
    let error = |smooth| {
        let mesh = ball(10, smooth);
        let scene = Scene::build(SceneDescription {
            meshes: vec![MeshObject::still(mesh, Vec3::ONE)],
            lights: vec![light],
            ..Default::default()
        })
        .unwrap();
        let camera = Camera::look_at(DVec3::Z * 300.0, DVec3::ZERO, DVec3::Y, 1.0 / 300.0).unwrap();
        let frame = shoot(&scene, &camera, &settings(41, 32));
        // Irradiance of 100 x 1/100 steradian over pi, by the cosine at each pixel of -0.5..0.5.
        let mut worst: f32 = 0.0;
        for (i, beauty) in frame.beauty.iter().enumerate() {
            let [x, y] = [i % 41, i / 41].map(|at| (at as f32 + 0.5) / 41.0 - 0.5);
            let expected = (1.0 - x * x - y * y).sqrt() / PI;
            worst = worst.max((beauty.x / expected - 1.0).abs());
        }
        worst
    };
    let (flat, smooth) = (error(false), error(true));
    assert!(smooth < 0.03 && flat > 2.0 * smooth, "flat {flat}, smooth {smooth}");
}

#[test]
fn smooth_surfaces_agree_however_light_is_found_and_gain_none() {
    let scene = lit(ball(8, true), 1.0, Environment::studio(64).unwrap());
    let run = |light_sampling| spread(&scene, &RenderSettings { light_sampling, ..settings(24, 64) });
    let (both, error) = run(LightSampling::Both);
    for way in [LightSampling::LightsOnly, LightSampling::ScatteringOnly] {
        let (other, other_error) = run(way);
        let sigma = error.hypot(other_error);
        assert!(
            (other - both).abs() < 4.0 * sigma,
            "{way:?}: {other} +- {other_error}, both {both} +- {error}"
        );
        assert!(sigma < 0.01 * both, "the comparison would notice nothing");
    }
    let scene = lit(ball(8, true), 1.0, white());
    let white = mean(&shoot(&scene, &front(&scene), &settings(24, 64))).x;
    assert!(white > 0.95 && white < 1.0 + 1e-4, "{white}");
}

#[test]
fn meshes_that_cannot_be_shaded_are_refused() {
    let build = |mesh, albedo| {
        Scene::build(SceneDescription { meshes: vec![MeshObject::still(mesh, albedo)], ..Default::default() })
    };
    let mut short = ball(3, true);
    short.normals.as_mut().unwrap().pop();
    assert!(matches!(build(short, Vec3::ONE), Err(RenderError::Argument { .. })));
    for albedo in [Vec3::splat(1.1), Vec3::NEG_ONE, Vec3::new(0.5, f32::NAN, 0.5)] {
        assert!(matches!(build(ball(3, false), albedo), Err(RenderError::Argument { .. })), "{albedo}");
    }
}
