//! Where the lobes of a fibre lie, so that no quadrature misses them.

use std::f64::consts::{FRAC_PI_8, PI, TAU};

use fibre_scattering::{FurParameters, HairParameters, MedullaTable};

use crate::quadrature::Peak;
use crate::random::Random;
use crate::scatterer::{Scatterer, View, angles, widened};

/// Peaks and kinks along the fibre (in inclination) and around it (in azimuth).
#[derive(Debug, Clone, Default)]
pub struct Landmarks {
    /// Of the inclination.
    pub along: Vec<Peak>,
    /// Of the azimuth, each within a turn of 0.
    pub around: Vec<Peak>,
    /// Inclinations at which the function may jump or bend.
    pub along_kinks: Vec<f64>,
    /// Azimuths at which it may.
    pub around_kinks: Vec<f64>,
}

/// Directions drawn to see where a sampler sends light.
const PILOTS: usize = 4096;

impl Landmarks {
    /// What the formulas of hair say: lobes about the tilted mirror inclination and about 2 p gamma_t - 2
    /// gamma_i + p pi. A film and an elliptical cross-section move them; [`Landmarks::add_pilots`] finds those.
    #[must_use]
    pub fn of_hair(parameters: &HairParameters, view: View) -> Landmarks {
        let mut landmarks = Landmarks::default();
        let spreads = lobe_deviations(parameters);
        let s = azimuthal_scale(parameters);
        let (thetas, phis) = (lobe_inclinations(parameters, view), lobe_azimuths(parameters, view));
        for (theta, sigma) in thetas.into_iter().zip(spreads) {
            landmarks.along.push(Peak { centre: theta, width: 0.7 * sigma });
        }
        for phi in phis.map(|phi| phi + view.phi_o) {
            landmarks.around.push(Peak { centre: phi, width: s });
            // The trimmed density bends where its two ends meet.
            landmarks.around_kinks.push(wrapped(phi + PI));
        }
        landmarks
    }

    /// Adds the knots of a medulla's table, at which the scattered lobe bends.
    pub fn add_medulla(&mut self, parameters: &HairParameters, view: View) {
        let (sines, step) = MedullaTable::knots();
        self.along_kinks.extend(sines.iter().flat_map(|sine| [sine.asin(), -sine.asin()]));
        let first = lobe_azimuths(parameters, view)[1] + view.phi_o;
        let steps = (TAU / step).round() as u32;
        self.around_kinks.extend((0..steps).map(|knot| first + step * f64::from(knot)));
    }

    /// Looks where `scatterer` sends light: a peak at each sextile of each lobe, both ways.
    pub fn add_pilots(&mut self, scatterer: &dyn Scatterer) {
        let mut random = Random::new(0x9107, 0);
        let mut drawn: [Vec<(f64, f64)>; 5] = Default::default();
        for _ in 0..PILOTS {
            if let Some(sample) = scatterer.sample(random.four()) {
                drawn[sample.lobe.index()].push(angles(widened(sample.wi)));
            }
        }
        for lobe in drawn.iter().filter(|lobe| lobe.len() >= 48) {
            let mut thetas: Vec<f64> = lobe.iter().map(|&(theta, _)| theta).collect();
            push_sextiles(&mut self.along, &mut thetas);
            let (sin, cos) = lobe.iter().fold((0.0, 0.0), |(s, c), &(_, phi)| (s + phi.sin(), c + phi.cos()));
            let mean = f64::atan2(sin, cos);
            let mut phis: Vec<f64> = lobe.iter().map(|&(_, phi)| mean + wrapped(phi - mean)).collect();
            push_sextiles(&mut self.around, &mut phis);
        }
    }
}

impl Landmarks {
    /// The peaks around the fibre, each a turn back and a turn ahead too, for panels over one turn.
    #[must_use]
    pub fn around_turned(&self) -> Vec<Peak> {
        let turned = |peak: &Peak| {
            let centre = wrapped(peak.centre);
            [-TAU, 0.0, TAU].map(|turn| Peak { centre: centre + turn, ..*peak })
        };
        self.around.iter().flat_map(turned).collect()
    }
}

fn push_sextiles(peaks: &mut Vec<Peak>, values: &mut [f64]) {
    values.sort_by(f64::total_cmp);
    let at = |k: usize| values[(values.len() - 1) * k / 6];
    for k in 1..6 {
        let width = (at(k + 1) - at(k)).min(at(k) - at(k - 1));
        // Sextiles of a narrow lobe lie half its deviation apart.
        peaks.push(Peak { centre: at(k), width: (1.5 * width).max(1e-5) });
    }
}

/// Standard deviation of R, TT, TRT and the residual along the fibre: Chiang et al. 2016, eq. 7.
#[must_use]
pub fn lobe_deviations(parameters: &HairParameters) -> [f64; 4] {
    let b = f64::from(parameters.beta_m);
    let sigma = 0.726 * b + 0.812 * b * b + 3.7 * b.powi(20);
    let (tt, trt) = (f64::from(parameters.roughness_scales.tt), f64::from(parameters.roughness_scales.trt));
    [sigma, tt * sigma, trt * sigma, trt * sigma]
}

/// Scale of the logistic around the fibre: eq. 8 with the root of pi/8.
#[must_use]
pub fn azimuthal_scale(parameters: &HairParameters) -> f64 {
    let b = f64::from(parameters.beta_n);
    FRAC_PI_8.sqrt() * (0.265 * b + 1.194 * b * b + 5.372 * b.powi(22))
}

/// Inclination about which R, TT, TRT and the residual lie.
#[must_use]
pub fn lobe_inclinations(parameters: &HairParameters, view: View) -> [f64; 4] {
    let alpha = f64::from(parameters.alpha);
    [2.0, -1.0, -4.0, 0.0].map(|times| -(view.theta_o + times * alpha).sin().asin())
}

/// Azimuth about which R, TT and TRT lie.
#[must_use]
pub fn lobe_azimuths(parameters: &HairParameters, view: View) -> [f64; 3] {
    let (sin, cos) = view.theta_o.sin_cos();
    let eta = f64::from(parameters.eta);
    let bent = (eta * eta - sin * sin).sqrt();
    let gamma_i = view.h.clamp(-1.0, 1.0).asin();
    let gamma_t = (view.h * cos / bent).clamp(-1.0, 1.0).asin();
    [0.0, 1.0, 2.0].map(|p| wrapped(2.0 * p * gamma_t - 2.0 * gamma_i + p * PI))
}

/// The same angle in [-pi, pi].
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Narrowest width of any lobe, in radians: how far rounding a direction moves values.
#[must_use]
pub fn narrowest(parameters: &FurParameters) -> f64 {
    let hair = &parameters.hair;
    let of = |hair: &HairParameters| {
        let along = lobe_deviations(hair).into_iter().fold(f64::INFINITY, f64::min);
        along.min(azimuthal_scale(hair))
    };
    // The film's surface has a roughness of its own.
    let film = hair.film.map(|film| HairParameters {
        beta_m: film.roughness,
        beta_n: film.roughness,
        ..HairParameters::default()
    });
    film.map_or(f64::INFINITY, |film| of(&film)).min(of(hair))
}
