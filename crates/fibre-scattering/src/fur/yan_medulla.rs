//! Light scattered by a bare cylinder: the distributions C^N, C^M and C^dist that Yan et al. 2017 keep in
//! tables, walked for one material.

use std::f64::consts::TAU;

use crate::fur::medulla::Medulla;
use crate::fur::walk::{Numbers, Photon, boundary};

const INCLINATIONS: usize = 8;
const OFFSETS: usize = 12;
const AROUND: usize = 72;
const ALONG: usize = 40;

/// What comes out of the medulla, in radii of it.
#[derive(Debug, Clone)]
pub(crate) struct YanMedulla {
    /// For each inclination and offset the density of azimuths, per radian.
    around: Vec<[f64; AROUND]>,
    /// And the mean path of light that was scattered.
    path: Vec<f64>,
    /// For each inclination the density of sines, of light that leaves backward and forward.
    along: Vec<[[f64; ALONG]; 2]>,
}

struct Escape {
    /// Azimuth against the way the light went, and sine of the inclination.
    azimuth: f64,
    sin_theta: f64,
    path: f64,
}

impl YanMedulla {
    /// `walks` for each inclination and offset.
    pub fn walk(medulla: &Medulla, eta: f64, walks: u32) -> Self {
        // In radii of the medulla.
        let sigma = f64::from(medulla.sigma_s) * f64::from(medulla.kappa);
        let mut found = YanMedulla { around: Vec::new(), path: Vec::new(), along: Vec::new() };
        for i in 0..INCLINATIONS {
            let sin_theta = i as f64 / (INCLINATIONS - 1) as f64;
            let stretch = 1.0 / (1.0 - (sin_theta / eta).powi(2)).sqrt();
            let mut along = [[0.0; ALONG]; 2];
            for j in 0..OFFSETS {
                let offset = (j as f64 / OFFSETS as f64).min(0.999);
                let mut around = [0.0; AROUND];
                let mut path = 0.0;
                for walk in 0..walks {
                    let mut numbers = Numbers::new(i * OFFSETS + j, walk);
                    // C^N and C^dist are of light across the cylinder, its medium denser for a slanted path.
                    let across = escape(sigma * stretch, medulla.g, offset, 0.0, &mut numbers);
                    around[bin(across.azimuth / TAU, AROUND)] += 1.0;
                    path += across.path;
                    // C^M is of slanted light, whatever its offset.
                    let slanted = escape(sigma, medulla.g, offset, sin_theta.min(0.999), &mut numbers);
                    let forward = usize::from(slanted.azimuth.cos() > 0.0);
                    along[forward][bin(0.5 * (slanted.sin_theta + 1.0), ALONG)] += 1.0;
                }
                normalise(&mut around, TAU);
                found.around.push(around);
                found.path.push(path / f64::from(walks.max(1)));
            }
            along.iter_mut().for_each(|side| normalise(side, 2.0));
            found.along.push(along);
        }
        found
    }

    /// Mean path in the medulla, of light at an offset in its radii.
    pub fn path(&self, offset: f64, sin_theta: f64) -> f64 {
        self.path[cell(offset, sin_theta)]
    }

    /// C^N: the density, per radian, of an azimuth against where the light came from.
    pub fn around(&self, offset: f64, sin_theta: f64, azimuth: f64) -> f64 {
        // Rows are for positive offsets; the others are mirror images. The way light goes is half a turn from
        // where it came from.
        let azimuth = if offset < 0.0 { -azimuth } else { azimuth };
        self.around[cell(offset, sin_theta)][bin((azimuth / TAU + 0.5).rem_euclid(1.0), AROUND)]
    }

    /// C^M: the density of a sine; `away` is 0 for light that leaves to where it came from, 1 for light that
    /// goes on.
    pub fn along(&self, sin_theta: f64, away: f64, sin_theta_i: f64) -> f64 {
        let [backward, forward] = &self.along[inclination(sin_theta)];
        let sin = if sin_theta < 0.0 { -sin_theta_i } else { sin_theta_i };
        let bin = bin(0.5 * (sin + 1.0), ALONG);
        (1.0 - away) * backward[bin] + away * forward[bin]
    }
}

fn inclination(sin_theta: f64) -> usize {
    ((sin_theta.abs() * (INCLINATIONS - 1) as f64).round() as usize).min(INCLINATIONS - 1)
}

fn cell(offset: f64, sin_theta: f64) -> usize {
    let offset = ((offset.abs() * OFFSETS as f64).round() as usize).min(OFFSETS - 1);
    inclination(sin_theta) * OFFSETS + offset
}

/// The bin of a part in [0, 1].
fn bin(part: f64, bins: usize) -> usize {
    ((part.rem_euclid(1.0) * bins as f64) as usize).min(bins - 1)
}

/// Makes counts a density over a range.
fn normalise(counts: &mut [f64], range: f64) {
    let sum: f64 = counts.iter().sum();
    let height = counts.len() as f64 / range;
    for count in counts.iter_mut() {
        *count = if sum > 0.0 { *count / sum * height } else { 1.0 / range };
    }
}

/// Light that is scattered at least once in a cylinder of radius 1, and leaves it without a boundary.
fn escape(sigma: f64, g: f32, offset: f64, sin_theta: f64, numbers: &mut Numbers) -> Escape {
    let cos_theta = (1.0 - sin_theta * sin_theta).sqrt();
    let half = (1.0 - offset * offset).sqrt();
    let chord = 2.0 * half / cos_theta;
    let caught = -(-sigma * chord).exp_m1();
    let first = (-(-f64::from(numbers.next()) * caught).ln_1p() / sigma).min(chord);
    let mut photon = Photon::new([-sin_theta as f32, cos_theta as f32, 0.0]);
    photon.place(offset as f32, cos_theta as f32, (first * cos_theta - half) as f32);
    let mut path = first;
    loop {
        photon.scatter(g, numbers);
        let free = -f64::from(1.0 - numbers.next()).ln() / sigma;
        let leave = f64::from(boundary(1.0, photon.at, [photon.way[1], photon.way[2]]));
        path += free.min(leave);
        if free >= leave {
            let [x, y, z] = photon.way.map(f64::from);
            return Escape { azimuth: z.atan2(y), sin_theta: x.clamp(-1.0, 1.0), path };
        }
        photon.advance(free as f32);
    }
}
