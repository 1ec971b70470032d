//! The model as the papers print it: one lobe after the other, in scalar arithmetic with the system's
//! functions. What a careful programmer writes first, and what most renderers hold.
//!
//! Chiang et al. 2016 with M_p of d'Eon et al. 2011, its two cases of v, I0 by ten terms and its logarithm from
//! 12 on, as in pbrt, Cycles, Mitsuba and MaterialX. What depends on the camera's direction alone is worked out
//! once, as in the model it is measured against. It has this crate's sign of the tilt.

use std::f32::consts::{LN_2, PI, TAU};

use fibre_scattering::HairParameters;
use glam::Vec3;

/// A material.
#[derive(Clone, Copy)]
pub struct PaperHair {
    sigma_a: Vec3,
    eta: f32,
    v: [f32; 4],
    s: f32,
    tilts: [f32; 4],
}

/// A fibre met by a ray.
#[derive(Clone, Copy)]
pub struct PaperHit {
    attenuations: [Vec3; 4],
    probabilities: [f32; 4],
    /// Sine and cosine of the outgoing inclination as each lobe's scales see it.
    thetas_o: [(f32, f32); 4],
    phi_o: f32,
    gamma_o: f32,
    gamma_t: f32,
    v: [f32; 4],
    s: f32,
}

impl PaperHair {
    pub fn new(parameters: &HairParameters) -> PaperHair {
        let (m, n) = (parameters.beta_m, parameters.beta_n);
        let v = (0.726 * m + 0.812 * m * m + 3.7 * m.powi(20)).powi(2);
        let s = (PI / 8.0).sqrt() * (0.265 * n + 1.194 * n * n + 5.372 * n.powi(22));
        let alpha = parameters.alpha;
        PaperHair {
            sigma_a: parameters.sigma_a,
            eta: parameters.eta,
            v: [v, 0.25 * v, 4.0 * v, 4.0 * v],
            s,
            tilts: [2.0 * alpha, -alpha, -4.0 * alpha, 0.0],
        }
    }

    pub fn at(&self, wo: Vec3, h: f32) -> PaperHit {
        let sin_theta_o = wo.x;
        let cos_theta_o = (1.0 - sin_theta_o * sin_theta_o).max(0.0).sqrt();
        let sin_theta_t = sin_theta_o / self.eta;
        let cos_theta_t = (1.0 - sin_theta_t * sin_theta_t).max(0.0).sqrt();
        let etap = (self.eta * self.eta - sin_theta_o * sin_theta_o).sqrt() / cos_theta_o;
        let sin_gamma_t = h / etap;
        let cos_gamma_t = (1.0 - sin_gamma_t * sin_gamma_t).max(0.0).sqrt();
        let length = 2.0 * cos_gamma_t / cos_theta_t;
        let passed = Vec3::from_array(self.sigma_a.to_array().map(|sigma| (-sigma * length).exp()));
        let f = fresnel(cos_theta_o * (1.0 - h * h).max(0.0).sqrt(), self.eta);
        let tt = (1.0 - f) * (1.0 - f) * passed;
        let trt = tt * passed * f;
        let attenuations = [Vec3::splat(f), tt, trt, trt * f * passed / (Vec3::ONE - passed * f)];
        let most = attenuations.map(Vec3::max_element);
        let sum: f32 = most.iter().sum();
        PaperHit {
            attenuations,
            probabilities: most.map(|most| most / sum),
            thetas_o: self.tilts.map(|tilt| {
                let (sin, cos) = tilt.sin_cos();
                (sin_theta_o * cos + cos_theta_o * sin, (cos_theta_o * cos - sin_theta_o * sin).abs())
            }),
            phi_o: wo.z.atan2(wo.y),
            gamma_o: h.clamp(-1.0, 1.0).asin(),
            gamma_t: sin_gamma_t.clamp(-1.0, 1.0).asin(),
            v: self.v,
            s: self.s,
        }
    }
}

impl PaperHit {
    pub fn evaluate_with_pdf(&self, wi: Vec3) -> ([Vec3; 4], f32) {
        let mut values = [Vec3::ZERO; 4];
        let mut pdf = 0.0;
        self.lobes(wi, |p, density| {
            values[p] = self.attenuations[p] * density;
            pdf += self.probabilities[p] * density;
        });
        (values, pdf)
    }

    pub fn pdf(&self, wi: Vec3) -> f32 {
        let mut pdf = 0.0;
        self.lobes(wi, |p, density| pdf += self.probabilities[p] * density);
        pdf
    }

    fn lobes(&self, wi: Vec3, mut each: impl FnMut(usize, f32)) {
        let sin_theta_i = wi.x;
        let cos_theta_i = (1.0 - sin_theta_i * sin_theta_i).max(0.0).sqrt();
        let phi = wi.z.atan2(wi.y) - self.phi_o;
        for p in 0..4 {
            let (sin_theta_o, cos_theta_o) = self.thetas_o[p];
            let m = longitudinal(cos_theta_i, cos_theta_o, sin_theta_i, sin_theta_o, self.v[p]);
            let n = if p == 3 { 1.0 / TAU } else { self.azimuthal(phi, p) };
            each(p, m * n);
        }
    }

    fn azimuthal(&self, phi: f32, p: usize) -> f32 {
        let mut dphi = phi - self.exit(p);
        while dphi > PI {
            dphi -= TAU;
        }
        while dphi < -PI {
            dphi += TAU;
        }
        logistic(dphi, self.s) / (logistic_cdf(PI, self.s) - logistic_cdf(-PI, self.s))
    }

    fn exit(&self, p: usize) -> f32 {
        2.0 * p as f32 * self.gamma_t - 2.0 * self.gamma_o + p as f32 * PI
    }

    pub fn sample(&self, u: [f32; 4]) -> (Vec3, [Vec3; 4], f32) {
        let mut p = 0;
        let mut left = u[0];
        while p < 3 && left >= self.probabilities[p] {
            left -= self.probabilities[p];
            p += 1;
        }
        let (sin_theta_o, cos_theta_o) = self.thetas_o[p];
        let v = self.v[p];
        let u1 = u[1].max(1e-5);
        let cos_theta = 1.0 + v * (u1 + (1.0 - u1) * (-2.0 / v).exp()).ln();
        let sin_theta = (1.0 - cos_theta * cos_theta).max(0.0).sqrt();
        let sin_theta_i = -cos_theta * sin_theta_o + sin_theta * (TAU * u[2]).cos() * cos_theta_o;
        let cos_theta_i = (1.0 - sin_theta_i * sin_theta_i).max(0.0).sqrt();
        let dphi = if p == 3 {
            TAU * u[3]
        } else {
            let k = logistic_cdf(PI, self.s) - logistic_cdf(-PI, self.s);
            let x = -self.s * (1.0 / (u[3] * k + logistic_cdf(-PI, self.s)) - 1.0).ln();
            self.exit(p) + x.clamp(-PI, PI)
        };
        let (sin_phi, cos_phi) = (self.phi_o + dphi).sin_cos();
        let wi = Vec3::new(sin_theta_i, cos_theta_i * cos_phi, cos_theta_i * sin_phi);
        let (values, pdf) = self.evaluate_with_pdf(wi);
        (wi, values, pdf)
    }
}

fn longitudinal(cos_theta_i: f32, cos_theta_o: f32, sin_theta_i: f32, sin_theta_o: f32, v: f32) -> f32 {
    let a = cos_theta_i * cos_theta_o / v;
    let b = sin_theta_i * sin_theta_o / v;
    if v <= 0.1 {
        (log_i0(a) - b - 1.0 / v + LN_2 + (1.0 / (2.0 * v)).ln()).exp()
    } else {
        (-b).exp() * i0(a) / ((1.0 / v).sinh() * 2.0 * v)
    }
}

fn i0(x: f32) -> f32 {
    let mut value = 0.0;
    let mut power = 1.0;
    let mut factorial = 1.0_f32;
    let mut four = 1.0;
    for i in 0..10 {
        if i > 1 {
            factorial *= i as f32;
        }
        value += power / (four * factorial * factorial);
        power *= x * x;
        four *= 4.0;
    }
    value
}

fn log_i0(x: f32) -> f32 {
    if x > 12.0 { x + 0.5 * (-TAU.ln() + (1.0 / x).ln() + 1.0 / (8.0 * x)) } else { i0(x).ln() }
}

fn logistic(x: f32, s: f32) -> f32 {
    let fall = (-x.abs() / s).exp();
    fall / (s * (1.0 + fall) * (1.0 + fall))
}

fn logistic_cdf(x: f32, s: f32) -> f32 {
    1.0 / (1.0 + (-x / s).exp())
}

fn fresnel(cos_i: f32, eta: f32) -> f32 {
    let sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    let cos_t = (1.0 - sin2_t).max(0.0).sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}
