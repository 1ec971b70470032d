//! Integrals over all directions.

use std::f64::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;

use crate::landmarks::{Landmarks, wrapped};
use crate::quadrature::{GAUSS, GAUSS_OF_FOUR, nodes_of, panels};
use crate::scatterer::{DoubleScatterer, Scatterer, narrow};

/// The sphere in panels of inclination and azimuth, dense where the lobes are.
#[derive(Debug, Clone)]
pub struct Sphere {
    along: Vec<f64>,
    around: Vec<f64>,
    /// Abscissae and weights on a panel.
    rule: &'static [(f64, f64)],
}

/// What is integrated: five lobes in three channels and the density.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Integrals {
    /// Of f cos(theta_i), per lobe and channel: the albedo.
    pub lobes: [[f64; 3]; 5],
    /// Of the density.
    pub pdf: f64,
}

impl Integrals {
    /// All lobes, per channel.
    #[must_use]
    pub fn total(&self) -> [f64; 3] {
        [0, 1, 2].map(|channel| self.lobes.iter().map(|lobe| lobe[channel]).sum())
    }

    fn add(&mut self, weight: f64, (lobes, pdf): &([[f64; 3]; 5], f64)) {
        for (sum, value) in self.lobes.iter_mut().zip(lobes) {
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum += weight * value;
            }
        }
        self.pdf += weight * pdf;
    }
}

impl Sphere {
    /// Panels for lobes that lie at `landmarks`.
    #[must_use]
    pub fn new(landmarks: &Landmarks) -> Sphere {
        let mut kinks: Vec<f64> = landmarks.around_kinks.iter().map(|&phi| wrapped(phi)).collect();
        kinks.push(0.0);
        Sphere {
            along: panels(-FRAC_PI_2, FRAC_PI_2, &landmarks.along, &landmarks.along_kinks),
            around: panels(-PI, PI, &landmarks.around_turned(), &kinks),
            rule: &GAUSS,
        }
    }

    /// Each panel cut in so many: for functions with the noise of rounded directions.
    #[must_use]
    pub fn refined(&self, parts: u32) -> Sphere {
        let cut = |edges: &[f64]| {
            let mut finer: Vec<f64> = edges
                .windows(2)
                .flat_map(|pair| {
                    let (low, step) = (pair[0], (pair[1] - pair[0]) / f64::from(parts));
                    (0..parts).map(move |part| low + step * f64::from(part))
                })
                .collect();
            finer.extend(edges.last());
            finer
        };
        Sphere { along: cut(&self.along), around: cut(&self.around), rule: self.rule }
    }

    /// Four times the cells at the same cost, and still a rule of four on each: for counting samples in them.
    #[must_use]
    pub fn for_counting(&self) -> Sphere {
        Sphere { rule: &GAUSS_OF_FOUR, ..self.refined(2) }
    }

    /// How many cells there are.
    #[must_use]
    pub fn cells(&self) -> usize {
        (self.along.len() - 1) * (self.around.len() - 1)
    }

    /// The cell in which a direction lies.
    #[must_use]
    pub fn cell(&self, (theta, phi): (f64, f64)) -> usize {
        let place = |edges: &[f64], x| edges.partition_point(|&edge| edge <= x).clamp(1, edges.len() - 1) - 1;
        place(&self.along, theta) * (self.around.len() - 1) + place(&self.around, phi)
    }

    /// Sums over all azimuths of what belongs to cells.
    #[must_use]
    pub fn rows(&self, cells: &[f64]) -> Vec<f64> {
        cells.chunks(self.around.len() - 1).map(|row| row.iter().sum()).collect()
    }

    /// Sums over all inclinations.
    #[must_use]
    pub fn columns(&self, cells: &[f64]) -> Vec<f64> {
        let count = self.around.len() - 1;
        (0..count).map(|column| cells.iter().skip(column).step_by(count).sum()).collect()
    }

    /// The integral of a function of direction over each cell, given its sum over a cell's nodes.
    fn cells_of<T: Send>(
        &self,
        zero: impl Fn() -> T + Sync,
        add: impl Fn(&mut T, f64, [f64; 3]) + Sync,
    ) -> Vec<T> {
        // Cosines and sines of all azimuths once.
        let columns: Vec<Vec<(f64, f64, f64)>> = self
            .around
            .windows(2)
            .map(|pair| {
                nodes_of(self.rule, pair[0], pair[1]).map(|(phi, w)| (phi.cos(), phi.sin(), w)).collect()
            })
            .collect();
        let rows: Vec<Vec<T>> = self
            .along
            .par_windows(2)
            .map(|pair| {
                let thetas: Vec<_> = nodes_of(self.rule, pair[0], pair[1])
                    .map(|(theta, w)| (theta.sin(), theta.cos(), w))
                    .collect();
                let column = |azimuths: &Vec<(f64, f64, f64)>| {
                    let mut sum = zero();
                    for &(sin, cos, weight) in &thetas {
                        for &(y, z, w) in azimuths {
                            add(&mut sum, weight * w * cos, [sin, cos * y, cos * z]);
                        }
                    }
                    sum
                };
                columns.iter().map(column).collect()
            })
            .collect();
        rows.into_iter().flatten().collect()
    }

    /// Integrals of the single precision path. The result does not depend on the number of threads.
    #[must_use]
    pub fn single(&self, scatterer: &dyn Scatterer) -> Integrals {
        total(self.cells_of(Integrals::default, |sum, weight, wi| sum.add(weight, &wide(scatterer, wi))))
    }

    /// Integrals of the double precision path.
    #[must_use]
    pub fn double(&self, scatterer: &dyn DoubleScatterer) -> Integrals {
        total(self.cells_of(Integrals::default, |sum, weight, wi| {
            sum.add(weight, &scatterer.evaluate_with_pdf(wi));
        }))
    }

    /// The density's integral over each cell, and anything else's: `f` of a direction.
    #[must_use]
    pub fn masses(&self, f: impl Fn([f64; 3]) -> f64 + Sync) -> Vec<f64> {
        self.cells_of(|| 0.0, |sum, weight, wi| *sum += weight * f(wi))
    }
}

fn total(cells: Vec<Integrals>) -> Integrals {
    let mut total = Integrals::default();
    for cell in cells {
        total.add(1.0, &(cell.lobes, cell.pdf));
    }
    total
}

/// Single precision's answer, in numbers that add up well.
pub(crate) fn wide(scatterer: &dyn Scatterer, wi: [f64; 3]) -> ([[f64; 3]; 5], f64) {
    let (values, pdf) = scatterer.evaluate_with_pdf(narrow(wi));
    (values.0.map(|value| value.as_dvec3().to_array()), f64::from(pdf))
}
