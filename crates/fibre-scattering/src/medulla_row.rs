//! One row of a medulla's table: what became of the walks of one ray.

use crate::medulla_density::{Density, smoothed};
use crate::medulla_grid::{AROUND, CELLS, STEP_ALONG, STEP_AROUND, ray_of_row};
use crate::medulla_table::MedullaKey;
use crate::medulla_walk::{Exit, Numbers, Walker};

/// Walks are told apart by the length of their path, so that what is absorbed more may also leave elsewhere.
pub(crate) const CLASSES: usize = 4;

/// The part of the walks in each class, from the shortest paths to the longest. They and
/// [`NODE_SHARES`] are sums of powers of two: their sums are exactly 1.
pub(crate) const CLASS_SHARES: [f64; CLASSES] = [0.3125, 0.3125, 0.25, 0.125];

/// Pairs of path lengths that stand for those of a class.
pub(crate) const NODES: usize = 8;

/// The part of a class that each node stands for: four groups by length of path, each cut in two by how
/// much of it lies in the medulla. The last class has a long tail, and smaller groups towards its end.
pub(crate) const NODE_SHARES: [[f64; NODES]; CLASSES] = [EVEN, EVEN, EVEN, TAIL];
const EVEN: [f64; NODES] = [0.125; NODES];
const TAIL: [f64; NODES] = [0.1875, 0.1875, 0.15625, 0.15625, 0.09375, 0.09375, 0.0625, 0.0625];

/// One row of a [`MedullaTable`](crate::MedullaTable): where walks along one ray left the fibre, and by how
/// long a path.
#[derive(Debug, Clone, PartialEq)]
pub struct MedullaRow {
    /// For each entry the sum of the class's masses up to it, in 65536ths of the class; the last, which
    /// is all of it, is 0.
    pub(crate) cumulative: Vec<[u16; CLASSES]>,
    /// Lengths in cortex and medulla, in fibre radii, class by class.
    pub(crate) nodes: [[[f32; 2]; NODES]; CLASSES],
}

impl MedullaRow {
    /// Walks the row's ray; `key` has passed its check.
    pub(crate) fn walk(key: &MedullaKey, row: usize) -> MedullaRow {
        let mut exits = exits(key, row);
        exits.sort_by(|a, b| length(a).total_cmp(&length(b)));
        let (offset, inclination) = ray_of_row(row);
        let symmetric = [offset == 0.0, inclination == 0.0];
        let mut cumulative = vec![[0; CLASSES]; CELLS];
        let mut nodes = [[[0.0; 2]; NODES]; CLASSES];
        for (class, exits) in split(&exits, &CLASS_SHARES).into_iter().enumerate() {
            let density = smoothed(exits.iter().map(cell), symmetric);
            accumulate(&density, class, &mut cumulative);
            nodes[class] = path_nodes(exits, &NODE_SHARES[class]);
        }
        MedullaRow { cumulative, nodes }
    }
}

/// Walks for each row by default: what a 2-core machine does in about 1.5 seconds for a whole table. A walk
/// takes about five crossings and, after the mean path through a cylinder that light is caught in, some
/// `5 sigma_s kappa^2` scatterings.
pub(crate) fn default_walks(key: &MedullaKey) -> u32 {
    let scatterings = 5.0 * f64::from(key.sigma_s) * f64::from(key.kappa).powi(2);
    (900_000.0 / (8.0 + scatterings)) as u32
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
    let along = ((f64::from(exit.sin_theta) + 1.0) / STEP_ALONG).round() as usize;
    (along * AROUND + around % AROUND).min(CELLS - 1)
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

/// Few pairs of lengths that absorb as the many of `exits`, sorted by length, do.
fn path_nodes(exits: &[Exit], shares: &[f64; NODES]) -> [[f32; 2]; NODES] {
    let mut nodes = [[0.0; 2]; NODES];
    let groups: Vec<f64> = shares.chunks(2).map(|pair| pair.iter().sum()).collect();
    for (group, exits) in split(exits, &groups).into_iter().enumerate() {
        let mut exits = exits.to_vec();
        let scattered_part = |exit: &Exit| exit.medulla / length(exit).max(f32::MIN_POSITIVE);
        exits.sort_by(|a, b| scattered_part(a).total_cmp(&scattered_part(b)));
        for (half, exits) in split(&exits, &[0.5, 0.5]).into_iter().enumerate() {
            nodes[2 * group + half] = path_node(exits);
        }
    }
    nodes
}

/// The mean path, shortened to absorb as much as the paths do where one in e passes: the mean itself
/// would absorb too much everywhere (Jensen's inequality).
fn path_node(exits: &[Exit]) -> [f32; 2] {
    let count = exits.len().max(1) as f64;
    let mean = |value: &dyn Fn(&Exit) -> f64| exits.iter().map(value).sum::<f64>() / count;
    let lengths = [mean(&|exit| f64::from(exit.cortex)), mean(&|exit| f64::from(exit.medulla))];
    let whole = lengths[0] + lengths[1];
    if whole <= 0.0 {
        return [0.0; 2];
    }
    let passed = mean(&|exit| (-f64::from(length(exit)) / whole).exp());
    lengths.map(|length| (-passed.ln() * length) as f32)
}

/// Sums of the masses of a class, in 65536ths.
fn accumulate(density: &Density, class: usize, cumulative: &mut [[u16; CLASSES]]) {
    let total: f64 = density.iter().map(|&mass| f64::from(mass)).sum();
    let mut sum = 0.0;
    for (entry, &mass) in density.iter().enumerate() {
        sum += f64::from(mass);
        let share = if total > 0.0 { sum / total } else { (entry + 1) as f64 / CELLS as f64 };
        // The full sum, which is written as 0, belongs to the last entry alone; which must not have all of
        // it, or that would look like nothing.
        let least = if entry + 2 >= CELLS { 1.0 } else { 0.0 };
        let upto = (share * 65536.0).round().clamp(least, 65535.0);
        cumulative[entry][class] = if entry + 1 == CELLS { 0 } else { upto as u16 };
    }
}
