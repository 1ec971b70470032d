//! Value over density of samples: bounded, and on average the albedo.

use crate::checks::draws::Draws;
use crate::statistics::normal_p;

/// What samples weigh against what quadrature says the fibre scatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Mean weight per channel.
    pub mean: [f64; 3],
    /// Its standard error.
    pub standard_error: [f64; 3],
    /// The albedo by quadrature.
    pub albedo: [f64; 3],
    /// The largest weight in any channel.
    pub largest: f64,
    /// Largest difference of mean and albedo in any channel.
    pub difference: f64,
    /// Chance of so large a difference (in its standard errors, beyond `slack`) in the worst channel.
    pub p: f64,
}

/// Compares the weights of `draws` with `albedo`; differences up to `slack` are the quadrature's and rounding's.
#[must_use]
pub fn weights(draws: &Draws, albedo: [f64; 3], slack: f64) -> Weights {
    let mean = draws.weight.map(|moments| moments.mean);
    let standard_error = draws.weight.map(|moments| moments.standard_error());
    let (mut difference, mut p) = (0.0_f64, 1.0_f64);
    for channel in 0..3 {
        let off = (mean[channel] - albedo[channel]).abs();
        difference = if off.is_nan() { off } else { difference.max(off) };
        let beyond = (off - slack).max(0.0);
        let chance = if beyond == 0.0 { 1.0 } else { normal_p(beyond / standard_error[channel].max(1e-12)) };
        p = if chance.is_nan() || off.is_nan() { 0.0 } else { p.min(chance) };
    }
    Weights { mean, standard_error, albedo, largest: draws.largest_weight, difference, p }
}
