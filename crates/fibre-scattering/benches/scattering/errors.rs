//! How far single precision is from double, and the papers' formula from both, over cases that try them.

use fibre_scattering::{HairBcsdf, HairParameters, ReferenceBcsdf};
use glam::Vec3;

use crate::inputs::spread;
use crate::paper::PaperHair;

/// The error that matters is where light goes: directions are drawn by the model itself.
pub fn print() -> Result<(), fibre_scattering::ScatteringError> {
    println!("\nagainst f64 at sampled directions (relative error of f cos)");
    println!("                              this crate             the papers' formula");
    println!("  beta     eta  theta_o       mean      worst         mean      worst");
    for beta in [0.001, 0.01, 0.1, 0.3, 1.0] {
        for (eta, theta_o) in [(1.55, 10.0_f64), (1.55, 89.99), (1.0001, 10.0), (3.0, -80.0)] {
            let parameters = HairParameters {
                beta_m: beta,
                beta_n: beta,
                eta,
                sigma_a: Vec3::new(0.1, 0.4, 1.2),
                ..HairParameters::default()
            };
            let [ours, papers] = of(&parameters, theta_o)?;
            let [mean, worst] = [ours.sum / ours.count, ours.worst];
            let [paper_mean, paper_worst] = [papers.sum / papers.count, papers.worst];
            println!(
                "{beta:>6} {eta:>7} {theta_o:>8} {mean:>10.1e} {worst:>10.1e}   {paper_mean:>10.1e} {paper_worst:>10.1e}"
            );
        }
    }
    Ok(())
}

#[derive(Clone, Copy, Default)]
struct Errors {
    sum: f64,
    count: f64,
    worst: f64,
}

impl Errors {
    fn add(&mut self, found: f32, exact: f64) {
        let error = (f64::from(found) / exact - 1.0).abs();
        // NaN is as wrong as can be.
        let error = if error.is_nan() { f64::INFINITY } else { error };
        self.sum += error;
        self.count += 1.0;
        self.worst = self.worst.max(error);
    }
}

fn of(parameters: &HairParameters, theta_o: f64) -> Result<[Errors; 2], fibre_scattering::ScatteringError> {
    let (single, double) = (HairBcsdf::new(parameters)?, ReferenceBcsdf::new(parameters)?);
    let paper = PaperHair::new(parameters);
    let (sin, cos) = theta_o.to_radians().sin_cos();
    let wo = Vec3::new(sin as f32, cos as f32, 0.0);
    let mut errors = [Errors::default(); 2];
    for index in 0..20_000 {
        let (_, h, u) = spread(index);
        let Some(sample) = single.at(wo, h).sample(u) else {
            continue;
        };
        let wi = sample.wi.as_dvec3().to_array();
        let (exact, _) = double.at(wo.as_dvec3().to_array(), f64::from(h)).evaluate_with_pdf(wi);
        let exact: f64 = exact.iter().map(|lobe| lobe[0]).sum();
        errors[0].add(sample.values.sum().x, exact);
        let (values, _) = paper.at(wo, h).evaluate_with_pdf(sample.wi);
        errors[1].add(values.iter().map(|value| value.x).sum(), exact);
    }
    Ok(errors)
}
