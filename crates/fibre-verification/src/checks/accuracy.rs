//! Single precision against double, where light goes.

use fibre_scattering::Absorption;

use crate::random::Random;
use crate::scatterer::{Model, View, widened};

/// How far single precision is from double.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Accuracy {
    /// Worst relative error of f cos(theta_i), all lobes together, in any channel.
    pub value: f64,
    /// Worst relative error of the density.
    pub pdf: f64,
    /// Numbers that are not finite.
    pub not_finite: u64,
    /// Directions compared.
    pub directions: u64,
}

/// Values below this share of the density's scale are noise that nobody sees.
const NOTHING: f64 = 1e-12;

/// Compares `count` directions drawn by the model and as many from all around, at which only what is not
/// finite counts: far from every lobe a value is the exponential of a large number, and there is no light.
#[must_use]
pub fn accuracy(
    model: &dyn Model,
    view: View,
    absorption: Absorption,
    count: u64,
    seed: u64,
) -> Option<Accuracy> {
    let single = model.at(view, absorption);
    let double = model.double_at(view, absorption)?;
    let mut random = Random::new(seed, 0xacc);
    let mut worst = Accuracy::default();
    for _ in 0..count {
        let Some(sample) = single.sample(random.four()) else { continue };
        let (values, pdf) = single.evaluate_with_pdf(sample.wi);
        let (exact, exact_pdf) = double.evaluate_with_pdf(widened(sample.wi));
        worst.directions += 1;
        let total = values.sum().as_dvec3().to_array();
        for (channel, found) in total.into_iter().enumerate() {
            let exact: f64 = exact.iter().map(|lobe| lobe[channel]).sum();
            worst.not_finite += u64::from(!found.is_finite());
            if exact > NOTHING * exact_pdf {
                worst.value = worst.value.max((found - exact).abs() / exact);
            }
        }
        worst.not_finite += u64::from(!pdf.is_finite());
        worst.pdf = worst.pdf.max((f64::from(pdf) - exact_pdf).abs() / exact_pdf);
    }
    Some(worst)
}
