//! The five-lobe fur model as printed, as released and corrected, beside the whole fibre.

use fibre_scattering::{Absorption, FurParameters, YanBcsdf, YanForm, YanPath};
use glam::Vec3;
use serde::Serialize;

use crate::checks::reciprocity::over_offsets;
use crate::error::VerificationError;
use crate::scatterer::{Model, View, widened};

/// Albedo of one model, averaged over the offset.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FiveLobe {
    /// Which.
    pub model: String,
    /// Inclination of the outgoing direction, in degrees.
    pub theta_o: f64,
    /// Without absorption.
    pub white: f64,
    /// With the material's.
    pub albedo: [f64; 3],
}

const INCLINATIONS: [f64; 2] = [0.0, 45.0];
/// Walks for each of the medulla's distributions.
const WALKS: u32 = 500;

const FORMS: [(&str, YanForm, YanPath); 3] = [
    ("five lobes, as printed", YanForm::Printed, YanPath::Radius),
    ("five lobes, as released", YanForm::Released, YanPath::Mean),
    ("five lobes, corrected", YanForm::Corrected, YanPath::Mean),
];

/// Every model at two inclinations; nothing for hair.
///
/// # Errors
/// [`VerificationError`] where the material is refused.
pub fn five_lobe(model: &dyn Model) -> Result<Vec<FiveLobe>, VerificationError> {
    let parameters = *model.parameters();
    if !parameters.medulla.scatters() {
        return Ok(Vec::new());
    }
    let mut rows: Vec<FiveLobe> = INCLINATIONS.into_iter().map(|theta| whole(model, theta)).collect();
    let mut clear: FurParameters = parameters;
    (clear.hair.sigma_a, clear.medulla.sigma_a) = (Vec3::ZERO, Vec3::ZERO);
    for (name, form, path) in FORMS {
        let colored = YanBcsdf::new(&parameters, form, path, WALKS)?;
        let white = YanBcsdf::new(&clear, form, path, WALKS)?;
        let mean = |bcsdf: &YanBcsdf, theta: f64, channel: usize| {
            over_offsets(model, theta.to_radians(), |view| {
                bcsdf.at(widened(view.wo()), view.h).albedo().iter().map(|lobe| lobe[channel]).sum()
            })
        };
        rows.extend(INCLINATIONS.map(|theta_o| FiveLobe {
            model: name.to_owned(),
            theta_o,
            white: mean(&white, theta_o, 0),
            albedo: [0, 1, 2].map(|channel| mean(&colored, theta_o, channel)),
        }));
    }
    Ok(rows)
}

/// What the whole fibre says it scatters.
fn whole(model: &dyn Model, theta_o: f64) -> FiveLobe {
    let mean = |absorption: Absorption, channel: usize| {
        over_offsets(model, theta_o.to_radians(), |view: View| {
            let lobes = model.at(view, absorption).albedo();
            lobes.iter().map(|lobe| f64::from(lobe.to_array()[channel])).sum()
        })
    };
    FiveLobe {
        model: "whole fibre".to_owned(),
        theta_o,
        white: mean(Absorption::default(), 0),
        albedo: [0, 1, 2].map(|channel| mean(model.absorption(), channel)),
    }
}
