//! What the far field costs and how far it is from the near field: a table by nodes and roughness.
//!
//! `cargo run --release -p fibre-scattering --example far_field`
#![allow(clippy::print_stdout)]

use std::f32::consts::{PI, TAU};
use std::hint::black_box;
use std::time::Instant;

use fibre_scattering::{Absorption, FarFieldBcsdf, HairBcsdf, HairParameters, ScatteringError};
use glam::Vec3;

const AZIMUTHS: u16 = 360;
const OFFSETS: u16 = 4096;

fn direction(theta: f32, phi: f32) -> Vec3 {
    let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
    Vec3::new(sin, cos * cos_phi, cos * sin_phi)
}

fn azimuth(step: u16) -> f32 {
    (f32::from(step) + 0.5) / f32::from(AZIMUTHS) * TAU - PI
}

/// The least of ten means over ten thousand calls, in nanoseconds.
fn nanoseconds(mut call: impl FnMut(u16)) -> f64 {
    (0..10)
        .map(|_| {
            let start = Instant::now();
            (0..10_000).for_each(&mut call);
            start.elapsed().as_secs_f64() * 1e5
        })
        .fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), ScatteringError> {
    println!("relative error (rms around the fibre, at theta 20 and 65 degrees) against {OFFSETS} offsets;");
    println!("ns to prepare a hit, to evaluate it, to sample it");
    println!(
        "{:>7} {:>6} {:>9} {:>9} {:>8} {:>8} {:>8}",
        "beta_n", "nodes", "20", "65", "at", "evaluate", "sample"
    );
    for beta_n in [0.05, 0.1, 0.3, 0.6, 1.0] {
        let parameters = HairParameters { beta_n, sigma_a: Vec3::splat(0.2), ..HairParameters::default() };
        let absorption = Absorption::of_cortex(parameters.sigma_a)?;
        let near = HairBcsdf::new(&parameters)?;
        let mean = |theta: f32| {
            let mut sums = vec![0.0_f64; usize::from(AZIMUTHS)];
            for offset in 0..OFFSETS {
                let h = (f32::from(offset) + 0.5) / f32::from(OFFSETS) * 2.0 - 1.0;
                let scatter = near.at(direction(theta, 0.0), h);
                for (step, sum) in (0..AZIMUTHS).zip(&mut sums) {
                    let value = scatter.evaluate(direction(-theta, azimuth(step))).sum().x;
                    *sum += f64::from(value) / f64::from(OFFSETS);
                }
            }
            sums
        };
        let thetas = [20.0_f32, 65.0].map(f32::to_radians);
        let means = thetas.map(mean);
        for nodes in [1, 2, 4, 8, 16, 32, 64] {
            let far = FarFieldBcsdf::new(&parameters, nodes)?;
            let error = |(theta, mean): (f32, &Vec<f64>)| {
                let scatter = far.at(direction(theta, 0.0), absorption);
                let (mut difference, mut whole) = (0.0, 0.0);
                for (step, mean) in (0..AZIMUTHS).zip(mean) {
                    let found = f64::from(scatter.evaluate(direction(-theta, azimuth(step))).sum().x);
                    difference += (found - mean).powi(2);
                    whole += mean * mean;
                }
                (difference / whole).sqrt()
            };
            let errors = [error((thetas[0], &means[0])), error((thetas[1], &means[1]))];
            let wo = direction(thetas[0], 0.0);
            let scatter = far.at(wo, absorption);
            let at = nanoseconds(|_| drop(black_box(far.at(black_box(wo), absorption))));
            let evaluate = nanoseconds(|i| {
                black_box(scatter.evaluate_with_pdf(direction(-0.3, azimuth(i % AZIMUTHS))));
            });
            let sample = nanoseconds(|i| {
                let u = f32::from(i % 997) / 997.0;
                black_box(scatter.sample([u, 0.3, 0.7, (u * 7.0).fract()]));
            });
            println!(
                "{beta_n:>7} {nodes:>6} {:>9.4} {:>9.4} {at:>8.0} {evaluate:>8.0} {sample:>8.0}",
                errors[0], errors[1]
            );
        }
    }
    Ok(())
}
