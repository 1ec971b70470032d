//! Samples a CPU second, error for the time, and the white furnace, on a real groom.
//!
//! `cargo bench -p hair-render-cli` with `straight.hair` in `$GROOMKIT_DATA/hair` or
//! `../shared/data/hair` beside the workspace. The scene is the one other renderers were measured on:
//! light hair (absorption 0.06, 0.10, 0.20) in a constant white environment, 200 x 200, 64 bounces.
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use groom_formats::ReadOptions;
use hair_render::*;

fn data() -> PathBuf {
    std::env::var_os("GROOMKIT_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from)
}

/// User and system seconds of this process so far.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
    Some(ticks / 100.0)
}

fn scene(path: &Path, sigma: Vec3) -> Scene {
    let groom = groom_formats::read(path, &ReadOptions::default()).unwrap().groom;
    let material = HairMaterial {
        fibre: Material { color: HairColor::Absorption(sigma), ..Default::default() },
        ..Default::default()
    };
    Scene::build(SceneDescription {
        hair: vec![HairObject::still(groom, material)],
        environment: Some(Environment::constant(Vec3::ONE).unwrap()),
        ..Default::default()
    })
    .unwrap()
}

fn main() {
    let path = data().join("hair/straight.hair");
    if !path.exists() {
        println!("skipped: {} is not there", path.display());
        return;
    }
    let light = scene(&path, Vec3::new(0.06, 0.10, 0.20));
    let bounds = light.bounds().unwrap();
    // The peers' camera, turned to Y up: eye at (0.6, -2.9, 0.6) radii in the file's axes.
    let eye = bounds.center() + bounds.radius() * DVec3::new(0.6, 0.6, 2.9);
    let camera = Camera::look_at(eye, bounds.center(), DVec3::Y, 30f64.to_radians()).unwrap();
    for light_sampling in [LightSampling::Both, LightSampling::ScatteringOnly] {
        let settings = RenderSettings {
            width: 200,
            height: 200,
            spp: 16,
            max_bounces: 64,
            light_sampling,
            ..Default::default()
        };
        let before = cpu_seconds();
        let report = render(&light, &camera, &settings, &Silent).unwrap().report;
        let cpu = before.and_then(|b| cpu_seconds().map(|now| now - b)).unwrap_or(report.seconds);
        println!(
            "{light_sampling:?}: {:.3} M samples a CPU second, {:.2} M rays a CPU second, relMSE {:.4}, efficiency {:.1}",
            report.samples as f64 / cpu / 1e6,
            (report.closest_rays + report.shadow_rays) as f64 / cpu / 1e6,
            report.rel_mse.unwrap(),
            1.0 / (report.rel_mse.unwrap() * cpu),
        );
    }
    let white = scene(&path, Vec3::ZERO);
    let settings = RenderSettings {
        width: 32,
        height: 32,
        spp: 8,
        max_bounces: 512,
        roulette_start: 513,
        background: Background::Visible,
        ..Default::default()
    };
    let frame = render(&white, &camera, &settings, &Silent).unwrap();
    let mean: f64 = frame.beauty.iter().map(|b| f64::from(b.x)).sum::<f64>() / frame.beauty.len() as f64;
    let alpha: f64 = frame.alpha.iter().map(|&a| f64::from(a)).sum::<f64>() / frame.alpha.len() as f64;
    println!("white furnace, 512 bounces: mean {mean:.5} (1 is perfect; picture covered {alpha:.2})");
}
