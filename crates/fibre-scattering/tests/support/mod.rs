//! What the tests share: cases, where their lobes lie, quadrature that finds them, random numbers.
#![allow(dead_code, clippy::unwrap_used)] // each test uses a part; a test may panic

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use fibre_scattering::{HairBcsdf, HairParameters, HairScatter, ReferenceBcsdf, ReferenceScatter};
use glam::Vec3;

/// One fibre from one direction, angles in degrees.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    pub beta_m: f64,
    pub beta_n: f64,
    pub alpha: f64,
    pub eta: f64,
    pub h: f64,
    pub theta_o: f64,
    pub sigma_a: [f64; 3],
}

pub const PLAIN: Case =
    Case { beta_m: 0.3, beta_n: 0.3, alpha: 2.0, eta: 1.55, h: 0.3, theta_o: 20.0, sigma_a: [0.0; 3] };

impl Case {
    pub fn parameters(&self) -> HairParameters {
        HairParameters {
            beta_m: self.beta_m as f32,
            beta_n: self.beta_n as f32,
            alpha: self.alpha.to_radians() as f32,
            eta: self.eta as f32,
            sigma_a: Vec3::from_array(self.sigma_a.map(|s| s as f32)),
            ..HairParameters::default()
        }
    }

    /// The camera's direction, at azimuth 0.
    pub fn wo(&self) -> [f64; 3] {
        direction(self.theta_o.to_radians(), 0.0)
    }

    pub fn single(&self) -> HairScatter {
        HairBcsdf::new(&self.parameters()).unwrap().at(single(self.wo()), self.h as f32)
    }

    pub fn double(&self) -> ReferenceScatter {
        ReferenceBcsdf::new(&self.parameters()).unwrap().at(self.wo(), self.h)
    }

    /// Standard deviation of each lobe along the fibre.
    pub fn sigmas(&self) -> [f64; 4] {
        let b = self.beta_m;
        let sigma = 0.726 * b + 0.812 * b * b + 3.7 * b.powi(20);
        [sigma, 0.5 * sigma, 2.0 * sigma, 2.0 * sigma]
    }

    /// Scale of the logistic around the fibre.
    pub fn scale(&self) -> f64 {
        let b = self.beta_n;
        (PI / 8.0).sqrt() * (0.265 * b + 1.194 * b * b + 5.372 * b.powi(22))
    }

    /// Inclination about which each lobe lies.
    pub fn thetas(&self) -> [f64; 4] {
        let alpha = self.alpha.to_radians();
        [2.0, -1.0, -4.0, 0.0].map(|times| {
            let turned = self.theta_o.to_radians() + times * alpha;
            -turned.sin().asin()
        })
    }

    /// Azimuth about which each lobe lies; the residual lies about none.
    pub fn phis(&self) -> [f64; 4] {
        let (sin, cos) = self.theta_o.to_radians().sin_cos();
        let bent = (self.eta * self.eta - sin * sin).sqrt() / cos;
        let gamma_i = self.h.asin();
        let gamma_t = (self.h / bent).asin();
        let exit = |p: f64| wrapped(2.0 * p * gamma_t - 2.0 * gamma_i + p * PI);
        [exit(0.0), exit(1.0), exit(2.0), 0.0]
    }

    /// Values of the first channel per lobe in single precision.
    pub fn values_single(&self) -> impl Fn(f64, f64) -> [f64; 4] + use<> {
        let scatter = self.single();
        move |theta, phi| {
            let values = scatter.evaluate(single(direction(theta, phi)));
            [0, 1, 2, 3].map(|p: usize| f64::from(values.0[p].x))
        }
    }

    /// Values of the first channel per lobe in double precision.
    pub fn values_double(&self) -> impl Fn(f64, f64) -> [f64; 4] + use<> {
        let scatter = self.double();
        move |theta, phi| {
            let (values, _) = scatter.evaluate_with_pdf(direction(theta, phi));
            [0, 1, 2, 3].map(|p: usize| values[p][0])
        }
    }
}

/// The unit direction of an inclination and an azimuth, in radians.
pub fn direction(theta: f64, phi: f64) -> [f64; 3] {
    let (sin, cos) = theta.sin_cos();
    [sin, cos * phi.cos(), cos * phi.sin()]
}

pub fn single(direction: [f64; 3]) -> Vec3 {
    Vec3::from_array(direction.map(|x| x as f32))
}

pub fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Edges over [low, high], dense about each centre at its width and sparser away from it.
pub fn edges(low: f64, high: f64, peaks: &[(f64, f64)]) -> Vec<f64> {
    let mut edges = vec![low, high];
    for &(centre, width) in peaks {
        edges.push(centre);
        let mut step = width;
        while step < high - low {
            edges.extend([centre - step, centre + step]);
            step *= 2.0;
        }
    }
    edges.retain(|edge| (low..=high).contains(edge));
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    edges
}

/// The integral over one panel by Gauss and Legendre's rule with eight nodes.
pub fn gauss(low: f64, high: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    const NODES: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
    ];
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let sum: f64 = NODES.iter().map(|&(x, w)| w * (f(middle - half * x) + f(middle + half * x))).sum();
    half * sum
}

/// The integral over all panels, each cut in `parts`.
pub fn integral(edges: &[f64], parts: u32, mut f: impl FnMut(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for pair in edges.windows(2) {
        let step = (pair[1] - pair[0]) / f64::from(parts);
        for part in 0..parts {
            let low = pair[0] + step * f64::from(part);
            sum += gauss(low, low + step, &mut f);
        }
    }
    sum
}

/// What each lobe scatters: the integral over the sphere, taken as the product of one along the
/// fibre and one around it through the lobe's middle.
pub fn scattered(case: &Case, parts: u32, values: impl Fn(f64, f64) -> [f64; 4]) -> [f64; 4] {
    let (thetas, phis, sigmas) = (case.thetas(), case.phis(), case.sigmas());
    std::array::from_fn(|p| {
        let (theta, phi) = (thetas[p], phis[p]);
        let middle = values(theta, phi)[p];
        if middle == 0.0 {
            return 0.0;
        }
        let along = edges(-FRAC_PI_2, FRAC_PI_2, &[(theta, sigmas[p])]);
        let along = integral(&along, parts, |t| values(t, phi)[p] * t.cos());
        let around = edges(phi - PI, phi + PI, &[(phi, case.scale())]);
        let around = integral(&around, parts, |x| values(theta, x)[p]);
        along * (around / middle)
    })
}

/// Uniform numbers in [0, 1) by SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f64 / (1u64 << 24) as f64
    }

    pub fn four(&mut self) -> [f32; 4] {
        std::array::from_fn(|_| self.next() as f32)
    }
}
