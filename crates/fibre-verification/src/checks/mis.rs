//! Does it matter how light is sampled? It must not: the estimates agree, whatever draws the directions.

use std::f64::consts::{PI, TAU};

use fibre_scattering::Absorption;
use rayon::prelude::*;

use crate::random::Random;
use crate::scatterer::{Model, Scatterer, View, narrow};
use crate::sphere::{Sphere, wide};
use crate::statistics::Moments;

/// A smooth sky: an even light and some soft lights (von Mises and Fisher's), which can be sampled exactly.
#[derive(Debug, Clone)]
pub struct Sky {
    lights: Vec<Light>,
    even: f64,
}

#[derive(Debug, Clone, Copy)]
struct Light {
    toward: [f64; 3],
    sharpness: f64,
    power: f64,
}

/// Directions a thread draws at a time.
const BLOCK: u64 = 1 << 13;

impl Sky {
    /// Four soft lights of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Sky {
        let mut random = Random::new(seed, 0x5c4);
        let lights = (0..4).map(|_| {
            let (x, phi) = (2.0 * random.fine() - 1.0, TAU * random.fine());
            let around = (1.0 - x * x).sqrt();
            let sharpness = 1.0 + 15.0 * random.fine();
            let power = 0.5 + random.fine();
            Light { toward: [x, around * phi.cos(), around * phi.sin()], sharpness, power }
        });
        Sky { lights: lights.collect(), even: 1.0 }
    }

    fn power(&self) -> f64 {
        self.even + self.lights.iter().map(|light| light.power).sum::<f64>()
    }

    /// Radiance from a direction; `power` over 4 pi on average.
    #[must_use]
    pub fn radiance(&self, wi: [f64; 3]) -> f64 {
        let lights = self.lights.iter().map(|light| light.power * light.density(wi));
        self.even / (4.0 * PI) + lights.sum::<f64>()
    }

    /// Density of directions drawn from the sky: in proportion to the radiance.
    #[must_use]
    pub fn pdf(&self, wi: [f64; 3]) -> f64 {
        self.radiance(wi) / self.power()
    }

    fn sample(&self, random: &mut Random) -> [f64; 3] {
        let mut left = random.fine() * self.power();
        let (u, v) = (random.fine(), random.fine());
        for light in &self.lights {
            if left < light.power {
                return light.sample(u, v);
            }
            left -= light.power;
        }
        let x = 2.0 * u - 1.0;
        let around = (1.0 - x * x).max(0.0).sqrt();
        [x, around * (TAU * v).cos(), around * (TAU * v).sin()]
    }
}

impl Light {
    fn density(&self, wi: [f64; 3]) -> f64 {
        let k = self.sharpness;
        let cos: f64 = self.toward.iter().zip(wi).map(|(a, b)| a * b).sum();
        k * (k * (cos - 1.0)).exp() / (TAU * -(-2.0 * k).exp_m1())
    }

    fn sample(&self, u: f64, v: f64) -> [f64; 3] {
        let k = self.sharpness;
        let cos = 1.0 + (u * (-2.0 * k).exp_m1()).ln_1p() / k;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let along = glam::DVec3::from_array(self.toward);
        let (a, b) = along.any_orthonormal_pair();
        (along * cos + (a * (TAU * v).cos() + b * (TAU * v).sin()) * sin).to_array()
    }
}

/// Light that reaches the eye from one fibre, estimated in each way. The mean of the three channels.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Estimates {
    /// By quadrature.
    pub exact: f64,
    /// Directions from the light alone.
    pub light: Moments,
    /// From the fibre alone.
    pub fibre: Moments,
    /// One from each, weighted by the balance heuristic (Veach 1997).
    pub balance: Moments,
    /// One from each, weighted by the power heuristic.
    pub power: Moments,
    /// Effective number of light samples: how many equal ones would tell as much.
    pub light_effective: f64,
}

impl Estimates {
    /// Names and moments of all ways.
    #[must_use]
    pub fn ways(&self) -> [(&'static str, Moments); 4] {
        [("light", self.light), ("fibre", self.fibre), ("balance", self.balance), ("power", self.power)]
    }

    /// Standard errors by which a way is off the exact value, less `slack` of that value.
    #[must_use]
    pub fn deviate(&self, way: &Moments, slack: f64) -> f64 {
        let beyond = ((way.mean - self.exact).abs() - slack * self.exact).max(0.0);
        if beyond == 0.0 { 0.0 } else { beyond / way.standard_error().max(1e-300) }
    }
}

/// Estimates the light of `sky` by `count` directions each way.
#[must_use]
pub fn estimates(
    model: &dyn Model,
    view: View,
    absorption: Absorption,
    sky: &Sky,
    count: u64,
    seed: u64,
) -> Estimates {
    let scatterer = model.at(view, absorption);
    let sphere = Sphere::new(&model.landmarks(view));
    let cells = sphere.masses(|wi| mean(&*scatterer, wi).0 * sky.radiance(wi));
    let parts: Vec<Sums> = (0..count.div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            estimate(
                &*scatterer,
                sky,
                BLOCK.min(count - block * BLOCK),
                Random::new(seed, 0x315_0000 + block),
            )
        })
        .collect();
    let sums = parts.into_iter().fold(Sums::default(), Sums::joined);
    let (sum, squares) = sums.light_weights;
    Estimates {
        exact: cells.iter().sum(),
        light: sums.ways[0],
        fibre: sums.ways[1],
        balance: sums.ways[2],
        power: sums.ways[3],
        light_effective: if squares > 0.0 { sum * sum / squares } else { 0.0 },
    }
}

#[derive(Default)]
struct Sums {
    ways: [Moments; 4],
    light_weights: (f64, f64),
}

impl Sums {
    fn joined(self, other: Sums) -> Sums {
        let ways = [0, 1, 2, 3].map(|way: usize| self.ways[way].joined(other.ways[way]));
        let (a, b) = (self.light_weights, other.light_weights);
        Sums { ways, light_weights: (a.0 + b.0, a.1 + b.1) }
    }
}

/// Mean of the channels and the density, in single precision's numbers.
fn mean(scatterer: &dyn Scatterer, wi: [f64; 3]) -> (f64, f64) {
    let (lobes, pdf) = wide(scatterer, wi);
    (lobes.as_flattened().iter().sum::<f64>() / 3.0, pdf)
}

fn estimate(scatterer: &dyn Scatterer, sky: &Sky, count: u64, mut random: Random) -> Sums {
    let mut sums = Sums::default();
    for _ in 0..count {
        let toward_light = narrow(sky.sample(&mut random)).as_dvec3().to_array();
        let (value, fibre_pdf) = mean(scatterer, toward_light);
        let (radiance, light_pdf) = (sky.radiance(toward_light), sky.pdf(toward_light));
        let light = value * radiance / light_pdf;
        let (balance_a, power_a) = shares(light_pdf, fibre_pdf);

        let drawn = scatterer.sample(random.four());
        let (mut fibre, mut balance_b, mut power_b) = (0.0, 0.0, 0.0);
        if let Some(sample) = drawn {
            let wi = sample.wi.as_dvec3().to_array();
            let value = f64::from(sample.values.sum().element_sum()) / 3.0;
            fibre = value * sky.radiance(wi) / f64::from(sample.pdf);
            (balance_b, power_b) = shares(f64::from(sample.pdf), sky.pdf(wi));
        }
        let found = [light, fibre, light * balance_a + fibre * balance_b, light * power_a + fibre * power_b];
        for (moments, value) in sums.ways.iter_mut().zip(found) {
            moments.push(value);
        }
        sums.light_weights.0 += light;
        sums.light_weights.1 += light * light;
    }
    sums
}

/// What the balance and the power heuristic give to a direction drawn with the density `mine`.
fn shares(mine: f64, other: f64) -> (f64, f64) {
    (mine / (mine + other), mine * mine / (mine * mine + other * other))
}
