//! What it costs to carry strands in every way there is, and what accuracy costs: 50,000 strands of 25 points on
//! 60,000 triangles.
//!
//! `cargo bench -p groom-binding --bench motion [-- times | accuracy]`

#![allow(clippy::print_stdout)] // figures are what a bench is for

#[path = "common/ball.rs"]
mod ball;

use std::time::Instant;

use glam::{DQuat, DVec3};
use groom::Groom;
use groom_binding::{
    AccuracyRow, BindOptions, Binding, BindingError, Blend, Carrier, CarryMode, CarryOptions, Moved, Stencil,
    Surface, blending_accuracy, velocity_accuracy,
};
use groom_samples::{FurOptions, FurSurface, fur_on};
use moving_mesh::Pose;

use crate::ball::ball;

const STRANDS: u32 = 50_000;
const POINTS: u32 = 25;
/// Timings of which the best counts.
const ROUNDS: u32 = 5;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let (triangles, rest) = ball();
    let surface = Surface { triangles: &triangles, rest: &rest, uvs: None };
    let fur = FurSurface { positions: &rest.positions, triangles: &triangles, normals: None };
    let options = FurOptions { strands: STRANDS, points: POINTS, length: 0.1, ..FurOptions::default() };
    let groom = fur_on(&fur, &options)?;
    let (binding, _) = Binding::new(&groom, &surface, &BindOptions::default())?;
    let points = groom.point_count();
    println!("{} triangles, {STRANDS} strands, {points} points; best of {ROUNDS}", triangles.len());

    let only = std::env::args().nth(1).filter(|argument| !argument.starts_with("--"));
    let wanted = |part: &str| only.as_deref().is_none_or(|only| only == part);
    if wanted("times") {
        times(&groom, &binding, surface)?;
    }
    if wanted("accuracy") {
        let options = FurOptions { strands: 2000, ..options };
        accuracy(&fur_on(&fur, &options)?, surface)?;
    }
    Ok(())
}

/// What every way of carrying costs.
fn times(groom: &Groom, binding: &Binding, surface: Surface<'_>) -> Result<()> {
    println!("\n| what | threads | ms a frame | pushed | inside | deepest |\n|---|---|---|---|---|---|");
    let blended = |anchors| CarryMode::Blended(Blend { anchors, ..Blend::default() });
    let restored = CarryMode::Blended(Blend { restore_lengths: true, ..Blend::default() });
    let ways = [
        ("rigid", CarryMode::Rigid, None),
        ("blended, 16 anchors", blended(16), None),
        ("blended, 96 anchors", blended(96), None),
        ("blended, 96 anchors, lengths restored", restored, None),
        ("rigid, kept out at 0.2 % of the radius", CarryMode::Rigid, Some(0.002)),
    ];
    for (name, mode, keep_out) in ways {
        let options = CarryOptions { mode, keep_out, ..CarryOptions::default() };
        for threads in [1, rayon::current_num_threads()] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            let mut carrier = Carrier::new(groom, binding, surface, options)?;
            pool.install(|| time(name, threads, &mut carrier, surface.rest))?;
        }
    }

    Ok(())
}

/// What accuracy costs, on fewer strands: the reference takes long.
fn accuracy(groom: &Groom, surface: Surface<'_>) -> Result<()> {
    let (binding, _) = Binding::new(groom, &surface, &BindOptions::default())?;
    println!("\nAccuracy: {} points", groom.point_count());
    let poses: Vec<Pose> = [0.35, 1.0].map(|t| nod(surface.rest, t)).into();
    let anchors = [4, 8, 16, 32, 64, 96, 128, 256, 512];
    let rows = blending_accuracy(groom, &binding, surface, &poses, &anchors, 1500)?;
    table("anchors", "1500 anchors, in sizes of the mesh", &rows);
    let steps: Vec<f64> = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125].map(|frames| frames / 24.0).into();
    let pose = |t: f64| Ok::<_, BindingError>(nod(surface.rest, t));
    let rows = velocity_accuracy(groom, &binding, surface, 0.7, None, &steps, pose)?;
    table("seconds from pose to pose", "a hundredth of the least step, in greatest speeds", &rows);
    Ok(())
}

type Seconds = std::result::Result<f64, BindingError>;

fn time(
    name: &str,
    threads: usize,
    carrier: &mut Carrier<'_>,
    rest: &Pose,
) -> std::result::Result<(), BindingError> {
    let poses: Vec<Pose> = (0..ROUNDS).map(|round| nod(rest, f64::from(round) / f64::from(ROUNDS))).collect();
    let (mut out, mut moved) = (Vec::new(), Moved::default());
    let mut report = carrier.positions(&poses[0], &mut out)?;
    let mut least = f64::INFINITY;
    for pose in &poses {
        let start = Instant::now();
        report = carrier.positions(pose, &mut out)?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    let mut moved_in = |accelerations| -> Seconds {
        let mut least = f64::INFINITY;
        for three in poses.windows(3) {
            let stencil = Stencil::new(0.5, 1.0 / f64::from(ROUNDS), None)?;
            let start = Instant::now();
            carrier.moved(&stencil, [&three[0], &three[1], &three[2]], accelerations, &mut moved)?;
            least = least.min(start.elapsed().as_secs_f64());
        }
        Ok(least)
    };
    let (velocities, accelerations) = (moved_in(false)?, moved_in(true)?);
    let told = format!("{} | {} | {:.1e}", report.pushed, report.inside, report.deepest);
    let row = |what, seconds: f64| println!("| {name}: {what} | {threads} | {:.2} | {told} |", seconds * 1e3);
    row("positions", least);
    row("and velocities, three poses", velocities);
    row("and accelerations", accelerations);
    Ok(())
}

fn table(value: &str, reference: &str, rows: &[AccuracyRow]) {
    println!("\nAgainst {reference}:\n\n| {value} | ms | root mean square | worst |\n|---|---|---|---|");
    for row in rows {
        println!("| {:.4} | {:.2} | {:.2e} | {:.2e} |", row.value, row.seconds * 1e3, row.error, row.worst);
    }
}

/// A nod with a bend and a breath: nothing moves as a rigid body.
fn nod(rest: &Pose, t: f64) -> Pose {
    let bent = |p: &DVec3| {
        let breath = 1.0 + 0.1 * (5.0 * t + p.x).sin();
        DQuat::from_rotation_x(1.2 * (3.0 * t).sin() * (1.0 + 0.5 * p.y)) * (*p * breath) + DVec3::X * t
    };
    Pose { positions: rest.positions.iter().map(bent).collect(), normals: None }
}
