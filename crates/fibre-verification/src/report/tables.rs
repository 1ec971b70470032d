//! What the report's tables hold, and how they are filled.

use fibre_scattering::{Absorption, Lobe};
use serde::Serialize;

use super::Settings;
use crate::checks::{Energy, Estimates, Goodness, Sky, Weights, energy, estimates, goodness, weights};
use crate::landmarks::{azimuthal_scale, lobe_azimuths, lobe_deviations, lobe_inclinations};
use crate::scatterer::{Model, View};

/// Inclinations (degrees) and offsets at which energy is measured.
const INCLINATIONS: [f64; 8] = [-80.0, -45.0, -15.0, 0.0, 15.0, 45.0, 80.0, 89.9];
const OFFSETS: [f64; 8] = [-0.9999, -0.8, -0.4, 0.0, 0.2, 0.6, 0.95, 1.0];

/// Inclination (degrees) and offset of the views from which directions are drawn.
const DRAWN: [(f64, f64); 6] =
    [(0.0, 0.0), (20.0, 0.3), (-45.0, -0.7), (70.0, 0.95), (85.0, -0.3), (89.9, 0.5)];

/// What a quick look takes of them.
const QUICK_INCLINATIONS: [f64; 2] = [15.0, -80.0];
const QUICK_OFFSETS: [f64; 3] = [-0.4, 0.6, 1.0];
const QUICK_DRAWN: usize = 3;

/// From where a material is looked at.
pub(super) struct Views {
    /// Whether the offset counts.
    pub near: bool,
    pub energy: Vec<View>,
    pub drawn: Vec<View>,
}

impl Views {
    pub fn of(model: &dyn Model, quick: bool) -> Views {
        let near = model.is_near();
        let offsets: &[f64] = match (near, quick) {
            (false, _) => &[0.0],
            (true, false) => &OFFSETS,
            (true, true) => &QUICK_OFFSETS,
        };
        let inclinations: &[f64] = if quick { &QUICK_INCLINATIONS } else { &INCLINATIONS };
        let count = if quick { QUICK_DRAWN } else { DRAWN.len() };
        let energy =
            inclinations.iter().flat_map(|&theta| offsets.iter().map(move |&h| View::degrees(theta, h)));
        let drawn = DRAWN.iter().take(count);
        let drawn = drawn.map(|&(theta, h)| View::degrees(theta, if near { h } else { 0.0 }));
        Views { near, energy: energy.collect(), drawn: drawn.collect() }
    }

    /// How many parts the work has.
    pub fn steps(&self) -> u64 {
        (self.energy.len() + 2 * self.drawn.len()) as u64 + 2
    }
}

/// The fibre without absorption and as it is, from every view.
pub(super) fn energies(model: &dyn Model, views: &Views, tick: &dyn Fn()) -> (Vec<Energy>, Vec<Energy>) {
    let pair = |&view: &View| {
        let pair = (
            energy(model, view, Absorption::default(), true),
            energy(model, view, model.absorption(), false),
        );
        tick();
        pair
    };
    views.energy.iter().map(pair).unzip()
}

/// A chi-square test with the weights of its draws.
pub(super) struct Drawn {
    pub goodness: Goodness,
    pub weights: Weights,
}

pub(super) fn goodness_rows(
    model: &dyn Model,
    views: &Views,
    settings: Settings,
    tick: &dyn Fn(),
) -> Vec<Drawn> {
    let row = |(number, &view): (usize, &View)| {
        let seed = settings.seed.wrapping_add(number as u64);
        let goodness = goodness(model, view, model.absorption(), settings.samples, seed);
        let integral = energy(model, view, model.absorption(), false);
        // The density's integral says how good the quadrature is here; a density that is wrong says nothing.
        let slack = 1e-6 + (integral.single.pdf - 1.0).abs().min(1e-4);
        let weights = weights(&goodness.draws, integral.single.total(), slack);
        tick();
        Drawn { goodness, weights }
    };
    views.drawn.iter().enumerate().map(row).collect()
}

/// Estimates of the light of a sky from a view.
pub(super) struct Lit {
    pub view: View,
    pub estimates: Estimates,
}

pub(super) fn light_rows(model: &dyn Model, views: &Views, settings: Settings, tick: &dyn Fn()) -> Vec<Lit> {
    let sky = Sky::new(settings.seed);
    let row = |(number, &view): (usize, &View)| {
        let seed = settings.seed.wrapping_add(100 + number as u64);
        let count = settings.samples / 4;
        let estimates = estimates(model, view, model.absorption(), &sky, count, seed);
        tick();
        Lit { view, estimates }
    };
    views.drawn.iter().enumerate().map(row).collect()
}

/// What is scattered, seen from one inclination and offset.
#[derive(Debug, Clone, Serialize)]
pub struct AlbedoRow {
    /// Degrees.
    pub theta_o: f64,
    /// Offset across the fibre.
    pub h: f64,
    /// Share scattered by each lobe, per channel, by quadrature of single precision.
    pub lobes: [[f64; 3]; 5],
    /// All lobes.
    pub total: [f64; 3],
    /// The same fibre without absorption: single and double precision, worst channel.
    pub white: f64,
    /// Double precision of it, where there is such a path.
    pub white_double: Option<f64>,
    /// Integral of the density.
    pub pdf: f64,
}

impl AlbedoRow {
    pub(super) fn new((colored, white): (&Energy, &Energy)) -> AlbedoRow {
        AlbedoRow {
            theta_o: crate::scatterer::round(colored.view.theta_o.to_degrees(), 1e6),
            h: colored.view.h,
            lobes: colored.single.lobes,
            total: colored.single.total(),
            white: white.single.total()[0],
            white_double: white.double.map(|double| double.total()[0]),
            pdf: colored.single.pdf,
        }
    }
}

/// One chi-square test.
#[derive(Debug, Clone, Serialize)]
pub struct GoodnessRow {
    /// From where.
    pub view: String,
    /// Directions drawn.
    pub samples: u64,
    /// Pearson's sum.
    pub chi_square: f64,
    /// Degrees of freedom.
    pub degrees: f64,
    /// Chance of so large a sum by accident.
    pub p: f64,
}

impl GoodnessRow {
    pub(super) fn new(drawn: &Drawn) -> GoodnessRow {
        let goodness = &drawn.goodness;
        GoodnessRow {
            view: goodness.view.words(),
            samples: goodness.draws.given,
            chi_square: goodness.chi_square,
            degrees: goodness.degrees,
            p: goodness.p,
        }
    }
}

/// Weights of the draws of one view.
#[derive(Debug, Clone, Serialize)]
pub struct WeightRow {
    /// From where.
    pub view: String,
    /// Largest weight in any channel.
    pub largest: f64,
    /// Mean weight per channel.
    pub mean: [f64; 3],
    /// Its standard error.
    pub standard_error: [f64; 3],
    /// The albedo by quadrature.
    pub albedo: [f64; 3],
    /// Chance of so large a difference in the worst channel.
    pub p: f64,
}

impl WeightRow {
    pub(super) fn new(drawn: &Drawn) -> WeightRow {
        let Weights { mean, standard_error, albedo, largest, p, .. } = drawn.weights;
        WeightRow { view: drawn.goodness.view.words(), largest, mean, standard_error, albedo, p }
    }
}

/// Light of a sky that reaches the eye, estimated in four ways.
#[derive(Debug, Clone, Serialize)]
pub struct LightRow {
    /// From where.
    pub view: String,
    /// By quadrature.
    pub exact: f64,
    /// Name of the way, its estimate, standard error and deviation from `exact` in standard errors.
    pub ways: Vec<(&'static str, f64, f64, f64)>,
}

impl LightRow {
    pub(super) fn new(lit: &Lit) -> LightRow {
        let way = |(name, moments): (&'static str, crate::statistics::Moments)| {
            let error = moments.standard_error();
            (name, moments.mean, error, (moments.mean - lit.estimates.exact) / error)
        };
        LightRow {
            view: lit.view.words(),
            exact: lit.estimates.exact,
            ways: lit.estimates.ways().into_iter().map(way).collect(),
        }
    }
}

/// What a lobe is, at one view.
#[derive(Debug, Clone, Serialize)]
pub struct LobeRow {
    /// Its name.
    pub lobe: &'static str,
    /// Inclination it lies about, in degrees, for light from 30 degrees.
    pub inclination: Option<f64>,
    /// Azimuth it lies about, in degrees, at the offset 0.3.
    pub azimuth: Option<f64>,
    /// Standard deviation along the fibre, in degrees.
    pub deviation: Option<f64>,
    /// Scale of the logistic around the fibre, in degrees.
    pub scale: Option<f64>,
    /// Share it says it scatters, per channel.
    pub share: [f64; 3],
}

/// The view of the lobe table and of the longitudinal plot.
pub(super) const LOBE_VIEW: (f64, f64) = (30.0, 0.3);

pub(super) fn lobe_rows(model: &dyn Model) -> Vec<LobeRow> {
    let hair = &model.parameters().hair;
    let view = View::degrees(LOBE_VIEW.0, LOBE_VIEW.1);
    let albedo = model.at(view, model.absorption()).albedo();
    let (thetas, phis) = (lobe_inclinations(hair, view), lobe_azimuths(hair, view));
    let (deviations, scale) = (lobe_deviations(hair), azimuthal_scale(hair));
    let degrees = |list: &[f64], p: usize| list.get(p).map(|x| x.to_degrees());
    let known = model.is_near() && hair.film.is_none() && hair.aspect == 1.0;
    let row = |(p, lobe): (usize, Lobe)| LobeRow {
        lobe: lobe.name(),
        inclination: degrees(&thetas, p).filter(|_| hair.film.is_none()),
        azimuth: degrees(&phis, p).filter(|_| known),
        deviation: degrees(&deviations, p).filter(|_| hair.film.is_none()),
        scale: (p < 3).then_some(scale.to_degrees()),
        share: albedo[p].as_dvec3().to_array(),
    };
    Lobe::ALL
        .into_iter()
        .enumerate()
        .map(row)
        .filter(|row| row.lobe != "scattered" || row.share != [0.0; 3])
        .collect()
}
