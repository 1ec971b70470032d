//! What a turntable costs beyond rendering: many frames of a scene of next to nothing, beside a plain loop that renders
//! the same pictures and writes the same files; and looking at all of it again when nothing changed.
//!
//! `cargo bench -p turntable-cli --bench overhead -- [FRAMES] [FOLDER]`; the folder decides which disk is measured
//! [default: 1000 frames, the system's temporary folder].
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::path::{Path, PathBuf};
use std::time::Instant;

use glam::Vec3;
use hair_render::{
    Camera, Environment, HairMaterial, HairObject, Metadata, RenderSettings, Scene, SceneDescription,
};
use turntable::{Options, Plan, Silent, Summary};

const STRANDS: u32 = 40;
const POINTS: u32 = 6;
const EDGE: u32 = 16;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let frames: u32 = words.first().map_or(1000, |word| word.parse().unwrap());
    let folder = words.get(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let folder = tempfile::tempdir_in(folder).unwrap();
    let pipeline = folder.path().join("turn.yaml");
    let text = format!(
        "version: 1
groom: {{sample: {{style: wavy, strands: {STRANDS}, points: {POINTS}}}}}
lights: {{environment: {{constant: [1, 1, 1]}}}}
turntable: {{frames: {frames}}}
render: {{width: {EDGE}, height: {EDGE}, spp: 1, max_bounces: 1}}
"
    );
    std::fs::write(&pipeline, text).unwrap();

    let ms = |seconds: f64| seconds * 1e3;
    let each = |seconds: f64| ms(seconds) / f64::from(frames);
    println!("{frames} frames of {EDGE} x {EDGE} pixels, 1 sample a pixel, {STRANDS} strands; ms a frame");
    let mut best = [f64::INFINITY; 3];
    for round in 0..3 {
        let out = folder.path().join(format!("turntable{round}"));
        let plain = timed(|| plain_loop(&folder.path().join(format!("plain{round}")), frames));
        let (mut planned, mut looked) = (0.0, 0.0);
        let run = timed(|| {
            let start = Instant::now();
            let plan = plan(&pipeline, &out);
            planned = start.elapsed().as_secs_f64();
            assert_eq!(made(&plan.run(&Silent).unwrap()), frames);
        });
        let again = timed(|| {
            let start = Instant::now();
            let plan = plan(&pipeline, &out);
            looked = start.elapsed().as_secs_f64();
            assert_eq!(made(&plan.run(&Silent).unwrap()), 0);
        });
        println!(
            "plain loop {:.3}; turntable {:.3} (plan {:.0} ms), overhead {:.3}, ratio {:.2}; \
             nothing to do: {:.1} ms in all (looking {:.1})",
            each(plain),
            each(run),
            ms(planned),
            each(run - plain),
            run / plain,
            ms(again),
            ms(looked)
        );
        for (best, found) in best.iter_mut().zip([plain, run, again]) {
            *best = best.min(found);
        }
    }
    let [plain, run, again] = best;
    println!(
        "best: plain loop {:.3}, turntable {:.3}, overhead {:.3} ms a frame; nothing to do {:.1} ms in all",
        each(plain),
        each(run),
        each(run - plain),
        ms(again)
    );
}

fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn plan(pipeline: &Path, out: &Path) -> Plan {
    Plan::new(pipeline, Options { output: Some(out.to_owned()), ..Options::default() }).unwrap()
}

fn made(summary: &Summary) -> u32 {
    assert!(summary.failed.is_empty());
    summary.made.iter().filter(|file| file.extension().is_some_and(|e| e == "exr")).count() as u32
}

/// The same scene, pictures and files by hand.
fn plain_loop(folder: &Path, frames: u32) {
    std::fs::create_dir_all(folder).unwrap();
    let options = groom_samples::Options {
        style: groom_samples::Style::Wavy,
        strands: STRANDS,
        points: POINTS,
        ..groom_samples::Options::default()
    };
    let groom = groom_samples::hair(&options).unwrap();
    let description = SceneDescription {
        hair: vec![HairObject::still(groom, HairMaterial::default())],
        environment: Some(Environment::constant(Vec3::ONE).unwrap()),
        ..SceneDescription::default()
    };
    let scene = Scene::build(description).unwrap();
    let fov = 30f64.to_radians();
    for number in 0..frames {
        let azimuth = f64::from(number) / f64::from(frames) * std::f64::consts::TAU;
        let fitted = Camera::fit(scene.bounds(), azimuth, 0.0, fov, 1.0).unwrap();
        let settings = RenderSettings {
            width: EDGE,
            height: EDGE,
            spp: 1,
            max_bounces: 1,
            seed: u64::from(number),
            ..RenderSettings::default()
        };
        let frame = hair_render::render(&scene, &fitted, &settings, &hair_render::Silent).unwrap();
        let metadata = Metadata { camera: Some(fitted), digest: "0".repeat(32), ..Metadata::default() };
        frame.write_exr(&folder.join(format!("frame.{:04}.exr", number + 1)), &metadata).unwrap();
    }
}
