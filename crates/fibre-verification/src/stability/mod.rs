//! The table of extreme cases: error, energy, chi-square, run time.
//!
//! Each case is judged at one in a thousand, as a table of one case would be; with so many cases one or the
//! other falls below that by accident, so that a case fails only when other random numbers say it again: once
//! in a million for a sound one. All chances together must be even (Kolmogorov and Smirnov), which finds a
//! small fault that many cases share. Seeds are fixed: the same program gives the same table.

mod cases;
mod measure;

use std::collections::BTreeMap;

use error_report::{Point, Series};
use serde::Serialize;

pub use cases::{Case, cases};
pub use measure::StabilityRow;

use crate::error::VerificationError;
use crate::statistics::{SIGNIFICANCE, uniform_p};
use crate::verdict::{Check, Verdict, worst};

/// How much work a case is worth.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Samples of each chi-square test.
    pub samples: u64,
    /// Directions at which single precision is held against double.
    pub directions: u64,
    /// Calls that are timed in a round.
    pub calls: u32,
    /// Rounds, of which the fastest counts.
    pub rounds: u32,
    /// Seed of everything random.
    pub seed: u64,
}

impl Effort {
    /// A million samples a case.
    pub const FULL: Effort = Effort { samples: 1_000_000, directions: 8192, calls: 4096, rounds: 5, seed: 1 };
    /// What a test on every change can afford.
    pub const QUICK: Effort = Effort { samples: 20_000, directions: 512, calls: 512, rounds: 2, seed: 1 };
}

/// The whole table.
#[derive(Debug, Clone, Serialize)]
pub struct Stability {
    /// `"fibre-stability/1"`.
    pub schema: &'static str,
    /// What explains the numbers: samples, seed, command.
    pub about: BTreeMap<String, String>,
    /// The worst of each figure, judged.
    pub checks: Vec<Check>,
    /// A row a case.
    pub rows: Vec<StabilityRow>,
}

impl Stability {
    /// Measures cases, one after the other; `step` is called after each.
    ///
    /// # Errors
    /// [`VerificationError`] where a case is refused.
    pub fn new(cases: &[Case], effort: Effort, step: &dyn Fn()) -> Result<Stability, VerificationError> {
        let mut rows = Vec::new();
        for (number, case) in cases.iter().enumerate() {
            rows.push(measure::measure(case, number as u64, effort)?);
            step();
        }
        let mut about = BTreeMap::new();
        about.insert("samples a case".to_owned(), effort.samples.to_string());
        about.insert("seed".to_owned(), effort.seed.to_string());
        Ok(Stability { schema: "fibre-stability/1", about, checks: checks(&rows), rows })
    }

    /// Whether every case passes, and all together.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.checks.iter().all(|check| check.verdict != Verdict::Fail)
    }

    /// As JSON, ending in a newline. Numbers that are not finite become null.
    ///
    /// # Errors
    /// [`VerificationError::Json`].
    pub fn to_json(&self) -> Result<String, VerificationError> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// As one self-contained HTML page.
    #[must_use]
    pub fn to_html(&self) -> String {
        crate::page::stability_html(self)
    }

    /// Error against run time, in the format all of this project's tools share. The error is that of single
    /// precision's value where there is a double to hold it against, and of energy elsewhere.
    #[must_use]
    pub fn to_error_report(&self) -> error_report::Report {
        let mut report = error_report::Report::new("Fibre scattering on extreme cases");
        report.about.clone_from(&self.about);
        for family in self.families() {
            for (metric, reference, with_double) in [
                ("relative error of value", "the same formulas in f64", true),
                ("energy error", "a white fibre returns all light", false),
            ] {
                let rows = self.rows.iter().filter(|row| row.family == family);
                let points: Vec<Point> =
                    rows.filter(|row| row.value_error.is_some() == with_double).map(point).collect();
                if !points.is_empty() {
                    report = report
                        .with_series(Series { points, ..Series::cases(family, metric, reference, 0.0) });
                }
            }
        }
        report
    }

    pub(crate) fn families(&self) -> Vec<&'static str> {
        let mut families: Vec<&'static str> = Vec::new();
        for row in &self.rows {
            if !families.contains(&row.family) {
                families.push(row.family);
            }
        }
        families
    }
}

/// A row as a point; infinite errors are written as the largest number there is.
fn point(row: &StabilityRow) -> Point {
    let finite = |x: f64| if x.is_finite() { x } else { f64::MAX };
    let label = format!("{}, {}", row.name, row.view);
    Point::new(label, row.evaluate_ns * 1e-9, finite(row.value_error.unwrap_or(row.energy_error)))
        .with("energy error", finite(row.energy_error))
        .with("density error", finite(row.density_error))
        .with("chi-square p", finite(row.p))
        .with("not numbers", row.not_numbers as f64)
        .with("sample seconds", row.sample_ns * 1e-9)
        .with("faults", row.faults.len() as f64)
}

fn checks(rows: &[StabilityRow]) -> Vec<Check> {
    let words = |row: &StabilityRow| format!("{}, {}", row.name, row.view);
    let most = |name: &str, measure: &str, figure: &dyn Fn(&StabilityRow) -> f64, fault: &str| {
        let (found, at) = worst(rows.iter().map(|row| (figure(row), words(row))));
        let failed = rows.iter().filter(|row| row.faults.iter().any(|f| f == fault)).count();
        let verdict = if failed == 0 { Verdict::Pass } else { Verdict::Fail };
        Check { verdict, ..Check::told(name, measure, found) }.found_at(at)
    };
    let count = rows.len();
    let low = rows.iter().filter(|row| row.p < SIGNIFICANCE).count();
    let chances: Vec<f64> = rows.iter().map(|row| row.p).collect();
    let follow = most("Samples follow the density", "least chi-square p", &|row| 1.0 - row.p, "chi-square");
    // The least chance, and not the largest of what it lacks to 1.
    let samples = Check { figure: 1.0 - follow.figure, ..follow };
    vec![
        most("Single precision against double: value", "relative error", &|r| r.value_error.unwrap_or(0.0), "value")
            .because("where samples go; the bound of a case is 1e-4 plus 4e-7 over its narrowest lobe's width"),
        most("Single precision against double: density", "relative error", &|r| r.pdf_error.unwrap_or(0.0), "density's value"),
        most("Without absorption all light returns", "|1 - albedo|", &|r| r.energy_error, "energy")
            .because("bound 1e-4"),
        most("Density integrates to 1", "|1 - integral|", &|r| r.density_error, "density's integral")
            .because("bound as above"),
        Check { above: true, ..samples }
            .because(format!(
            "{low} of {count} cases below one in a thousand, {:.2} expected by accident; such a case is drawn again and fails when it is below it again",
            count as f64 * SIGNIFICANCE
        )),
        Check::at_least("All chances together are even", "Kolmogorov-Smirnov p", uniform_p(&chances), SIGNIFICANCE)
            .because("finds a small fault that many cases share"),
        most("Every number is a number", "odd numbers", &|r| r.not_numbers as f64, "not a number")
            .because("not finite, negative, or a sample that differs from its evaluation; also at both poles and both ends of the random numbers"),
    ]
}
