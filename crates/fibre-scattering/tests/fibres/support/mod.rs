//! What the tests share: cases, where their lobes lie, quadrature that finds them, random numbers.
#![allow(clippy::unwrap_used)] // a test may panic

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use fibre_scattering::{
    HairBcsdf, HairParameters, HairScatter, ReferenceBcsdf, ReferenceScatter, RoughnessScales, WaterFilm,
};
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
    pub scales: RoughnessScales,
    pub layers: Option<f32>,
    pub film: Option<WaterFilm>,
    pub aspect: f64,
    /// Azimuth of the camera, which is of account for an ellipse only.
    pub phi_o: f64,
}

pub const PLAIN: Case = Case {
    beta_m: 0.3,
    beta_n: 0.3,
    alpha: 2.0,
    eta: 1.55,
    h: 0.3,
    theta_o: 20.0,
    sigma_a: [0.0; 3],
    scales: RoughnessScales { tt: 0.5, trt: 2.0 },
    layers: None,
    film: None,
    aspect: 1.0,
    phi_o: 0.0,
};

pub const WATER: WaterFilm = WaterFilm { eta: 1.33, roughness: 0.1 };

impl Case {
    pub fn parameters(&self) -> HairParameters {
        HairParameters {
            beta_m: self.beta_m as f32,
            beta_n: self.beta_n as f32,
            alpha: self.alpha.to_radians() as f32,
            eta: self.eta as f32,
            sigma_a: Vec3::from_array(self.sigma_a.map(|s| s as f32)),
            roughness_scales: self.scales,
            cuticle_layers: self.layers,
            film: self.film,
            aspect: self.aspect as f32,
            ..HairParameters::default()
        }
    }

    /// The camera's direction.
    pub fn wo(&self) -> [f64; 3] {
        self.seen(self.theta_o.to_radians(), 0.0)
    }

    /// The direction of an inclination and an azimuth against the camera's, in radians.
    pub fn seen(&self, theta: f64, phi: f64) -> [f64; 3] {
        direction(theta, phi + self.phi_o.to_radians())
    }

    pub fn single(&self) -> HairScatter {
        HairBcsdf::new(&self.parameters()).unwrap().at(single(self.wo()), self.h as f32)
    }

    pub fn double(&self) -> ReferenceScatter {
        ReferenceBcsdf::new(&self.parameters()).unwrap().at(self.wo(), self.h)
    }

    /// Standard deviation of each lobe along the fibre.
    pub fn sigmas(&self) -> [f64; 4] {
        let sigma = |b: f64| 0.726 * b + 0.812 * b * b + 3.7 * b.powi(20);
        let dry = sigma(self.beta_m);
        let [tt, trt] = [self.scales.tt, self.scales.trt].map(|scale| dry * f64::from(scale));
        [self.film.map_or(dry, |film| sigma(f64::from(film.roughness))), tt, trt, trt]
    }

    /// Scale of each lobe's logistic around the fibre.
    pub fn logistic_scales(&self) -> [f64; 4] {
        let scale = |b: f64| (PI / 8.0).sqrt() * (0.265 * b + 1.194 * b * b + 5.372 * b.powi(22));
        let dry = scale(self.beta_n);
        [self.film.map_or(dry, |film| scale(f64::from(film.roughness))), dry, dry, dry]
    }

    /// Inclination about which each lobe lies.
    pub fn thetas(&self) -> [f64; 4] {
        let alpha = self.alpha.to_radians();
        let first = if self.film.is_some() { 0.0 } else { 2.0 };
        [first, -1.0, -4.0, 0.0].map(|times| {
            let turned = self.theta_o.to_radians() + times * alpha;
            -turned.sin().asin()
        })
    }

    /// Azimuth, against the camera's, about which each lobe lies; the residual lies about none.
    pub fn phis(&self) -> [f64; 4] {
        let (sin, cos) = self.theta_o.to_radians().sin_cos();
        let bent = (self.eta * self.eta - sin * sin).sqrt() / cos;
        if self.aspect < 1.0 {
            let [r, tt, trt] = ellipse_exits(self.aspect, bent, self.phi_o.to_radians(), self.h);
            return [r, tt, trt, 0.0];
        }
        let gamma_i = self.h.asin();
        let gamma_t = (self.h / bent).asin();
        let exit = |p: f64| wrapped(2.0 * p * gamma_t - 2.0 * gamma_i + p * PI);
        [exit(0.0), exit(1.0), exit(2.0), 0.0]
    }

    /// Values of the first channel per lobe in single precision.
    pub fn values_single(&self) -> impl Fn(f64, f64) -> [f64; 4] + use<> {
        let (case, scatter) = (*self, self.single());
        move |theta, phi| {
            let values = scatter.evaluate(single(case.seen(theta, phi)));
            [0, 1, 2, 3].map(|p: usize| f64::from(values.0[p].x))
        }
    }

    /// Values of the first channel per lobe in double precision.
    pub fn values_double(&self) -> impl Fn(f64, f64) -> [f64; 4] + use<> {
        let (case, scatter) = (*self, self.double());
        move |theta, phi| {
            let (values, _) = scatter.evaluate_with_pdf(case.seen(theta, phi));
            [0, 1, 2, 3].map(|p: usize| values[p][0])
        }
    }
}

/// The unit direction of an inclination and an azimuth, in radians.
pub fn direction(theta: f64, phi: f64) -> [f64; 3] {
    let (sin, cos) = theta.sin_cos();
    [sin, cos * phi.cos(), cos * phi.sin()]
}

/// Where R, TT and TRT leave an ellipse of half axes 1 along y and `aspect`, against the viewer's azimuth
/// `phi_o`; `eta` is that of the plane. Found step by step from points and slopes, unlike the model, which
/// goes by way of the circle.
fn ellipse_exits(aspect: f64, eta: f64, phi_o: f64, h: f64) -> [f64; 3] {
    type P = [f64; 2];
    let dot = |a: P, b: P| a[0] * b[0] + a[1] * b[1];
    let (b2, viewer): (f64, P) = (aspect * aspect, [phi_o.cos(), phi_o.sin()]);
    let across = [-viewer[1], viewer[0]];
    let half_width = (across[0] * across[0] + b2 * across[1] * across[1]).sqrt();
    // From far off at the viewer's side, along the line of sight.
    let from = [0, 1].map(|i| 10.0 * viewer[i] - h * half_width * across[i]);
    let meets = |from: P, way: P, last: bool| -> P {
        let (a, b, c) = (
            way[0] * way[0] + way[1] * way[1] / b2,
            from[0] * way[0] + from[1] * way[1] / b2,
            from[0] * from[0] + from[1] * from[1] / b2 - 1.0,
        );
        let root = (b * b - a * c).max(0.0).sqrt();
        let t = if last { (-b + root) / a } else { (-b - root) / a };
        [0, 1].map(|i| from[i] + t * way[i])
    };
    let normal = |at: P| {
        let n = [at[0], at[1] / b2];
        n.map(|x| x / dot(n, n).sqrt())
    };
    // Snell's law in the plane for a ray that goes along `way` through a surface with this normal.
    let bent = |way: P, n: P, ratio: f64| -> P {
        let cos = dot(way, n);
        let inside = (1.0 - ratio * ratio * (1.0 - cos * cos)).max(0.0).sqrt();
        [0, 1].map(|i| ratio * (way[i] - cos * n[i]) + inside * cos.signum() * n[i])
    };
    let mirrored = |way: P, n: P| [0, 1].map(|i| way[i] - 2.0 * dot(way, n) * n[i]);
    let azimuth = |way: P| wrapped(way[1].atan2(way[0]) - phi_o);
    let way = viewer.map(|x| -x);
    let first = meets(from, way, false);
    let inside = bent(way, normal(first), 1.0 / eta);
    let second = meets(first, inside, true);
    let back = mirrored(inside, normal(second));
    let third = meets(second, back, true);
    [
        azimuth(mirrored(way, normal(first))),
        azimuth(bent(inside, normal(second), eta)),
        azimuth(bent(back, normal(third), eta)),
    ]
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
        let around = edges(phi - PI, phi + PI, &[(phi, case.logistic_scales()[p])]);
        let around = integral(&around, parts, |x| values(theta, x)[p]);
        along * (around / middle)
    })
}

/// The standard normal deviate that chi-square of so many degrees of freedom amounts to (Wilson and
/// Hilferty).
pub fn deviate(chi_square: f64, degrees: f64) -> f64 {
    let spread = 2.0 / (9.0 * degrees);
    ((chi_square / degrees).cbrt() - 1.0 + spread) / spread.sqrt()
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
