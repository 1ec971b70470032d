//! Nanoseconds and errors of the scattering models, as figures, beside the plain scalar formula of the papers.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p fibre-scattering --bench scattering` for the machine at
//! hand; a word behind `--` keeps what has it in its name.
#![allow(clippy::print_stdout)] // figures are what this program is for

mod errors;
mod inputs;
mod paper;

use std::hint::black_box;
use std::time::Duration;

use criterion::Criterion;
use fibre_scattering::{HairBcsdf, HairParameters, ScatteringError};
use glam::Vec3;
use inputs::Inputs;
use paper::PaperHair;

fn main() -> Result<(), ScatteringError> {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000))
        .without_plots()
        .configure_from_args();
    for (name, parameters) in materials() {
        hair(&mut criterion, name, &parameters)?;
        papers(&mut criterion, name, &parameters);
    }
    criterion.final_summary();
    errors::print()
}

fn materials() -> [(&'static str, HairParameters); 3] {
    let of =
        |beta, sigma_a| HairParameters { beta_m: beta, beta_n: beta, sigma_a, ..HairParameters::default() };
    let brown = Vec3::new(0.1, 0.4, 1.2);
    [("white", of(0.3, Vec3::ZERO)), ("coloured", of(0.3, brown)), ("smooth", of(0.03, brown))]
}

fn hair(criterion: &mut Criterion, name: &str, parameters: &HairParameters) -> Result<(), ScatteringError> {
    let bcsdf = HairBcsdf::new(parameters)?;
    let mut inputs = Inputs::new();
    let hits = inputs.hits(|wo, h| bcsdf.at(wo, h));
    let mut bench = |operation: &str, call: &mut dyn FnMut(&mut Inputs)| {
        criterion
            .benchmark_group(operation)
            .bench_function(name, |bencher| bencher.iter(|| call(&mut inputs)));
    };
    bench("at", &mut |inputs| {
        let (wo, h, ..) = inputs.next();
        black_box(bcsdf.at(black_box(wo), black_box(h)));
    });
    bench("evaluate_with_pdf", &mut |inputs| {
        let (wi, _, _, hit) = inputs.next();
        black_box(hits[hit].evaluate_with_pdf(black_box(wi)));
    });
    bench("pdf", &mut |inputs| {
        let (wi, _, _, hit) = inputs.next();
        black_box(hits[hit].pdf(black_box(wi)));
    });
    bench("sample", &mut |inputs| {
        let (_, _, u, hit) = inputs.next();
        black_box(hits[hit].sample(black_box(u)));
    });
    Ok(())
}

fn papers(criterion: &mut Criterion, name: &str, parameters: &HairParameters) {
    let paper = PaperHair::new(parameters);
    let mut inputs = Inputs::new();
    let hits = inputs.hits(|wo, h| paper.at(wo, h));
    let name = format!("{name}, the papers' formula");
    let mut bench = |operation: &str, call: &mut dyn FnMut(&mut Inputs)| {
        criterion
            .benchmark_group(operation)
            .bench_function(&name, |bencher| bencher.iter(|| call(&mut inputs)));
    };
    bench("at", &mut |inputs| {
        let (wo, h, ..) = inputs.next();
        black_box(paper.at(black_box(wo), black_box(h)));
    });
    bench("evaluate_with_pdf", &mut |inputs| {
        let (wi, _, _, hit) = inputs.next();
        black_box(hits[hit].evaluate_with_pdf(black_box(wi)));
    });
    bench("pdf", &mut |inputs| {
        let (wi, _, _, hit) = inputs.next();
        black_box(hits[hit].pdf(black_box(wi)));
    });
    bench("sample", &mut |inputs| {
        let (_, _, u, hit) = inputs.next();
        black_box(hits[hit].sample(black_box(u)));
    });
}
