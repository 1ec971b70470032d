//! Our answers beside another renderer's, and what explains the difference.

mod published;

use serde::Serialize;

pub use published::{Published, Slips, published};

use crate::error::VerificationError;
use crate::eval::{Answers, Reference, Row};

/// Worst and mean relative difference over the rows of a set.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Difference {
    /// The largest of any row and channel.
    pub worst: f64,
    /// Their mean.
    pub mean: f64,
}

/// One thing the other renderer does otherwise, and what is left when it is done, too.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explained {
    /// In words.
    pub what: String,
    /// What is left of the difference to its values with this and all before it.
    pub left: Difference,
}

/// The comparison of one set of parameters.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Its name.
    pub set: String,
    /// Rows compared.
    pub rows: u64,
    /// Double precision against the exact evaluation: must be rounding.
    pub exact_double: Difference,
    /// Single precision against it.
    pub exact_single: Difference,
    /// What is left of the difference to the renderer's values, step by step; the first has nothing explained.
    pub values: Vec<Explained>,
    /// The same of its density.
    pub densities: Vec<Explained>,
    /// What would be seen if the tilt's sign were not turned: how much that matters.
    pub tilt_unturned: Difference,
}

/// Values below this are noise of the seven digits they are written with.
const NOTHING: f64 = 1e-12;

/// How far double precision may be from the exact columns: their seven digits, and parameters that are
/// rounded to `f32`, which moves the flank of a narrow lobe.
pub const ROUNDING: f64 = 2e-5;
/// How far single precision may be.
pub const SINGLE_ROUNDING: f64 = 1e-4;
/// How much of the difference to Mitsuba may be left when its slips are made: it works in `f32`.
pub const UNEXPLAINED: f64 = 2e-4;

#[derive(Default)]
struct Sum {
    worst: f64,
    sum: f64,
    count: f64,
}

impl Sum {
    fn push(&mut self, found: f64, expected: f64) {
        if expected >= NOTHING {
            let off = (found - expected).abs() / expected;
            self.worst = if off.is_nan() { off } else { self.worst.max(off) };
            self.sum += off;
            self.count += 1.0;
        }
    }

    fn push_all(&mut self, found: [f64; 3], expected: [f64; 3]) {
        for (found, expected) in found.into_iter().zip(expected) {
            self.push(found, expected);
        }
    }

    fn difference(&self) -> Difference {
        Difference { worst: self.worst, mean: if self.count > 0.0 { self.sum / self.count } else { 0.0 } }
    }
}

/// Mitsuba 3's slips, one after the other.
fn steps() -> [(&'static str, Slips); 5] {
    let luminance = Slips { by_luminance: true, ..Slips::default() };
    let series = Slips { terms: 11, ..luminance };
    let halved = Slips { halved: true, ..series };
    [
        ("nothing", Slips::default()),
        ("lobes are chosen by luminance", luminance),
        ("I0 ends after 11 terms of its series", series),
        ("log I0 beyond 12 halves its term 1/(8x)", halved),
        ("ln 2 is 0.6931", Slips { rounded_ln_2: true, ..halved }),
    ]
}

impl Comparison {
    /// Whether every difference is rounding or explained.
    #[must_use]
    pub fn passes(&self) -> bool {
        let last = |list: &[Explained]| list.last().map_or(f64::NAN, |step| step.left.worst);
        self.exact_double.worst <= ROUNDING
            && self.exact_single.worst <= SINGLE_ROUNDING
            && last(&self.values) <= UNEXPLAINED
            && last(&self.densities) <= UNEXPLAINED
    }
}

/// Compares rows that carry Mitsuba 3's answers, set by set. Rows must have been read with
/// [`Tilt::ToTip`](crate::Tilt::ToTip).
///
/// # Errors
/// [`VerificationError::Heading`] where the columns of the answers are missing.
pub fn compare_with_mitsuba(rows: &[Row]) -> Result<Vec<Comparison>, VerificationError> {
    let mut sets: Vec<&str> = Vec::new();
    for row in rows {
        if !sets.contains(&row.set.as_str()) {
            sets.push(&row.set);
        }
    }
    sets.into_iter().map(|set| compare_set(set, rows.iter().filter(|row| row.set == set))).collect()
}

/// The comparison as JSON, ending in a newline.
///
/// # Errors
/// [`VerificationError::Json`].
pub fn comparison_json(sets: &[Comparison]) -> Result<String, VerificationError> {
    Ok(serde_json::to_string_pretty(sets)? + "\n")
}

fn compare_set<'a>(set: &str, rows: impl Iterator<Item = &'a Row>) -> Result<Comparison, VerificationError> {
    let steps = steps();
    let (mut double, mut single, mut unturned) = (Sum::default(), Sum::default(), Sum::default());
    let mut values: [Sum; 5] = Default::default();
    let mut densities: [Sum; 5] = Default::default();
    let (mut count, mut answers) = (0, Answers::default());
    for row in rows {
        let Some(reference) = row.reference else {
            let fault =
                "the answers f_r, f_g, f_b, pdf, exact_r, exact_g, exact_b must all be there".to_owned();
            return Err(VerificationError::Heading { column: "f_r".to_owned(), fault });
        };
        count += 1;
        let answer = answers.of(row)?;
        single.push_all(answer.single.total(), reference.exact);
        if let Some(answer) = answer.double {
            double.push_all(answer.total(), reference.exact);
            // Ours as it is, before anything is explained.
            values[0].push_all(answer.total(), reference.value);
            densities[0].push(answer.pdf, reference.pdf);
        }
        explain(row, &reference, &steps, &mut values, &mut densities);
        let fibre = fibre(row);
        let turned = published(&Published { alpha: -fibre.alpha, ..fibre }, Slips::default());
        unturned.push_all(turned.0, reference.exact);
    }
    let told = |sums: &[Sum]| {
        let pairs = steps.iter().zip(sums);
        pairs.map(|((what, _), sum)| Explained { what: (*what).to_owned(), left: sum.difference() }).collect()
    };
    Ok(Comparison {
        set: set.to_owned(),
        rows: count,
        exact_double: double.difference(),
        exact_single: single.difference(),
        values: told(&values),
        densities: told(&densities),
        tilt_unturned: unturned.difference(),
    })
}

fn explain(
    row: &Row,
    reference: &Reference,
    steps: &[(&str, Slips)],
    values: &mut [Sum],
    densities: &mut [Sum],
) {
    let fibre = fibre(row);
    for ((_, slips), (value, density)) in
        steps.iter().zip(values.iter_mut().zip(densities.iter_mut())).skip(1)
    {
        let (found, pdf) = published(&fibre, *slips);
        value.push_all(found, reference.value);
        density.push(pdf, reference.pdf);
    }
}

fn fibre(row: &Row) -> Published {
    let hair = &row.parameters.hair;
    Published {
        beta_m: f64::from(hair.beta_m),
        beta_n: f64::from(hair.beta_n),
        alpha: -f64::from(hair.alpha),
        eta: f64::from(hair.eta),
        sigma_a: hair.sigma_a.as_dvec3().to_array(),
        theta_o: row.outgoing.0,
        h: row.h,
        theta_i: row.incoming.0,
        phi: row.incoming.1,
    }
}
