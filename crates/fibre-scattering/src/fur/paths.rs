//! A few paths that absorb as many do.
//!
//! What is left of light is the mean of `exp(-sigma_c l_c - sigma_m l_m)` over all walks. A mean path in
//! its place absorbs too much (Jensen's inequality): twice too much where most is absorbed. Eight paths
//! for each class of walks, laid where the lengths differ most in proportion, are within a per cent.

use crate::fur::walk::Exit;

/// Paths that stand for those of a class.
pub(crate) const NODES: usize = 8;

/// A path that stands for others.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PathNode {
    /// Length in the cortex, in fibre radii.
    pub cortex: f32,
    /// Length in the medulla.
    pub medulla: f32,
    /// The part of its class it stands for, a multiple of 1/4096; those of a class sum to exactly 1.
    pub share: f32,
}

/// Shares are multiples of one over this.
pub(crate) const SHARES: f32 = 4096.0;

/// Lengths by logarithms of these: differences of shorter ones matter less. In fibre radii.
const SHORT: f64 = 0.1;

/// Of more walks only so many are looked at, evenly.
const ENOUGH: usize = 4096;

/// Few paths that absorb as those of `exits`, sorted by length, do.
pub(crate) fn path_nodes(exits: &[Exit]) -> [PathNode; NODES] {
    let step = (exits.len() / ENOUGH).max(1);
    let mut groups = vec![Group::new(exits.iter().step_by(step).copied().collect())];
    while groups.len() < NODES {
        let worst = (0..groups.len()).max_by(|&a, &b| groups[a].error().total_cmp(&groups[b].error()));
        let Some((low, high)) = worst.and_then(|worst| groups.swap_remove(worst).split()) else { break };
        groups.extend([low, high]);
    }
    let mut nodes = [PathNode::default(); NODES];
    let (mut count, mut before) = (0, 0.0);
    let all = groups.iter().map(|group| group.exits.len()).sum::<usize>().max(1);
    for (node, group) in nodes.iter_mut().zip(&groups) {
        count += group.exits.len();
        let upto = (count as f64 / all as f64 * f64::from(SHARES)).round() as f32;
        let [cortex, medulla] = [length_in_cortex, length_in_medulla].map(|length| group.length(length));
        *node = PathNode { cortex, medulla, share: (upto - before) / SHARES };
        before = upto;
    }
    nodes
}

fn length_in_cortex(exit: &Exit) -> f64 {
    f64::from(exit.cortex)
}

fn length_in_medulla(exit: &Exit) -> f64 {
    f64::from(exit.medulla)
}

/// Walks that one node will stand for.
struct Group {
    exits: Vec<Exit>,
    /// Mean and variance of the logarithms of the lengths, in cortex and medulla.
    spreads: [(f64, f64); 2],
}

impl Group {
    fn new(exits: Vec<Exit>) -> Self {
        let spreads = [length_in_cortex, length_in_medulla].map(|length| spread(&exits, length));
        Group { exits, spreads }
    }

    /// How much one node would be wrong: nearly half the variance, where the absorption is that which tells
    /// most.
    fn error(&self) -> f64 {
        let [(_, cortex), (_, medulla)] = self.spreads;
        self.exits.len() as f64 * cortex.max(medulla)
    }

    /// In two, at the mean of what differs more; nothing where all are alike.
    fn split(self) -> Option<(Group, Group)> {
        let [(cortex, in_cortex), (medulla, in_medulla)] = self.spreads;
        let (low, high): (Vec<_>, Vec<_>) = self.exits.into_iter().partition(|exit| {
            if in_cortex >= in_medulla {
                logarithm(length_in_cortex(exit)) < cortex
            } else {
                logarithm(length_in_medulla(exit)) < medulla
            }
        });
        Some((Group::new(low), Group::new(high)))
    }

    /// The length that absorbs as the group's do, where of the mean one part in e is left.
    fn length(&self, length: impl Fn(&Exit) -> f64) -> f32 {
        let count = self.exits.len().max(1) as f64;
        let mean = self.exits.iter().map(&length).sum::<f64>() / count;
        if mean <= 0.0 {
            return 0.0;
        }
        let passed = self.exits.iter().map(|exit| (-length(exit) / mean).exp()).sum::<f64>() / count;
        (-passed.ln() * mean) as f32
    }
}

fn logarithm(length: f64) -> f64 {
    (length + SHORT).ln()
}

fn spread(exits: &[Exit], length: impl Fn(&Exit) -> f64) -> (f64, f64) {
    let count = exits.len().max(1) as f64;
    let mean = exits.iter().map(|exit| logarithm(length(exit))).sum::<f64>() / count;
    let square = exits.iter().map(|exit| (logarithm(length(exit)) - mean).powi(2)).sum::<f64>() / count;
    (mean, square)
}
