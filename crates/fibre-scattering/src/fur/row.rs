//! One row of a medulla's table: what became of the walks of one ray.

use crate::fur::counts::Counts;
use crate::fur::density::{Density, smoothed};
use crate::fur::grid::{AROUND, STEP_AROUND, nearest_knot, ray_of_row};
use crate::fur::paths::{NODES, PathNode, path_nodes};
use crate::fur::table::MedullaKey;
use crate::fur::walk::{Exit, Numbers, Walker};

/// Walks are told apart by the length of their path, so that what is absorbed more may also leave elsewhere.
pub(crate) const CLASSES: usize = 4;

/// The part of the walks in each class, from the shortest paths to the longest. Sums
/// of powers of two: they sum to exactly 1.
pub(crate) const CLASS_SHARES: [f64; CLASSES] = [0.3125, 0.3125, 0.25, 0.125];

/// One row of a [`MedullaTable`](crate::MedullaTable): where walks along one ray left the fibre, and by how
/// long a path.
#[derive(Debug, Clone, PartialEq)]
pub struct MedullaRow {
    /// Where each class goes.
    pub(crate) counts: Box<Counts>,
    /// The paths of each class.
    pub(crate) nodes: [[PathNode; NODES]; CLASSES],
}

impl MedullaRow {
    /// Walks the row's ray; `key` has passed its check.
    pub(crate) fn walk(key: &MedullaKey, row: usize) -> MedullaRow {
        let mut exits = exits(key, row);
        // Bits of numbers that are not negative rise as they do.
        exits.sort_by_cached_key(|exit| length(exit).to_bits());
        let (offset, inclination) = ray_of_row(row);
        let symmetric = [offset == 0.0, inclination == 0.0];
        let mut nodes = [[PathNode::default(); NODES]; CLASSES];
        let mut densities: [Density; CLASSES] = Default::default();
        for (class, exits) in split(&exits, &CLASS_SHARES).into_iter().enumerate() {
            densities[class] = smoothed(exits.iter().map(cell), symmetric);
            nodes[class] = path_nodes(exits);
        }
        MedullaRow { counts: Box::new(Counts::of_densities(densities)), nodes }
    }
}

/// Walks for each row by default: what a 2-core machine does in about 1.5 seconds for a whole table. A walk
/// takes about five crossings and, after the mean path through a cylinder that light is caught in, some
/// `5 sigma_s kappa^2` scatterings.
pub(crate) fn default_walks(key: &MedullaKey) -> u32 {
    let scatterings = 5.0 * f64::from(key.sigma_s) * f64::from(key.kappa).powi(2);
    (750_000.0 / (8.0 + scatterings)) as u32
}

fn exits(key: &MedullaKey, row: usize) -> Vec<Exit> {
    let walker = Walker::new(key);
    let entry = walker.entry_of_row(row);
    let walks = if key.walks == 0 { default_walks(key) } else { key.walks };
    // The first scattering of all walks is spread evenly: multiples of powers of the root of
    // x^4 = x + 1, the three-dimensional golden ratio.
    const EVENLY: [f64; 3] = [0.819_172_513_396_164, 0.671_043_606_703_789_2, 0.549_700_477_901_970_2];
    let mut own = Numbers::new(row, u32::MAX);
    let start = EVENLY.map(|_| f64::from(own.next()));
    (0..walks)
        .map(|walk| {
            let spread = |axis: usize| {
                let u = (start[axis] + f64::from(walk) * EVENLY[axis]).fract() as f32;
                u.min(1.0 - f32::EPSILON)
            };
            walker.walk(&entry, [spread(0), spread(1), spread(2)], &mut Numbers::new(row, walk))
        })
        .collect()
}

fn length(exit: &Exit) -> f32 {
    exit.cortex + exit.medulla
}

/// The entry whose knot is next to an exit.
fn cell(exit: &Exit) -> usize {
    let around = (f64::from(exit.azimuth) / STEP_AROUND).round().rem_euclid(AROUND as f64) as usize;
    nearest_knot(f64::from(exit.sin_theta)) * AROUND + around % AROUND
}

/// A slice cut into parts of these shares.
fn split<'a, T>(all: &'a [T], shares: &[f64]) -> Vec<&'a [T]> {
    let mut parts = Vec::with_capacity(shares.len());
    let (mut rest, mut taken, mut sum) = (all, 0, 0.0);
    for share in shares {
        sum += share;
        let end = ((sum * all.len() as f64).round() as usize).clamp(taken, all.len());
        let (part, after) = rest.split_at(end - taken);
        parts.push(part);
        (rest, taken) = (after, end);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_absorb_as_the_walks_do() {
        let key = MedullaKey {
            kappa: 0.86,
            sigma_s: 3.15,
            g: 0.79,
            eta: 1.49,
            cuticle_layers: None,
            film_eta: None,
            walks: 5000,
        };
        for (row, [cortex, medulla]) in [0, 5, 47, 79].into_iter().flat_map(|row| {
            [[0.4, 0.0], [0.0, 0.4], [2.0, 0.0], [0.4, 0.2], [0.0, 2.0]].map(|sigma| (row, sigma))
        }) {
            let passed = |in_cortex: f32, in_medulla: f32| {
                (-cortex * f64::from(in_cortex) - medulla * f64::from(in_medulla)).exp()
            };
            let exits = exits(&key, row);
            let walked =
                exits.iter().map(|exit| passed(exit.cortex, exit.medulla)).sum::<f64>() / exits.len() as f64;
            let mut found = 0.0;
            for (class, share) in MedullaRow::walk(&key, row).nodes.iter().zip(CLASS_SHARES) {
                for node in class {
                    found += share * f64::from(node.share) * passed(node.cortex, node.medulla);
                }
            }
            assert!((found - walked).abs() < 0.004, "{row} {cortex} {medulla}: {found} {walked}");
        }
    }
}
