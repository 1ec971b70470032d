//! Seconds and errors of the scattering model, as figures: nanoseconds per call, and how far single
//! precision is from double over cases that try it.
#![allow(clippy::print_stdout)] // figures are what this program is for

use std::hint::black_box;
use std::time::Instant;

use fibre_scattering::{HairBcsdf, HairParameters, ReferenceBcsdf};
use glam::Vec3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    costs()?;
    errors()?;
    Ok(())
}

/// A direction and an offset, spread evenly by the golden ratio's multiples.
fn spread(index: u32) -> (Vec3, f32, [f32; 4]) {
    let fraction = |factor: f64| (f64::from(index) * factor).fract() as f32;
    let u =
        [fraction(0.618_033_988), fraction(0.754_877_666), fraction(0.569_840_291), fraction(0.819_172_513)];
    let sin = 2.0 * u[0] - 1.0;
    let cos = (1.0 - sin * sin).sqrt();
    let (z, y) = (std::f32::consts::TAU * u[1]).sin_cos();
    (Vec3::new(sin, cos * y, cos * z), 2.0 * u[2] - 1.0, u)
}

/// Best of five rounds, which a busy machine disturbs least.
fn nanoseconds(mut call: impl FnMut(u32)) -> f64 {
    const CALLS: u32 = 200_000;
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        for index in 0..CALLS {
            call(index);
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS));
    }
    best
}

fn costs() -> Result<(), fibre_scattering::ScatteringError> {
    println!("ns per call            white  coloured    smooth");
    let materials = [(0.3, Vec3::ZERO), (0.3, Vec3::new(0.1, 0.4, 1.2)), (0.03, Vec3::new(0.1, 0.4, 1.2))];
    let mut table = [[0.0; 3]; 4];
    let inputs: Vec<_> = (0..256).map(spread).collect();
    let input = |index: u32| inputs[index as usize % inputs.len()];
    for (column, (beta, sigma_a)) in materials.into_iter().enumerate() {
        let parameters = HairParameters { beta_m: beta, beta_n: beta, sigma_a, ..HairParameters::default() };
        let bcsdf = HairBcsdf::new(&parameters)?;
        let hits: Vec<_> = inputs.iter().map(|&(wo, h, _)| bcsdf.at(wo, h)).collect();
        let hit = |index: u32| &hits[(index as usize * 7 + 3) % hits.len()];
        table[0][column] = nanoseconds(|i| {
            let (wo, h, _) = input(i);
            black_box(bcsdf.at(black_box(wo), black_box(h)));
        });
        table[1][column] = nanoseconds(|i| {
            black_box(hit(i).evaluate_with_pdf(black_box(input(i).0)));
        });
        table[2][column] = nanoseconds(|i| {
            black_box(hit(i).pdf(black_box(input(i).0)));
        });
        table[3][column] = nanoseconds(|i| {
            black_box(hit(i).sample(black_box(input(i).2)));
        });
    }
    for (name, row) in ["at", "evaluate_with_pdf", "pdf", "sample"].into_iter().zip(table) {
        println!("{name:<20} {:>7.0} {:>9.0} {:>9.0}", row[0], row[1], row[2]);
    }
    Ok(())
}

/// The error that matters is where light goes: directions are drawn by the model itself.
fn errors() -> Result<(), fibre_scattering::ScatteringError> {
    println!("\nf32 against f64 at sampled directions (relative error of f cos)");
    println!("  beta     eta  theta_o       mean      worst");
    for beta in [0.001, 0.01, 0.1, 0.3, 1.0] {
        for (eta, theta_o) in [(1.55, 10.0_f64), (1.55, 89.99), (1.0001, 10.0), (3.0, -80.0)] {
            let parameters = HairParameters {
                beta_m: beta,
                beta_n: beta,
                eta,
                sigma_a: Vec3::new(0.1, 0.4, 1.2),
                ..HairParameters::default()
            };
            let (single, double) = (HairBcsdf::new(&parameters)?, ReferenceBcsdf::new(&parameters)?);
            let (sin, cos) = theta_o.to_radians().sin_cos();
            let wo = Vec3::new(sin as f32, cos as f32, 0.0);
            let (mut sum, mut count, mut worst) = (0.0, 0.0, 0.0_f64);
            for index in 0..20_000 {
                let (_, h, u) = spread(index);
                let Some(sample) = single.at(wo, h).sample(u) else {
                    continue;
                };
                let wi = sample.wi.as_dvec3().to_array();
                let (exact, _) = double.at(wo.as_dvec3().to_array(), f64::from(h)).evaluate_with_pdf(wi);
                let exact: f64 = exact.iter().map(|lobe| lobe[0]).sum();
                let error = (f64::from(sample.values.sum().x) / exact - 1.0).abs();
                sum += error;
                count += 1.0;
                worst = worst.max(error);
            }
            println!("{beta:>6} {eta:>7} {theta_o:>8} {:>10.1e} {worst:>10.1e}", sum / count);
        }
    }
    Ok(())
}
