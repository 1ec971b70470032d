//! A great many directions drawn, and what is told of them.

use rayon::prelude::*;

use crate::random::Random;
use crate::scatterer::{Scatterer, angles, widened};
use crate::sphere::Sphere;
use crate::statistics::Moments;

/// Directions a thread draws at a time; each such block has its own random numbers, so that the number of
/// threads changes nothing.
const BLOCK: u64 = 1 << 14;

/// What a great many draws found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Draws {
    /// How many were asked for.
    pub asked: u64,
    /// How many were given.
    pub given: u64,
    /// How many fell into each cell of the sphere.
    pub cells: Vec<u64>,
    /// Value over density, per channel; draws that gave nothing count as 0.
    pub weight: [Moments; 3],
    /// The largest of them.
    pub largest_weight: f64,
    /// Draws whose values or density are not what evaluation says of their direction, to the bit.
    pub inconsistent: u64,
    /// Draws with a number that is not finite, or a direction that is not of length 1.
    pub broken: u64,
}

/// Draws `count` directions.
#[must_use]
pub fn draw(scatterer: &dyn Scatterer, sphere: &Sphere, count: u64, seed: u64) -> Draws {
    let blocks = count.div_ceil(BLOCK);
    let parts: Vec<Draws> = (0..blocks)
        .into_par_iter()
        .map(|block| draw_block(scatterer, sphere, BLOCK.min(count - block * BLOCK), seed, block))
        .collect();
    parts.into_iter().fold(Draws::empty(sphere), Draws::joined)
}

fn draw_block(scatterer: &dyn Scatterer, sphere: &Sphere, count: u64, seed: u64, block: u64) -> Draws {
    let mut random = Random::new(seed, block);
    let mut draws = Draws { asked: count, ..Draws::empty(sphere) };
    for _ in 0..count {
        let Some(sample) = scatterer.sample(random.four()) else {
            draws.weight.iter_mut().for_each(|weight| weight.push(0.0));
            continue;
        };
        draws.given += 1;
        let weight = sample.weight();
        let sound = weight.is_finite() && sample.pdf > 0.0 && (sample.wi.length() - 1.0).abs() < 1e-5;
        if !sound {
            draws.broken += 1;
            continue;
        }
        let (values, pdf) = scatterer.evaluate_with_pdf(sample.wi);
        draws.inconsistent += u64::from((values, pdf) != (sample.values, sample.pdf));
        for (moments, weight) in draws.weight.iter_mut().zip(weight.to_array()) {
            moments.push(f64::from(weight));
        }
        draws.largest_weight = draws.largest_weight.max(f64::from(weight.max_element()));
        draws.cells[sphere.cell(angles(widened(sample.wi)))] += 1;
    }
    draws
}

impl Draws {
    fn empty(sphere: &Sphere) -> Draws {
        Draws { cells: vec![0; sphere.cells()], ..Draws::default() }
    }

    fn joined(mut self, other: Draws) -> Draws {
        self.asked += other.asked;
        self.given += other.given;
        self.inconsistent += other.inconsistent;
        self.broken += other.broken;
        self.largest_weight = self.largest_weight.max(other.largest_weight);
        for (mine, theirs) in self.cells.iter_mut().zip(other.cells) {
            *mine += theirs;
        }
        for (mine, theirs) in self.weight.iter_mut().zip(other.weight) {
            *mine = mine.joined(theirs);
        }
        self
    }
}
