//! Do samples follow the density? Pearson's chi-square test.

use fibre_scattering::Absorption;

use crate::checks::draws::{Draws, draw};
use crate::scatterer::{Model, View, narrow};
use crate::sphere::Sphere;
use crate::statistics::chi_square_p;

/// Fewest samples a cell must be expected to hold; cells with fewer are pooled.
const POOLED_BELOW: f64 = 10.0;

/// What the test found.
#[derive(Debug, Clone, PartialEq)]
pub struct Goodness {
    /// From where.
    pub view: View,
    /// Pearson's sum over the cells.
    pub chi_square: f64,
    /// Cells that were compared, less one.
    pub degrees: f64,
    /// Chance of so large a sum by accident: the least of the cells', of that of their sums along the fibre and of
    /// that of their sums around it, made right for being the least of three.
    pub p: f64,
    /// The draws themselves.
    pub draws: Draws,
}

/// Draws `count` directions and compares where they went with the integral of the density over each cell: of
/// the double precision path where there is one, because that has no noise.
#[must_use]
pub fn goodness(model: &dyn Model, view: View, absorption: Absorption, count: u64, seed: u64) -> Goodness {
    let scatterer = model.at(view, absorption);
    let sphere = Sphere::new(&model.landmarks(view)).for_counting();
    let masses = match model.double_at(view, absorption) {
        Some(double) => sphere.masses(|wi| double.evaluate_with_pdf(wi).1),
        None => sphere.masses(|wi| f64::from(scatterer.evaluate_with_pdf(narrow(wi)).1)),
    };
    let draws = draw(&*scatterer, &sphere, count, seed);
    let expected: Vec<f64> = masses.iter().map(|mass| mass * draws.given as f64).collect();
    let found: Vec<f64> = draws.cells.iter().map(|&count| count as f64).collect();
    let (chi_square, degrees) = pearson(&expected, &found);
    let mut p = chance(chi_square, degrees);
    // Thousands of cells find what is wrong in one place, and hide what is a little wrong all over: that shows in
    // the sums along and around the fibre. The least of three chances is rarer than it looks (Sidak).
    for sums in [Sphere::rows, Sphere::columns] {
        let (chi_square, degrees) = pearson(&sums(&sphere, &expected), &sums(&sphere, &found));
        p = p.min(chance(chi_square, degrees));
    }
    Goodness { view, chi_square, degrees, p: 1.0 - (1.0 - p).powi(3), draws }
}

fn chance(chi_square: f64, degrees: f64) -> f64 {
    // A fibre that swallows everything draws nothing, and that is as it should be.
    if degrees > 0.0 { chi_square_p(chi_square, degrees) } else { 1.0 }
}

/// Pearson's sum and its degrees of freedom. Cells that expect little are joined, smallest first, until they
/// expect enough; what is left over joins the last.
fn pearson(expected: &[f64], found: &[f64]) -> (f64, f64) {
    let mut cells: Vec<(f64, f64)> = expected.iter().copied().zip(found.iter().copied()).collect();
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pooled: Vec<(f64, f64)> = Vec::new();
    let mut open = (0.0, 0.0);
    for (expected, found) in cells {
        open = (open.0 + expected, open.1 + found);
        if open.0 >= POOLED_BELOW {
            pooled.push(open);
            open = (0.0, 0.0);
        }
    }
    match pooled.last_mut() {
        Some(last) => *last = (last.0 + open.0, last.1 + open.1),
        None => pooled.push(open),
    }
    let sum = pooled.iter().map(|&(expected, found)| (found - expected).powi(2) / expected.max(1.0)).sum();
    (sum, pooled.len() as f64 - 1.0)
}
