//! Strands that jump instead of moving.

use glam::DVec3;

use crate::Stencil;
use crate::deformation_field::Deformation;

/// What the poses of a stencil count for, for one kind of strand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    pub(crate) first: [f64; 3],
    pub(crate) second: [f64; 3],
}

/// How a strand's rates of change are told, by where it jumps between the poses of a stencil: the whole stencil, the
/// first step of it, the second, or nothing.
///
/// A strand that jumps on one side only moves on the other as it moves, and that is its velocity. A difference over a
/// jump would be a blur across the picture.
pub(crate) fn rates(stencil: &Stencil) -> [Rate; 4] {
    let still = [0.0; 3];
    [
        Rate { first: stencil.first(), second: stencil.second() },
        Rate { first: stencil.one_sided(0), second: still },
        Rate { first: stencil.one_sided(1), second: still },
        Rate { first: still, second: still },
    ]
}

/// Which of [`rates`] a strand takes that jumps between the first two poses, the last two, both or neither.
pub(crate) fn kind(at: usize, jumps: [bool; 2]) -> usize {
    match (jumps, at) {
        ([false, false], _) => 0,
        ([false, true], 0 | 1) => 1,
        ([true, false], 1 | 2) => 2,
        _ => 3,
    }
}

/// Between which poses a root jumps: faster than `speed`, in units per second.
pub(crate) fn jumps(roots: [DVec3; 3], step: f64, speed: Option<f64>) -> [bool; 2] {
    let Some(speed) = speed else { return [false; 2] };
    let jumped = |from: DVec3, to: DVec3| from.distance(to) > speed * step;
    [jumped(roots[0], roots[1]), jumped(roots[1], roots[2])]
}

/// A deformation at one of three poses, and how fast it changes for each of [`rates`].
pub(crate) struct Deformations {
    pub(crate) at: Deformation,
    pub(crate) first: [Deformation; 4],
    pub(crate) second: [Deformation; 4],
}

impl Deformations {
    pub(crate) fn new(poses: [&Deformation; 3], at: usize, rates: &[Rate; 4]) -> Self {
        Deformations {
            at: poses[at].clone(),
            first: rates.map(|rate| Deformation::rate(poses, rate.first)),
            second: rates.map(|rate| Deformation::rate(poses, rate.second)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_counts_for_nothing_and_the_other_side_for_all() {
        for (time, kinds) in [
            (0.0, [0, 1, 3, 3]), // the first key: only what comes after
            (5.0, [0, 1, 2, 3]),
            (9.0, [0, 3, 2, 3]), // the last key
        ] {
            let stencil = Stencil::new(time, 0.1, Some((0.0, 9.0))).unwrap();
            let rates = rates(&stencil);
            for (jumps, expected) in
                [[false, false], [false, true], [true, false], [true, true]].into_iter().zip(kinds)
            {
                let found = kind(stencil.at(), jumps);
                assert_eq!(found, expected, "{time} {jumps:?}");
                // Steady motion but for jumps of 1000: the velocity is that of the motion.
                let [a, b, _] = stencil.times();
                let place = |t: f64| {
                    let jumped =
                        f64::from(u8::from(jumps[0] && t > a + 0.05) + u8::from(jumps[1] && t > b + 0.05));
                    3.0 * t + 1000.0 * jumped
                };
                let velocity: f64 =
                    rates[found].first.iter().zip(stencil.times()).map(|(w, t)| w * place(t)).sum();
                let steady = if found == 3 { 0.0 } else { 3.0 };
                assert!((velocity - steady).abs() < 1e-9, "{time} {jumps:?} {velocity}");
            }
        }
    }
}
