//! Nanoseconds and errors of the scattering models, as figures, beside the plain scalar formula of the papers.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p fibre-scattering --bench scattering` for the machine at
//! hand; a word behind `--` keeps what has it in its name.
#![allow(clippy::print_stdout)] // figures are what this program is for

mod errors;
mod inputs;
mod measure;
mod paper;

use std::sync::Arc;

use fibre_scattering::{
    Absorption, FurBcsdf, FurParameters, HairBcsdf, HairParameters, Medulla, MedullaKey, MedullaTable,
    ScatteringError,
};
use glam::Vec3;
use measure::{Measures, Operations};
use paper::{PaperHair, PaperHit};

const BROWN: Vec3 = Vec3::new(0.1, 0.4, 1.2);

fn main() -> Result<(), ScatteringError> {
    let mut measures = Measures::new();
    let of =
        |beta, sigma_a| HairParameters { beta_m: beta, beta_n: beta, sigma_a, ..HairParameters::default() };
    let materials =
        [("white", of(0.3, Vec3::ZERO)), ("coloured", of(0.3, BROWN)), ("smooth", of(0.03, BROWN))];
    for (name, parameters) in materials {
        let hair = HairBcsdf::new(&parameters)?;
        measures.take(
            &format!("{name} hair"),
            Operations {
                at: |wo, h| hair.at(wo, h),
                evaluate: fibre_scattering::HairScatter::evaluate_with_pdf,
                pdf: fibre_scattering::HairScatter::pdf,
                sample: fibre_scattering::HairScatter::sample,
            },
        );
        let paper = PaperHair::new(&parameters);
        measures.take(
            &format!("{name} hair, the papers' formula"),
            Operations {
                at: |wo, h| paper.at(wo, h),
                evaluate: PaperHit::evaluate_with_pdf,
                pdf: PaperHit::pdf,
                sample: PaperHit::sample,
            },
        );
        let parameters = FurParameters { hair: parameters, medulla: medulla(&parameters) };
        fur(&mut measures, name, &parameters)?;
    }
    measures.summary();
    errors::print()
}

/// The first of the two published sets, as black as its hair is brown.
fn medulla(hair: &HairParameters) -> Medulla {
    Medulla { kappa: 0.86, sigma_s: 3.15, sigma_a: 0.5 * hair.sigma_a, g: 0.79 }
}

fn fur(measures: &mut Measures, name: &str, parameters: &FurParameters) -> Result<(), ScatteringError> {
    let key = MedullaKey::needed(parameters).map(|key| MedullaKey { walks: 500, ..key });
    let table = key.map(|key| MedullaTable::build(&key)).transpose()?.map(Arc::new);
    let fur = FurBcsdf::new(parameters, table)?;
    let own = Absorption::new(parameters.hair.sigma_a, parameters.medulla.sigma_a)?;
    measures.take(
        &format!("{name} fur"),
        Operations {
            at: |wo, h| fur.at(wo, h, own),
            evaluate: fibre_scattering::FurScatter::evaluate_with_pdf,
            pdf: fibre_scattering::FurScatter::pdf,
            sample: fibre_scattering::FurScatter::sample,
        },
    );
    let strand = Absorption::new(0.9 * BROWN, 0.4 * BROWN)?;
    measures.at(&format!("{name} fur, colour of the strand"), |wo, h| fur.at(wo, h, strand));
    Ok(())
}
