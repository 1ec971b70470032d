//! Binding and carrying at the size of a head: 50,000 strands of 25 points on 60,000 triangles, and what the
//! straightforward way costs beside it.
//!
//! `cargo bench -p groom-binding --bench carry [-- --write FOLDER] [--peers PYTHON]...`
//!
//! With `--write` the mesh and the points are left in FOLDER as raw little-endian arrays. With `--peers`, `peers.py`
//! times Blender's Surface Deform and OpenUSD's skinning on them, whichever that Python has.

#![allow(clippy::print_stdout)] // figures are what a bench is for

#[path = "common/ball.rs"]
mod ball;

use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use glam::{DMat3, DQuat, DVec3, Vec3};
use groom::{Groom, random};
use groom_binding::{BindOptions, Binding, RootFrames, Surface, carry_rigid};
use moving_mesh::Pose;
use rayon::ThreadPoolBuilder;

use crate::ball::ball;

const STRANDS: u32 = 50_000;
const POINTS: u32 = 25;
/// Timings of which the best counts.
const ROUNDS: usize = 20;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let (triangles, rest) = ball();
    let groom = fur()?;
    let surface = Surface { triangles: &triangles, rest: &rest, uvs: None };
    let points = groom.point_count();
    println!(
        "{} triangles, {} vertices, {STRANDS} strands, {points} points; least of {ROUNDS} times, and mean on a core",
        triangles.len(),
        rest.positions.len()
    );
    let one = ThreadPoolBuilder::new().num_threads(1).build()?;
    let options = BindOptions::default();
    println!("| what | threads | milliseconds | of one core's time |\n|---|---|---|---|");
    let row = |what: &str, threads: usize, (wall, cpu): (f64, f64)| {
        // The main thread only waits for the others.
        let cpu = if threads == 1 { format!("{:.2}", cpu * 1e3) } else { "-".to_owned() };
        println!("| {what} | {threads} | {:.2} | {cpu} |", wall * 1e3);
    };
    row(
        "bind, tree and all",
        1,
        one.install(|| best(|| Binding::new(&groom, &surface, &options).map(drop)))?,
    );
    let all = rayon::current_num_threads();
    row("bind, tree and all", all, best(|| Binding::new(&groom, &surface, &options).map(drop))?);

    let (binding, report) = Binding::new(&groom, &surface, &options)?;
    let poses: Vec<Pose> = (1..=ROUNDS).map(|frame| nod(&rest, frame as f64 / ROUNDS as f64)).collect();
    let mut frames = RootFrames::new(&binding, surface)?;
    let mut out = Vec::new();
    let mut pose = poses.iter().cycle();
    let mut next = || pose.next().unwrap_or(&rest);
    row("frames of all roots", 1, one.install(|| best(|| frames.follow(next())))?);
    row(
        "carry by known frames",
        1,
        one.install(|| best(|| carry_rigid(&groom, &frames, DVec3::ZERO, &mut out)))?,
    );
    let mut whole =
        || frames.follow(next()).and_then(|()| carry_rigid(&groom, &frames, DVec3::ZERO, &mut out));
    row("carry, frames and all", 1, one.install(|| best(&mut whole))?);
    row("carry, frames and all", all, best(&mut whole)?);

    let plain_binding = plain::bind(&groom, &triangles, &rest.positions, &binding);
    let mut plain_out = Vec::new();
    let mut pose = poses.iter().cycle();
    let mut next = || pose.next().unwrap_or(&rest);
    row(
        "plain loop: a matrix a strand, point after point",
        1,
        best(|| {
            plain::carry(&groom, &triangles, &next().positions, &plain_binding, &mut plain_out);
            Ok::<(), std::convert::Infallible>(())
        })?,
    );
    frames.follow(&poses[0])?;
    carry_rigid(&groom, &frames, DVec3::ZERO, &mut out)?;
    plain::carry(&groom, &triangles, &poses[0].positions, &plain_binding, &mut plain_out);
    let apart = out.iter().zip(&plain_out).fold(0f32, |most, (a, b)| most.max(a.distance(*b)));
    println!(
        "\nroots off the mesh: at most {:.4}; plain loop and carry differ by {apart:.1e}",
        report.distance_at(1.0).unwrap_or(0.0)
    );
    let given = |option| {
        let arguments: Vec<String> = std::env::args().collect();
        let after = arguments.windows(2).filter(|pair| pair[0] == option).map(|pair| pair[1].clone());
        after.collect::<Vec<_>>()
    };
    let scratch = tempfile::tempdir()?;
    let pythons = given("--peers");
    let folder = given("--write").pop().map_or_else(|| scratch.path().to_owned(), PathBuf::from);
    if !pythons.is_empty() || folder != scratch.path() {
        write(&folder, &triangles, &[&rest, &poses[0]], &groom)?;
    }
    for python in pythons {
        println!();
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers.py");
        let status = Command::new(&python).arg(script).arg(&folder).status()?;
        println!("{python}: {status}");
    }
    Ok(())
}

/// The least time that `run` takes, in seconds, and the mean of what this thread's core spends on it, which is what
/// an idle machine would take; not-a-number where the system does not tell it. The mean, as Linux counts by ticks.
fn best<E>(mut run: impl FnMut() -> std::result::Result<(), E>) -> std::result::Result<(f64, f64), E> {
    let (mut wall, on_core) = (f64::INFINITY, core_time());
    for _ in 0..ROUNDS {
        let start = Instant::now();
        black_box(run())?;
        wall = wall.min(start.elapsed().as_secs_f64());
    }
    Ok((wall, (core_time() - on_core) / ROUNDS as f64))
}

/// Seconds that this thread has been on a core, as Linux tells them.
fn core_time() -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    nanoseconds.map_or(f64::NAN, |n| n * 1e-9)
}

/// Curved strands that start a little above or below the ball, in no order.
fn fur() -> Result<Groom> {
    let mut points = Vec::with_capacity((STRANDS * POINTS) as usize);
    for strand in 0..STRANDS {
        let one = |purpose: &str| 2.0 * random(1, strand, purpose) - 1.0;
        let direction = Vec3::new(one("x"), one("y"), one("z")).normalize_or(Vec3::X);
        let across = direction.any_orthonormal_vector();
        for i in 0..POINTS {
            let t = i as f32 / (POINTS - 1) as f32;
            points.push(direction * (1.0 + 0.01 * one("off") + 0.3 * t) + across * (0.2 * t * t));
        }
    }
    Ok(Groom::new((0..=STRANDS).map(|strand| strand * POINTS).collect(), points)?)
}

/// A nod with a bend: nothing moves as a rigid body.
fn nod(rest: &Pose, t: f64) -> Pose {
    let bent =
        |p: &DVec3| DQuat::from_rotation_x(0.5 * t * (1.0 + 0.3 * p.y)) * *p + DVec3::new(0.1 * t, 0.0, 0.0);
    Pose { positions: rest.positions.iter().map(bent).collect(), normals: None }
}

/// What one writes first: per strand a matrix from the triangle's own axes, f64 throughout, one thread, no smoothed
/// normals, no care for triangles without an area.
mod plain {
    use super::*;

    pub struct Bound {
        triangle: usize,
        weights: DVec3,
        axes: DMat3,
        at: DVec3,
    }

    fn axes([a, b, c]: [DVec3; 3]) -> DMat3 {
        let tangent = (b - a).normalize();
        let normal = (b - a).cross(c - a).normalize();
        DMat3::from_cols(tangent, normal, tangent.cross(normal))
    }

    pub fn bind(_: &Groom, triangles: &[[u32; 3]], rest: &[DVec3], binding: &Binding) -> Vec<Bound> {
        let bound = |root: &groom_binding::Root| {
            let corners = triangles[root.triangle as usize].map(|v| rest[v as usize]);
            let w = root.barycentrics;
            let at = w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
            Bound { triangle: root.triangle as usize, weights: w, axes: axes(corners), at }
        };
        binding.roots().iter().map(bound).collect()
    }

    pub fn carry(
        groom: &Groom,
        triangles: &[[u32; 3]],
        pose: &[DVec3],
        bound: &[Bound],
        out: &mut Vec<Vec3>,
    ) {
        out.clear();
        for (strand, bound) in bound.iter().enumerate() {
            let corners = triangles[bound.triangle].map(|v| pose[v as usize]);
            let w = bound.weights;
            let at = w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
            let turn = axes(corners) * bound.axes.transpose();
            for point in groom.strand(strand) {
                out.push((at + turn * (point.as_dvec3() - bound.at)).as_vec3());
            }
        }
    }
}

fn write(folder: &Path, triangles: &[[u32; 3]], poses: &[&Pose], groom: &Groom) -> Result<()> {
    fs::create_dir_all(folder)?;
    let numbers: Vec<u8> = triangles.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    fs::write(folder.join("triangles.u32"), numbers)?;
    let bytes = |points: &mut dyn Iterator<Item = Vec3>| -> Vec<u8> {
        points.flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect()
    };
    for (name, pose) in ["rest.f32", "pose.f32"].iter().zip(poses) {
        fs::write(folder.join(name), bytes(&mut pose.positions.iter().map(|p| p.as_vec3())))?;
    }
    fs::write(folder.join("points.f32"), bytes(&mut groom.positions().iter().copied()))?;
    Ok(())
}
