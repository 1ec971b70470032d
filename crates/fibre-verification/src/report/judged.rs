//! From figures to verdicts.

use super::Settings;
use super::tables::{Drawn, Lit};
use crate::checks::{Energy, mirror_symmetry, reciprocity};
use crate::scatterer::{Model, View};
use crate::sphere::Integrals;
use crate::statistics::{SIGNIFICANCE, normal_p};
use crate::verdict::{Check, Verdict, worst};

/// How far energy and density may be from what they must be. Fur as well: what its walks find is where
/// scattered light goes, not how much there is.
pub(crate) const ENERGY_BOUND: f64 = 1e-4;

/// Double precision has no rounding that counts; what is left is the quadrature's.
const DOUBLE_BOUND: f64 = 1e-5;
/// Value over density may pass 1 by rounding.
const WEIGHT_BOUND: f64 = 1.0 + 1e-5;
/// Fewest light samples that count, of those taken, for their mean to be worth a test.
const FEWEST_EFFECTIVE: f64 = 500.0;
/// Pairs of directions that are exchanged.
const PAIRS: u32 = 24;
const QUICK_PAIRS: u32 = 3;

pub(super) fn checks(
    model: &dyn Model,
    white: &[Energy],
    colored: &[Energy],
    drawn: &[Drawn],
    lit: &[Lit],
    settings: Settings,
) -> Vec<Check> {
    let mut checks = energy_checks(model, white, colored);
    checks.extend(sampling_checks(model, drawn));
    checks.push(light_check(lit));
    checks.extend(symmetry_checks(model, settings));
    checks
}

fn found<'a>(
    energies: &'a [Energy],
    error: impl Fn(&Energy) -> f64 + 'a,
) -> impl Iterator<Item = (f64, String)> + 'a {
    energies.iter().map(move |energy| (error(energy), energy.view.words()))
}

/// The largest difference of a channel from what it must be.
fn off(found: [f64; 3], right: [f64; 3]) -> f64 {
    worst(found.iter().zip(right).map(|(found, right)| ((found - right).abs(), ()))).0
}

fn energy_checks(model: &dyn Model, white: &[Energy], colored: &[Energy]) -> Vec<Check> {
    let bound = ENERGY_BOUND;
    let unit = model.parameters().hair.lobe_weights == [1.0; 5];
    // With weights for look development a white fibre is not white; it must still be what its lobes say.
    let right = |energy: &Energy| if unit { [1.0; 3] } else { energy.stated_total() };
    let law = if unit {
        "without absorption all light returns"
    } else {
        "the fibre returns what its weighted lobes say"
    };
    let mut list = Vec::new();
    let (figure, at) = worst(found(white, |energy| off(energy.single.total(), right(energy))));
    list.push(
        Check::at_most("White furnace, single precision", "|1 - albedo|", figure, bound)
            .found_at(at)
            .because(format!("{law}; quadrature over all directions, {} views", white.len())),
    );
    let doubles: Vec<(Integrals, &Energy)> =
        white.iter().filter_map(|energy| Some((energy.double?, energy))).collect();
    if !doubles.is_empty() {
        let figures =
            doubles.iter().map(|(double, energy)| (off(double.total(), right(energy)), energy.view.words()));
        let (figure, at) = worst(figures);
        list.push(
            Check::at_most("White furnace, double precision", "|1 - albedo|", figure, DOUBLE_BOUND)
                .found_at(at)
                .because(law),
        );
    }
    let both = || white.iter().chain(colored);
    let (figure, at) = worst(both().map(|e| ((e.single.pdf - 1.0).abs(), e.view.words())).filter(|_| true));
    list.push(
        Check::at_most("Density integrates to 1", "|1 - integral|", figure, bound)
            .found_at(at)
            .because("with and without absorption, single precision"),
    );
    let (figure, at) = worst(found(colored, Energy::lobe_error).chain(found(white, Energy::lobe_error)));
    list.push(
        Check::at_most("Every lobe scatters what it says", "|integral - stated|", figure, bound)
            .found_at(at)
            .because("integral of each lobe against `albedo()`, any channel"),
    );
    list
}

fn sampling_checks(model: &dyn Model, drawn: &[Drawn]) -> Vec<Check> {
    let views = drawn.len() as f64;
    let samples: u64 = drawn.first().map_or(0, |drawn| drawn.goodness.draws.asked);
    let least = |p: &dyn Fn(&Drawn) -> f64| {
        let (not, at) = worst(drawn.iter().map(|drawn| (1.0 - p(drawn), drawn.goodness.view.words())));
        (1.0 - not, at)
    };
    let (p, at) = {
        let all = drawn.iter().map(|drawn| (drawn.goodness.p, drawn.goodness.view.words()));
        all.fold(
            (1.0, String::new()),
            |least, found| if found.0 <= least.0 || found.0.is_nan() { found } else { least },
        )
    };
    let mut list = vec![
        Check::at_least("Samples follow the density", "chi-square p", p, SIGNIFICANCE / views).found_at(at).because(
            format!("{samples} samples a view, {views} views; one false alarm in a thousand for all of them together"),
        ),
    ];
    let (p, at) = least(&|drawn| drawn.weights.p);
    let (difference, _) = worst(drawn.iter().map(|drawn| (drawn.weights.difference, ())));
    list.push(
        Check::at_least("Mean weight of samples is the albedo", "p", p, SIGNIFICANCE / (3.0 * views))
            .found_at(at)
            .because(format!("largest difference {difference:.1e}, against quadrature")),
    );
    let (figure, at) = worst(drawn.iter().map(|drawn| (drawn.weights.largest, drawn.goodness.view.words())));
    let weight = if model.parameters().hair.lobe_weights.iter().all(|&weight| weight <= 1.0) {
        Check::at_most("No sample weighs more than 1", "largest weight", figure, WEIGHT_BOUND)
    } else {
        Check::told("Largest weight of a sample", "largest weight", figure)
    };
    list.push(
        weight.found_at(at).because("value over density, every channel: a path's throughput never grows"),
    );
    let count = |f: &dyn Fn(&Drawn) -> u64| drawn.iter().map(f).sum::<u64>() as f64;
    list.push(
        Check::at_most(
            "A sample is what evaluation says of it",
            "differences",
            count(&|d| d.goodness.draws.inconsistent),
            0.0,
        )
        .because("values and density of the sample against an evaluation of its direction, to the bit"),
    );
    list.push(
        Check::at_most(
            "Every number is a number",
            "broken samples",
            count(&|d| d.goodness.draws.broken),
            0.0,
        )
        .because("no NaN, no infinity, directions of length 1"),
    );
    list
}

fn light_check(lit: &[Lit]) -> Check {
    // What single precision and the quadrature may be off.
    const SLACK: f64 = 2e-4;
    let mut judged = 0.0;
    let (mut least, mut at) = (1.0, String::new());
    for lit in lit {
        for (name, moments) in lit.estimates.ways() {
            // A mean carried by a few lucky samples has no normal distribution to be judged by.
            if name == "light" && lit.estimates.light_effective < FEWEST_EFFECTIVE {
                continue;
            }
            judged += 1.0;
            let p = normal_p(lit.estimates.deviate(&moments, SLACK));
            if p < least || p.is_nan() {
                (least, at) = (p, format!("{}, {name}", lit.view.words()));
            }
        }
    }
    let name = "Light is the same, however it is sampled";
    if judged == 0.0 {
        return Check { verdict: Verdict::Unjudged, ..Check::told(name, "p", 1.0) };
    }
    Check::at_least(name, "p", least, SIGNIFICANCE / judged).found_at(at).because(format!(
        "a soft sky on one fibre: light alone, fibre alone, balance and power heuristic, {judged} estimates against quadrature"
    ))
}

fn symmetry_checks(model: &dyn Model, settings: Settings) -> Vec<Check> {
    let absorption = model.absorption();
    let mut list = Vec::new();
    if model.is_near() {
        let views = [View::degrees(20.0, 0.3), View::degrees(-60.0, 0.9)];
        let figures =
            views.map(|view| (mirror_symmetry(model, view, absorption, 2000, settings.seed), view.words()));
        let (figure, at) = worst(figures);
        // A direction's rounding is mirrored with it: what is left is that of angles.
        let bound = 1e-4 + 2e-6 / crate::landmarks::narrowest(model.parameters());
        list.push(
            Check::at_most(
                "Mirrored offset and azimuth change nothing",
                "relative difference",
                figure,
                bound,
            )
            .found_at(at)
            .because("value and density, left against right"),
        );
    }
    let pairs = if settings.quick { QUICK_PAIRS } else { PAIRS };
    let upright = model.upright();
    let measured = reciprocity(upright.as_deref().unwrap_or(model), absorption, pairs, settings.seed);
    let name = "Reciprocal around the fibre";
    let level = if upright.is_some() && !model.parameters().medulla.scatters() {
        Check::at_most(name, "asymmetry", measured.level, 1e-4)
    } else {
        Check::told(name, "asymmetry", measured.level)
    };
    list.push(level.because(
        "averaged over the offset, without tilt, both directions at the same inclination: mean |a - b| over mean",
    ));
    list.push(
        Check::told("Not promised: any two inclinations, averaged offset", "asymmetry", measured.any)
            .because(format!(
                "the attenuations depend on the outgoing inclination only; f itself: {:.1e}",
                measured.any_f
            )),
    );
    if model.is_near() {
        list.push(Check::told("Not promised: fixed offset", "asymmetry", measured.near).because(
            "an offset belongs to the outgoing ray; light from the other end meets the fibre elsewhere",
        ));
    }
    list
}
