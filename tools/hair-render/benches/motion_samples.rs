//! What more motion keys buy and cost: error against time on a spinning head of hair, against 65 keys (64 steps).
//!
//! `cargo bench -p hair-render-cli --bench motion_samples [-- FILE]` prints the table; a FILE that ends in `.html`,
//! `.json` or `.csv` gets it as an error report. The head is this project's own sample: 5,000 strands of 16 points
//! and the head they grow on, which turns about its axis by 30 degrees (extreme) or 5 (quick) while the shutter is
//! open. Every picture is made of the same random numbers, so that they differ by their motion and little else;
//! what they differ by all the same is measured too, by two pictures whose motion differs by less than a micrometre.
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::path::Path;
use std::time::Instant;

use error_report::{Figures, Point, Report, Series};
use glam::{DMat3, DVec3, Vec3};
use groom::Groom;
use groom_samples::{Options, hair, head_obj};
use hair_render::*;
use moving_mesh::TriangleMesh;

const SIZE: u32 = 160;
const SPP: u32 = 16;
/// Keys of the reference.
const REFERENCE: usize = 65;
/// The time between opening and closing, in seconds about the frame.
const SECONDS: [f64; 2] = [-0.25 / 24.0, 0.25 / 24.0];

/// What spins.
struct Head {
    groom: Groom,
    mesh: TriangleMesh,
}

/// How its motion is told to the renderer.
#[derive(Clone, Copy)]
enum Told {
    Positions(usize),
    Velocities,
    Accelerations(usize),
}

/// One way of telling it, measured.
struct Measured {
    told: Told,
    seconds: f64,
    bytes: usize,
    frame: Frame,
    /// How far any point of the hair is from where it should be, at worst, in millimetres.
    astray: f64,
}

impl Head {
    fn new() -> Self {
        let groom = hair(&Options { strands: 5000, points: 16, ..Options::default() }).unwrap();
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("motion_samples_head.obj");
        std::fs::write(&path, head_obj()).unwrap();
        Head { groom, mesh: TriangleMesh::open(&path).unwrap() }
    }

    fn motion(&self, points: &[Vec3], turn: f64, told: Told) -> Motion {
        let spin = turn / (SECONDS[1] - SECONDS[0]);
        match told {
            Told::Positions(keys) => {
                let at = |key: usize| turned(points, turn * (key as f64 / (keys - 1) as f64 - 0.5));
                Motion::keys((0..keys).map(at).collect()).unwrap()
            }
            Told::Velocities => Motion::velocities(points, &velocities(points, spin), SECONDS).unwrap(),
            Told::Accelerations(keys) => {
                let speeding: Vec<Vec3> =
                    points.iter().map(|p| Vec3::new(p.x, 0.0, p.z) * (-spin * spin) as f32).collect();
                Motion::accelerations(points, &velocities(points, spin), &speeding, SECONDS, keys).unwrap()
            }
        }
    }

    fn shoot(&self, turn: f64, told: Told, seed: u64) -> Measured {
        let fibre = Material { color: HairColor::Color(Vec3::new(0.35, 0.2, 0.1)), ..Material::default() };
        let material = HairMaterial { fibre, ..HairMaterial::default() };
        let hair = HairObject {
            motion: self.motion(self.groom.positions(), turn, told),
            ..HairObject::still(self.groom.clone(), material)
        };
        let mut mesh = MeshObject::still(self.mesh.clone(), Vec3::new(0.5, 0.36, 0.28));
        mesh.motion = self.motion(&self.mesh.positions, turn, told);
        let description = SceneDescription {
            hair: vec![hair],
            meshes: vec![mesh],
            environment: Some(Environment::constant(Vec3::ONE).unwrap()),
            ..SceneDescription::default()
        };
        let astray = self.astray(&description.hair[0].motion, turn);
        let start = Instant::now();
        let scene = Scene::build(description).unwrap();
        let settings = RenderSettings {
            width: SIZE,
            height: SIZE,
            spp: SPP,
            seed,
            max_bounces: 4,
            ..Default::default()
        };
        let camera = Camera::orbit(DVec3::new(0.0, -0.03, 0.0), 0.8, 0.5, 0.3, 0.45).unwrap();
        let frame = render(&scene, &camera, &settings, &Silent).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        Measured { told, seconds, bytes: scene.tracing_statistics().bytes, frame, astray }
    }

    /// Looked at at many times of the shutter, and at every 97th point.
    fn astray(&self, motion: &Motion, turn: f64) -> f64 {
        let mut worst: f64 = 0.0;
        for step in 0..=256 {
            let time = f64::from(step) / 256.0;
            for (number, point) in self.groom.positions().iter().enumerate().step_by(97) {
                let there = DMat3::from_rotation_y(turn * (time - 0.5)) * point.as_dvec3();
                worst = worst.max((motion.at(number, time).unwrap() - there).length());
            }
        }
        1e3 * worst
    }
}

fn turned(points: &[Vec3], turn: f64) -> Vec<Vec3> {
    let turn = DMat3::from_rotation_y(turn);
    points.iter().map(|p| (turn * p.as_dvec3()).as_vec3()).collect()
}

fn velocities(points: &[Vec3], spin: f64) -> Vec<Vec3> {
    points.iter().map(|p| (DVec3::Y * spin).cross(p.as_dvec3()).as_vec3()).collect()
}

impl std::fmt::Display for Told {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Told::Positions(keys) => write!(f, "{keys} positions"),
            Told::Velocities => write!(f, "velocities"),
            Told::Accelerations(keys) => write!(f, "accelerations, {keys} keys"),
        }
    }
}

/// Share of the coverage that lies elsewhere, and the trimmed relMSE of the beauty.
fn difference(frame: &Frame, reference: &Frame) -> (f64, f64) {
    let of = |a: &f32| f64::from(*a);
    let moved: f64 = frame.alpha.iter().zip(&reference.alpha).map(|(a, b)| (of(a) - of(b)).abs()).sum();
    let flat = |frame: &Frame| frame.beauty.iter().flat_map(|p| p.to_array()).collect::<Vec<f32>>();
    let figures = Figures::compare(&flat(frame), &flat(reference)).unwrap();
    (moved / reference.alpha.iter().map(of).sum::<f64>(), figures.rel_mse_trimmed)
}

fn main() {
    let head = Head::new();
    let mut report = Report::new("Motion keys of a spinning head of hair").with_about(
        "scene",
        format!("5,000 strands of 16 points and their head, {SIZE} x {SIZE}, {SPP} spp, {REFERENCE} keys as reference"),
    );
    for degrees in [30.0_f64, 5.0] {
        let turn = degrees.to_radians();
        let reference = head.shoot(turn, Told::Positions(REFERENCE), 0);
        println!(
            "{degrees} degrees within the shutter; reference {REFERENCE} positions, {:.2} s, {:.1} MB, relMSE {:.4}",
            reference.seconds,
            reference.bytes as f64 / 1e6,
            reference.frame.report.rel_mse.unwrap()
        );
        let near = head.shoot(turn, Told::Positions(REFERENCE - 2), 0);
        let other = head.shoot(turn, Told::Positions(REFERENCE), 1);
        for (what, frame) in [("the same motion", &near.frame), ("another seed", &other.frame)] {
            let (coverage, rel_mse) = difference(frame, &reference.frame);
            println!("  {what:24} coverage {:8.4} %, beauty relMSE {rel_mse:.5}", 100.0 * coverage);
        }
        let kinds = [
            ("positions", vec![2, 3, 5, 9, 17].into_iter().map(Told::Positions).collect::<Vec<_>>()),
            ("velocities", vec![Told::Velocities]),
            ("accelerations", vec![2, 3, 5, 9].into_iter().map(Told::Accelerations).collect()),
        ];
        for (name, ways) in kinds {
            let label = format!("{name}, {degrees} degrees");
            let mut series = Series::convergence(
                label,
                "coverage elsewhere",
                format!("{REFERENCE} positions, same seed"),
                0.0,
            );
            for told in ways {
                let found = head.shoot(turn, told, 0);
                let (coverage, rel_mse) = difference(&found.frame, &reference.frame);
                println!(
                    "  {:24} coverage {:8.4} %, beauty relMSE {rel_mse:.5}, astray {:9.5} mm, {:.2} s, {:.1} MB",
                    found.told.to_string(),
                    100.0 * coverage,
                    found.astray,
                    found.seconds,
                    found.bytes as f64 / 1e6,
                );
                let point = Point::new(found.told.to_string(), found.seconds, coverage);
                series.points.push(
                    point
                        .with("beauty relMSE", rel_mse)
                        .with("astray mm", found.astray)
                        .with("bytes", found.bytes as f64),
                );
            }
            report.series.push(series);
        }
        let still = head.shoot(0.0, Told::Positions(2), 0);
        println!("  {:24} {:.2} s, {:.1} MB", "standing still", still.seconds, still.bytes as f64 / 1e6);
    }
    let Some(path) = std::env::args().skip(1).find(|argument| !argument.starts_with("--")) else { return };
    let text = match Path::new(&path).extension().and_then(|ending| ending.to_str()) {
        Some("html") => report.to_html().unwrap(),
        Some("json") => report.to_json().unwrap(),
        Some("csv") => report.to_csv().unwrap(),
        _ => return println!("{path}: expected a name that ends in .html, .json or .csv"),
    };
    std::fs::write(&path, text).unwrap();
    println!("{path}");
}
