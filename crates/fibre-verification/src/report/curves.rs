//! What the page plots: where each lobe sends light, around the fibre and along it.

use std::f64::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;
use serde::Serialize;

use super::tables::LOBE_VIEW;
use crate::quadrature::{Peak, nodes, panels};
use crate::scatterer::{Model, Scatterer, View, direction};
use crate::sphere::wide;

/// One lobe of one view: light per radian, mean of the channels, at each abscissa.
#[derive(Debug, Clone, Serialize)]
pub struct LobeCurve {
    /// Degrees.
    pub angles: Vec<f64>,
    /// Per lobe: share of the light, per radian.
    pub lobes: [Vec<f64>; 5],
}

/// All that is plotted.
#[derive(Debug, Clone, Serialize)]
pub struct Curves {
    /// Around the fibre, light from the normal plane, at some offsets.
    pub azimuthal: Vec<(f64, LobeCurve)>,
    /// Along it, for light from 30 degrees at the offset 0.3.
    pub longitudinal: LobeCurve,
    /// Inclination of the outgoing direction of the latter, in degrees.
    pub theta_o: f64,
}

const OFFSETS: [f64; 4] = [0.0, 0.3, 0.6, 0.9];

impl Curves {
    pub(super) fn of(model: &dyn Model) -> Curves {
        let offsets: &[f64] = if model.is_near() { &OFFSETS } else { &[0.0] };
        let azimuthal = offsets.iter().map(|&h| (h, around(model, View::degrees(0.0, h))));
        let view = View::degrees(LOBE_VIEW.0, LOBE_VIEW.1);
        Curves { azimuthal: azimuthal.collect(), longitudinal: along(model, view), theta_o: LOBE_VIEW.0 }
    }
}

/// Light per radian of azimuth: the integral over inclinations.
fn around(model: &dyn Model, view: View) -> LobeCurve {
    let marks = model.landmarks(view);
    let phis = abscissae(-PI, PI, &marks.around_turned());
    let edges = panels(-FRAC_PI_2, FRAC_PI_2, &marks.along, &marks.along_kinks);
    let scatterer = model.at(view, model.absorption());
    curve(&phis, |phi| summed(&*scatterer, &edges, |theta| (direction(theta, phi), theta.cos())))
}

/// Light per radian of inclination: the integral over azimuths.
fn along(model: &dyn Model, view: View) -> LobeCurve {
    let marks = model.landmarks(view);
    let thetas = abscissae(-FRAC_PI_2, FRAC_PI_2, &marks.along);
    let edges = panels(-PI, PI, &marks.around_turned(), &marks.around_kinks);
    let scatterer = model.at(view, model.absorption());
    curve(&thetas, |theta| summed(&*scatterer, &edges, |phi| (direction(theta, phi), theta.cos())))
}

fn curve(angles: &[f64], f: impl Fn(f64) -> [f64; 5] + Sync) -> LobeCurve {
    let values: Vec<[f64; 5]> = angles.par_iter().map(|&angle| f(angle)).collect();
    LobeCurve {
        angles: angles.iter().map(|angle| crate::scatterer::round(angle.to_degrees(), 1e4)).collect(),
        lobes: std::array::from_fn(|p| values.iter().map(|value| value[p]).collect()),
    }
}

/// Even steps of two degrees, and finer ones where lobes are.
fn abscissae(low: f64, high: f64, peaks: &[Peak]) -> Vec<f64> {
    let finer: Vec<Peak> =
        peaks.iter().map(|peak| Peak { width: (0.3 * peak.width).max(2e-3), ..*peak }).collect();
    let steps = ((high - low) / 2.0_f64.to_radians()).round() as u32;
    let mut all: Vec<f64> =
        (0..=steps).map(|i| low + (high - low) * f64::from(i) / f64::from(steps)).collect();
    all.extend(panels(low, high, &finer, &[]));
    all.sort_by(f64::total_cmp);
    all.dedup_by(|b, a| *b - *a < 2e-3);
    all
}

fn summed(scatterer: &dyn Scatterer, edges: &[f64], at: impl Fn(f64) -> ([f64; 3], f64)) -> [f64; 5] {
    let mut sums = [0.0; 5];
    for pair in edges.windows(2) {
        for (x, weight) in nodes(pair[0], pair[1]) {
            let (wi, factor) = at(x);
            let (lobes, _) = wide(scatterer, wi);
            for (sum, lobe) in sums.iter_mut().zip(lobes) {
                *sum += weight * factor * lobe.iter().sum::<f64>() / 3.0;
            }
        }
    }
    sums
}
