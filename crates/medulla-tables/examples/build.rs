//! Tables at default quality: seconds, bytes, and how far albedo and directions are from an independent walk.
//!
//! `cargo run --release -p medulla-tables --example build [walks per ray [walks per row]]`
#![allow(clippy::print_stdout)] // figures are what this program is for

#[path = "../../fibre-scattering/tests/fibres/brute_force/mod.rs"]
mod brute_force;

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

use brute_force::{Chance, Cylinders, SET_A, SET_B};
use fibre_scattering::{FurParameters, FurReference, HairParameters, Medulla, MedullaKey, ScatteringError};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Cortex and medulla, per radius.
const ABSORPTIONS: [[f64; 2]; 8] =
    [[0.0, 0.0], [0.4, 0.0], [0.0, 0.2], [0.39, 0.21], [0.05, 0.05], [2.0, 0.0], [0.0, 2.0], [3.0, 3.0]];

/// Offsets across the fibre, all alike, and inclinations in degrees.
const OFFSETS: [f64; 6] = [0.08, 0.25, 0.42, 0.58, 0.75, 0.92];
const INCLINATIONS: [f64; 4] = [0.0, 20.0, 45.0, 75.0];

/// Cells in which directions are compared: around and along the fibre.
const CELLS: (usize, usize) = (24, 8);

fn main() -> Result<(), ScatteringError> {
    let mut numbers = std::env::args().skip(1).map_while(|argument| argument.parse::<u32>().ok());
    let (per_ray, per_row) = (numbers.next().unwrap_or(100_000), numbers.next().unwrap_or(0));
    let of = |kappa, sigma_s, g| Cylinders { eta: 1.55, kappa, sigma_s, g, layers: None, film: None };
    let materials = [
        ("set A", SET_A),
        ("set B", SET_B),
        ("kappa .5, sigma_s 3, g .5", of(0.5, 3.0, 0.5)),
        ("thick, forward", of(0.95, 100.0, 0.9)),
        ("thick, backward", of(0.9, 100.0, -0.5)),
        ("thin", of(0.3, 0.1, 0.0)),
        ("narrow", of(0.8, 3.0, 0.98)),
    ];
    println!(
        "{} threads; error of the albedo in per cent of it, mean over offsets; L1 of directions in 24 x 8 cells,",
        rayon::current_num_threads()
    );
    println!("in brackets that of the {per_ray} walks per ray it is measured by\n");
    for (name, cylinders) in materials {
        report(name, &cylinders, per_ray, per_row)?;
    }
    Ok(())
}

fn report(name: &str, cylinders: &Cylinders, per_ray: u32, per_row: u32) -> Result<(), ScatteringError> {
    let medulla = Medulla {
        kappa: cylinders.kappa as f32,
        sigma_s: cylinders.sigma_s as f32,
        g: cylinders.g as f32,
        ..Medulla::NONE
    };
    let hair = HairParameters { eta: cylinders.eta as f32, ..HairParameters::default() };
    let parameters = FurParameters { hair, medulla };
    let Some(key) = MedullaKey::needed(&parameters) else { return Ok(()) };
    let key = MedullaKey { walks: per_row, ..key };
    let start = Instant::now();
    let table = Arc::new(medulla_tables::build(&key)?);
    let seconds = start.elapsed().as_secs_f64();
    println!("{name}: {} walks per row, {seconds:.2} s, {} bytes", key.walks_per_row(), table.size());
    let fur = FurReference::new(&parameters, Some(table))?;
    for theta in INCLINATIONS {
        let rays: Vec<_> =
            OFFSETS.par_iter().map(|&h| compare(cylinders, &fur, theta.to_radians(), h, per_ray)).collect();
        let mean = |value: &dyn Fn(&Ray) -> f64| rays.iter().map(value).sum::<f64>() / rays.len() as f64;
        let errors: Vec<_> = (0..ABSORPTIONS.len())
            .map(|i| 100.0 * (mean(&|ray| ray.albedos[i][0]) / mean(&|ray| ray.albedos[i][1]) - 1.0))
            .map(|error| format!("{error:+.2}"))
            .collect();
        let worst = rays.iter().map(|ray| ray.worst()).fold(0.0, f64::max);
        println!(
            "  theta {theta:>2}: albedo {}; worst ray {worst:.4}; L1 {:.3} ({:.3})",
            errors.join(" "),
            mean(&|ray| ray.l1),
            mean(&|ray| ray.noise)
        );
    }
    Ok(())
}

struct Ray {
    /// Of the table and of the walks, for each absorption.
    albedos: [[f64; 2]; 8],
    l1: f64,
    noise: f64,
}

impl Ray {
    fn worst(&self) -> f64 {
        self.albedos.iter().map(|[table, walks]| (table - walks).abs()).fold(0.0, f64::max)
    }
}

fn compare(cylinders: &Cylinders, fur: &FurReference, theta: f64, h: f64, walks: u32) -> Ray {
    let wo = [theta.sin(), theta.cos(), 0.0];
    let mut chance = Chance::new(h.to_bits() ^ theta.to_bits());
    let mut albedos = [[0.0; 2]; 8];
    let (mut counts, mut scattered) = (vec![0.0; CELLS.0 * CELLS.1], 0.0_f64);
    for _ in 0..walks {
        let outcome = cylinders.walk(wo, h, &mut chance);
        for ([_, sum], absorption) in albedos.iter_mut().zip(ABSORPTIONS) {
            *sum += outcome.passed(absorption) / f64::from(walks);
        }
        if outcome.scatterings > 0 {
            scattered += 1.0;
            counts[cell(outcome.way)] += 1.0;
        }
    }
    for ([found, _], [cortex, medulla]) in albedos.iter_mut().zip(ABSORPTIONS) {
        let albedo = fur.at_absorbing(wo, h, [[cortex; 3], [medulla; 3]]).albedo();
        *found = albedo.iter().map(|lobe| lobe[0]).sum();
    }
    let expected = directions(fur, wo, h);
    let scattered = scattered.max(1.0);
    let (mut l1, mut noise) = (0.0, 0.0);
    for (count, expected) in counts.iter().zip(expected) {
        l1 += (count / scattered - expected).abs();
        noise += (expected * 2.0 / (std::f64::consts::PI * scattered)).sqrt();
    }
    Ray { albedos, l1, noise }
}

fn cell(way: [f64; 3]) -> usize {
    let around = way[2].atan2(way[1]).rem_euclid(TAU) / TAU * CELLS.0 as f64;
    let along = (way[0] + 1.0) / 2.0 * CELLS.1 as f64;
    (around as usize).min(CELLS.0 - 1) * CELLS.1 + (along as usize).min(CELLS.1 - 1)
}

/// The part of scattered light in each cell, by the table.
fn directions(fur: &FurReference, wo: [f64; 3], h: f64) -> Vec<f64> {
    const FINE: usize = 6;
    let hit = fur.at_absorbing(wo, h, [[0.0; 3]; 2]);
    let (around, along) = (CELLS.0 * FINE, CELLS.1 * FINE);
    let mut parts = vec![0.0; CELLS.0 * CELLS.1];
    for i in 0..around {
        let (sin_phi, cos_phi) = ((i as f64 + 0.5) / around as f64 * TAU).sin_cos();
        for j in 0..along {
            let sin = (j as f64 + 0.5) / along as f64 * 2.0 - 1.0;
            let cos = (1.0 - sin * sin).sqrt();
            let way = [sin, cos * cos_phi, cos * sin_phi];
            parts[cell(way)] += hit.evaluate_with_pdf(way).0[4][0];
        }
    }
    // Where nothing scatters there is nothing to compare.
    let sum = parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    parts.into_iter().map(|part| part / sum).collect()
}
