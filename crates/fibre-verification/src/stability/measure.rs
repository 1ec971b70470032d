//! The figures of one case.

use std::hint::black_box;
use std::time::Instant;

use fibre_scattering::Absorption;
use glam::Vec3;
use serde::Serialize;

use super::{Case, Effort};
use crate::checks::{Draws, accuracy, energy, goodness};
use crate::error::VerificationError;
use crate::landmarks::narrowest;
use crate::random::Random;
use crate::report::ENERGY_BOUND;
use crate::scatterer::{Model, Scatterer, View};
use crate::statistics::SIGNIFICANCE;
use crate::subject::Subject;

/// What was found of one case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StabilityRow {
    /// What is extreme about it.
    pub family: &'static str,
    /// The extreme value.
    pub name: String,
    /// From where it is seen.
    pub view: String,
    /// Worst relative error of single precision's value against double's where samples go; none without such a
    /// path.
    pub value_error: Option<f64>,
    /// The same of the density.
    pub pdf_error: Option<f64>,
    /// What they were held against.
    pub value_bound: f64,
    /// |1 - albedo| of the fibre without absorption, single precision.
    pub energy_error: f64,
    /// |1 - integral of the density|, single precision.
    pub density_error: f64,
    /// Chance of chi-square.
    pub p: f64,
    /// Chance of it with other random numbers, drawn where the first was below one in a thousand.
    pub p_again: Option<f64>,
    /// Numbers that are not finite, or negative, or samples that differ from their evaluation.
    pub not_numbers: u64,
    /// Nanoseconds to prepare and evaluate once.
    pub evaluate_ns: f64,
    /// Nanoseconds to prepare and draw once.
    pub sample_ns: f64,
    /// What failed; empty when the case passes.
    pub faults: Vec<String>,
}

/// Takes all figures of a case.
///
/// # Errors
/// [`VerificationError`] where the material is refused.
pub(super) fn measure(case: &Case, number: u64, effort: Effort) -> Result<StabilityRow, VerificationError> {
    let subject = Subject::new(&case.parameters, case.nodes)?;
    let (view, own) = (case.view, subject.absorption());
    let seed = effort.seed.wrapping_add(1000 * number);
    let white = energy(&subject, view, Absorption::default(), false);
    let colored = energy(&subject, view, own, false);
    let first = goodness(&subject, view, own, effort.samples, seed);
    // Once in a thousand a sound case looks bad; twice, once in a million.
    let again = (first.p < SIGNIFICANCE).then(|| goodness(&subject, view, own, effort.samples, seed + 1).p);
    let single = accuracy(&subject, view, own, effort.directions, seed);
    let scatterer = subject.at(view, own);
    let (evaluate_ns, sample_ns) = nanoseconds(&subject, view, own, effort);
    let broken = |draws: &Draws| draws.broken + draws.inconsistent;
    let worst_channel = |found: [f64; 3]| found.into_iter().map(|x| (1.0 - x).abs()).fold(0.0, f64::max);
    let not_finite = single.map_or(0, |single| single.not_finite);
    let mut row = StabilityRow {
        family: case.family,
        name: case.name.clone(),
        view: view.words(),
        value_error: single.map(|single| single.value),
        pdf_error: single.map(|single| single.pdf),
        value_bound: value_bound(&subject),
        energy_error: nan_as_infinite(worst_channel(white.single.total()), &white.single.total()),
        density_error: (1.0 - white.single.pdf).abs().max((1.0 - colored.single.pdf).abs()),
        p: first.p,
        p_again: again,
        not_numbers: not_finite + broken(&first.draws) + at_the_edges(&*scatterer),
        evaluate_ns,
        sample_ns,
        faults: Vec::new(),
    };
    row.faults = faults(&row);
    Ok(row)
}

/// `f64::max` passes over what is no number; here nothing may.
fn nan_as_infinite(worst: f64, found: &[f64]) -> f64 {
    if found.iter().any(|x| x.is_nan()) { f64::INFINITY } else { worst }
}

/// How far single precision may be off where light goes. A lobe of the width w changes by a part of its value in
/// a part of w: directions and angles, rounded to some 2^-24 of half a turn, move its flank by their ratio.
fn value_bound(subject: &Subject) -> f64 {
    1e-4 + 4e-7 / narrowest(subject.parameters())
}

fn faults(row: &StabilityRow) -> Vec<String> {
    let mut faults = Vec::new();
    let mut judge = |good: bool, what: &str| {
        if !good {
            faults.push(what.to_owned());
        }
    };
    let close = |error: Option<f64>| error.is_none_or(|error| error <= row.value_bound);
    judge(close(row.value_error), "value");
    judge(close(row.pdf_error), "density's value");
    judge(row.energy_error <= ENERGY_BOUND, "energy");
    judge(row.density_error <= ENERGY_BOUND, "density's integral");
    judge(row.p >= SIGNIFICANCE || row.p_again.is_some_and(|p| p >= SIGNIFICANCE), "chi-square");
    judge(row.not_numbers == 0, "not a number");
    faults
}

/// Directions at which formulas break: along the fibre, across it, the signs of zero; and random numbers at
/// both ends of their range. Counts answers that are no finite number of at least 0.
fn at_the_edges(scatterer: &dyn Scatterer) -> u64 {
    let tiny = f32::MIN_POSITIVE;
    let axes = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(1.0, tiny, 0.0), Vec3::new(1.0, 0.0, -tiny)];
    let others = [Vec3::new(0.0, -1.0, -0.0), Vec3::new(0.999_999_94, 3e-4, 0.0), Vec3::new(-0.0, 0.0, -1.0)];
    let odd = |values: fibre_scattering::LobeValues, pdf: f32| {
        let sound = |x: f32| x.is_finite() && x >= 0.0;
        u64::from(!(sound(pdf) && values.0.iter().all(|v| v.to_array().into_iter().all(sound))))
    };
    let mut count = 0;
    for wi in axes.into_iter().chain(others).flat_map(|wi| [wi, -wi]) {
        let (values, pdf) = scatterer.evaluate_with_pdf(wi);
        count += odd(values, pdf);
    }
    let ends = [0.0, 0.5, 1.0 - f32::EPSILON / 2.0];
    for code in 0..81_usize {
        let u = [code % 3, code / 3 % 3, code / 9 % 3, code / 27].map(|digit| ends[digit]);
        if let Some(sample) = scatterer.sample(u) {
            count += odd(sample.values, sample.pdf) + u64::from(!sample.weight().is_finite());
        }
    }
    count
}

/// The smallest time of some rounds, for one evaluation and one draw, each with the fibre prepared anew as a
/// path tracer does.
fn nanoseconds(subject: &Subject, view: View, absorption: Absorption, effort: Effort) -> (f64, f64) {
    let mut random = Random::new(7, 7);
    let numbers: Vec<[f32; 4]> = (0..effort.calls).map(|_| random.four()).collect();
    let (wo, h) = (view.wo(), view.h as f32);
    let directions: Vec<Vec3> = {
        let scatter = subject.bcsdf().at(wo, h, absorption);
        numbers.iter().map(|&u| scatter.sample(u).map_or(Vec3::Y, |sample| sample.wi)).collect()
    };
    let least = |round: &dyn Fn()| {
        let rounds = (0..effort.rounds).map(|_| {
            let start = Instant::now();
            round();
            start.elapsed().as_secs_f64()
        });
        rounds.fold(f64::INFINITY, f64::min) / f64::from(effort.calls) * 1e9
    };
    let evaluate = least(&|| {
        for &wi in &directions {
            let scatter = subject.bcsdf().at(black_box(wo), black_box(h), absorption);
            black_box(scatter.evaluate_with_pdf(black_box(wi)));
        }
    });
    let sample = least(&|| {
        for &u in &numbers {
            let scatter = subject.bcsdf().at(black_box(wo), black_box(h), absorption);
            black_box(scatter.sample(black_box(u)));
        }
    });
    (evaluate, sample)
}
