//! The published formulas written out from the papers, with the slips other programs share as options.
//!
//! Chiang et al. 2016 as pbrt-v3 writes it (Pharr: The Implementation of a Hair Scattering Model, 2016) and
//! Mitsuba 3 after it. Nothing here is shared with `fibre-scattering`: it is a second opinion, in f64.

use std::f64::consts::{PI, TAU};

/// One fibre from two directions, angles in radians; the tilt as pbrt counts it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Published {
    /// Roughness along the fibre.
    pub beta_m: f64,
    /// Roughness around it.
    pub beta_n: f64,
    /// Tilt; positive moves R to where the tangent points.
    pub alpha: f64,
    /// Index of refraction.
    pub eta: f64,
    /// Absorption per radius.
    pub sigma_a: [f64; 3],
    /// Inclination of the viewer.
    pub theta_o: f64,
    /// Offset.
    pub h: f64,
    /// Inclination of the light.
    pub theta_i: f64,
    /// Azimuth of the light less that of the viewer.
    pub phi: f64,
}

/// What a program does otherwise than the formulas say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Slips {
    /// I0 by so many terms of its power series; exact at 0.
    pub terms: u32,
    /// log I0 beyond 12 with half of its term 1/(8x).
    pub halved: bool,
    /// ln 2 as 0.6931.
    pub rounded_ln_2: bool,
    /// Lobes chosen by the luminance of their attenuation, not by the channel that is absorbed least.
    pub by_luminance: bool,
}

/// f cos(theta_i) per channel, and the density.
#[must_use]
pub fn published(fibre: &Published, slips: Slips) -> ([f64; 3], f64) {
    let attenuations = fibre.attenuations();
    let along = fibre.longitudinal(slips);
    let around = fibre.azimuthal();
    let mut value = [0.0; 3];
    let chances = chances(&attenuations, slips);
    let mut pdf = 0.0;
    for p in 0..4 {
        let density = along[p] * around[p];
        pdf += chances[p] * density;
        for (value, attenuation) in value.iter_mut().zip(attenuations[p]) {
            *value += attenuation * density;
        }
    }
    (value, pdf)
}

impl Published {
    fn longitudinal(&self, slips: Slips) -> [f64; 4] {
        let b = self.beta_m;
        let v = (0.726 * b + 0.812 * b * b + 3.7 * b.powi(20)).powi(2);
        let turns = [-2.0 * self.alpha, self.alpha, 4.0 * self.alpha, 0.0];
        let spreads = [v, 0.25 * v, 4.0 * v, 4.0 * v];
        std::array::from_fn(|p| {
            let theta_o = self.theta_o + turns[p];
            m(self.theta_i, theta_o.sin(), theta_o.cos().abs(), spreads[p], slips)
        })
    }

    fn azimuthal(&self) -> [f64; 4] {
        let b = self.beta_n;
        let s = (PI / 8.0).sqrt() * (0.265 * b + 1.194 * b * b + 5.372 * b.powi(22));
        let gamma_o = self.h.clamp(-1.0, 1.0).asin();
        let gamma_t = (self.h / self.bent_index()).clamp(-1.0, 1.0).asin();
        let lobe = |p: f64| {
            let centre = 2.0 * p * gamma_t - 2.0 * gamma_o + p * PI;
            let away = self.phi - centre;
            trimmed_logistic(away - TAU * (away / TAU).round(), s)
        };
        [lobe(0.0), lobe(1.0), lobe(2.0), 1.0 / TAU]
    }

    /// eta' of Marschner et al. 2003.
    fn bent_index(&self) -> f64 {
        (self.eta * self.eta - self.theta_o.sin().powi(2)).sqrt() / self.theta_o.cos()
    }

    fn attenuations(&self) -> [[f64; 3]; 4] {
        let cos_gamma_o = (1.0 - self.h * self.h).max(0.0).sqrt();
        let f = fresnel(self.theta_o.cos() * cos_gamma_o, self.eta);
        let sin_theta_t = self.theta_o.sin() / self.eta;
        let cos_theta_t = (1.0 - sin_theta_t * sin_theta_t).sqrt();
        let sin_gamma_t = self.h / self.bent_index();
        let cos_gamma_t = (1.0 - sin_gamma_t * sin_gamma_t).max(0.0).sqrt();
        let mut lobes = [[0.0; 3]; 4];
        for (channel, sigma) in self.sigma_a.into_iter().enumerate() {
            let t = (-sigma * 2.0 * cos_gamma_t / cos_theta_t).exp();
            let tt = (1.0 - f) * (1.0 - f) * t;
            let trt = tt * t * f;
            let rest = if t * f < 1.0 { trt * f * t / (1.0 - t * f) } else { 0.0 };
            for (lobe, value) in lobes.iter_mut().zip([f, tt, trt, rest]) {
                lobe[channel] = value;
            }
        }
        lobes
    }
}

fn chances(attenuations: &[[f64; 3]; 4], slips: Slips) -> [f64; 4] {
    let weight = |[r, g, b]: [f64; 3]| {
        if slips.by_luminance { 0.212_671 * r + 0.715_16 * g + 0.072_169 * b } else { r.max(g).max(b) }
    };
    let weights = attenuations.map(weight);
    let sum: f64 = weights.iter().sum();
    if sum > 0.0 { weights.map(|weight| weight / sum) } else { [0.0; 4] }
}

/// M_p of d'Eon et al. 2011, in the two forms pbrt has it in.
#[allow(clippy::approx_constant)] // the slip itself
fn m(theta_i: f64, sin_o: f64, cos_o: f64, v: f64, slips: Slips) -> f64 {
    let a = theta_i.cos() * cos_o / v;
    let b = theta_i.sin() * sin_o / v;
    if v <= 0.1 {
        let ln_2 = if slips.rounded_ln_2 { 0.6931 } else { std::f64::consts::LN_2 };
        (ln_i0(a, slips) - b - 1.0 / v + ln_2 + (0.5 / v).ln()).exp()
    } else {
        (-b).exp() * i0(a, slips) / ((1.0 / v).sinh() * 2.0 * v)
    }
}

fn i0(x: f64, slips: Slips) -> f64 {
    let terms = if slips.terms == 0 { 400 } else { slips.terms };
    let (mut term, mut sum) = (1.0, 0.0);
    for k in 0..terms {
        sum += term;
        let next = f64::from(k + 1);
        term *= 0.25 * x * x / (next * next);
        if term < 1e-18 * sum {
            break;
        }
    }
    sum
}

fn ln_i0(x: f64, slips: Slips) -> f64 {
    let seam = if slips.terms == 0 && !slips.halved { 60.0 } else { 12.0 };
    if x <= seam {
        return i0(x, slips).ln();
    }
    let leading = x - 0.5 * (TAU * x).ln();
    if slips.halved {
        return leading + 0.5 / (8.0 * x);
    }
    // Abramowitz and Stegun 9.7.1.
    let (mut term, mut sum, mut k) = (1.0_f64, 1.0, 1.0);
    while k < 12.0 {
        term *= (2.0 * k - 1.0) * (2.0 * k - 1.0) / (8.0 * x * k);
        sum += term;
        k += 1.0;
    }
    leading + sum.ln()
}

fn trimmed_logistic(x: f64, s: f64) -> f64 {
    let fall = (-x.abs() / s).exp();
    let edge = (-PI / s).exp();
    fall / (s * (1.0 + fall) * (1.0 + fall)) * (1.0 + edge) / (1.0 - edge)
}

fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let cos_t = (1.0 - (1.0 - cos_i * cos_i) / (eta * eta)).max(0.0).sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let across = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (parallel * parallel + across * across)
}
