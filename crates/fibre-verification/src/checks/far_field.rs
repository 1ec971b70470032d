//! The far field against what it stands for: the near field averaged over the offset.

use std::f64::consts::PI;
use std::time::Instant;

use fibre_scattering::{Absorption, FarFieldBcsdf, FurParameters};
use serde::Serialize;

use crate::checks::reciprocity::over_offsets;
use crate::error::VerificationError;
use crate::scatterer::{Model, View, direction, narrow};
use crate::subject::Subject;

/// A far field of so many nodes: how wrong, and how slow.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FarField {
    /// Nodes over the offset.
    pub nodes: u32,
    /// Mean of |far - near| over the mean of near, over directions about the mirror cone.
    pub error: f64,
    /// Nanoseconds to prepare for one outgoing direction and evaluate one incoming.
    pub nanoseconds: f64,
}

/// Node counts that are compared.
const NODES: [u32; 6] = [1, 4, 8, 16, 32, 64];
const INCLINATIONS: [f64; 2] = [0.0, 50.0];
const AZIMUTHS: u32 = 72;

/// The far field of a hair by nodes; nothing for a material that has none.
///
/// # Errors
/// [`VerificationError`] where the material is refused.
pub fn far_field(parameters: &FurParameters) -> Result<Vec<FarField>, VerificationError> {
    if parameters.medulla.scatters() {
        return Ok(Vec::new());
    }
    let near = Subject::new(parameters, None)?;
    let absorption = near.absorption();
    let mut exact = Vec::new();
    for degrees in INCLINATIONS {
        let theta_o = degrees.to_radians();
        for step in 0..AZIMUTHS {
            let phi = 2.0 * PI * (f64::from(step) + 0.5) / f64::from(AZIMUTHS) - PI;
            let wi = direction(-theta_o, phi);
            exact.push((theta_o, wi, averaged(&near, theta_o, absorption, wi)));
        }
    }
    NODES.into_iter().map(|nodes| of_nodes(parameters, nodes, absorption, &exact)).collect()
}

fn averaged(near: &Subject, theta_o: f64, absorption: Absorption, wi: [f64; 3]) -> f64 {
    over_offsets(near, theta_o, |view| match near.double_at(view, absorption) {
        Some(double) => double.evaluate_with_pdf(wi).0.as_flattened().iter().sum::<f64>() / 3.0,
        None => {
            f64::from(near.at(view, absorption).evaluate_with_pdf(narrow(wi)).0.sum().element_sum()) / 3.0
        }
    })
}

fn of_nodes(
    parameters: &FurParameters,
    nodes: u32,
    absorption: Absorption,
    exact: &[(f64, [f64; 3], f64)],
) -> Result<FarField, VerificationError> {
    let far = FarFieldBcsdf::new(&parameters.hair, nodes)?;
    let evaluate = |theta_o: f64, wi: [f64; 3]| {
        let wo = View { theta_o, phi_o: 0.0, h: 0.0 }.wo();
        let values = far.at(wo, absorption).evaluate_with_pdf(narrow(wi)).0;
        f64::from(values.sum().element_sum()) / 3.0
    };
    let off: f64 = exact.iter().map(|&(theta_o, wi, near)| (evaluate(theta_o, wi) - near).abs()).sum();
    let mean: f64 = exact.iter().map(|&(_, _, near)| near).sum();
    let seconds = (0..5).map(|_| {
        let start = Instant::now();
        for &(theta_o, wi, _) in exact {
            std::hint::black_box(evaluate(theta_o, std::hint::black_box(wi)));
        }
        start.elapsed().as_secs_f64()
    });
    let nanoseconds = seconds.fold(f64::INFINITY, f64::min) / exact.len() as f64 * 1e9;
    Ok(FarField { nodes, error: if mean > 0.0 { off / mean } else { 0.0 }, nanoseconds })
}
