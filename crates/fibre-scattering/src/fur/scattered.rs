//! Light scattered by the medulla, at one hit: a mixture of the densities of four rows and their classes.

use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::real::{Real, four};
use crate::fur::counts::Counts;
use crate::fur::grid::{KNOTS, Place, STEP_AROUND, reach};
use crate::fur::knots::Knots;
use crate::fur::paths::{NODES, PathNode};
use crate::fur::row::{CLASS_SHARES, CLASSES};
use crate::fur::table::MedullaTable;
use crate::hair::longitudinal::Inclination;

/// What each class of one row lets pass: red, green, blue and the most of them.
pub(crate) type Passed<T> = [[T; 4]; CLASSES];

/// The passed light of a row for absorption coefficients of cortex and medulla, each at least 0.
pub(crate) fn passed<T: Real>(table: &MedullaTable, row: usize, [cortex, medulla]: [[T; 3]; 2]) -> Passed<T> {
    four(|class| {
        let nodes = &table.nodes[row][class];
        // Four nodes at a time, the same for every channel.
        let lanes = |from: usize, number: fn(&PathNode) -> f32| {
            T::Four::from(four(|node| T::of(f64::from(number(&nodes[from + node])))))
        };
        let half = |from: usize| {
            (
                lanes(from, |node| node.cortex),
                lanes(from, |node| node.medulla),
                lanes(from, |node| node.share),
            )
        };
        let (low, high) = (half(0), half(NODES / 2));
        // No `map` over the halves: it stays a call, which is most of the time of a strand's own colour.
        let channel = |c: usize| {
            let left = |(in_cortex, in_medulla, share): (T::Four, T::Four, T::Four)| {
                let depth =
                    in_cortex.times_plus(T::Four::splat(cortex[c]), in_medulla * T::Four::splat(medulla[c]));
                depth.exp_of_minus() * share
            };
            let [a, b, c, d]: [T; 4] = (left(low) + left(high)).into();
            (a + b) + (c + d)
        };
        let (red, green, blue) = (channel(0), channel(1), channel(2));
        [red, green, blue, red.max(green).max(blue)]
    })
}

/// Everything passes.
pub(crate) fn all_passed<T: Real>() -> Passed<T> {
    [[T::ONE; 4]; CLASSES]
}

/// The scattered lobe of a fibre met by a ray.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scattered<'a, T: Real> {
    rows: [&'a Counts; 4],
    /// For each row and class what it scatters in red, green and blue, and its chance to be drawn.
    parts: [[T::Four; CLASSES]; 4],
    /// All chances together.
    pub chance: T,
    /// What is scattered in red, green and blue.
    pub albedo: [T; 3],
    /// Azimuth where unscattered light leaves first.
    centre: T,
    /// -1 where the ray is the mirror image, around the fibre and along it, of the one the rows stand for.
    mirrors: [T; 2],
}

impl<'a, T: Real> Scattered<'a, T> {
    /// `share` is what is scattered without absorption (times the lobe's weight); `passed` gives what each
    /// class of a row lets pass. Chances are not yet against those of other lobes.
    pub fn new(
        table: &'a MedullaTable,
        place: &Place<T>,
        share: T,
        passed: impl Fn(usize) -> Passed<T>,
        centre: T,
        mirrors: [T; 2],
    ) -> Self {
        let parts = four(|corner| {
            let passed = passed(place.rows[corner]);
            four(|class| {
                let weight = share * place.parts[corner] * T::of(CLASS_SHARES[class]);
                T::Four::from(passed[class]) * T::Four::splat(weight)
            })
        });
        let sum = parts.iter().flatten().fold(T::Four::splat(T::ZERO), |sum, &part| sum + part);
        let [red, green, blue, chance]: [T; 4] = sum.into();
        let rows = four(|corner| &table.counts[place.rows[corner]]);
        Scattered { rows, parts, chance, albedo: [red, green, blue], centre, mirrors }
    }

    /// Makes the chances sum to this.
    pub fn set_chance(&mut self, chance: T) {
        let scale = if self.chance > T::ZERO { chance / self.chance } else { T::ZERO };
        let scales = T::Four::from([T::ONE, T::ONE, T::ONE, scale]);
        for part in self.parts.iter_mut().flatten() {
            *part = *part * scales;
        }
        self.chance = chance;
    }

    /// f cos(theta_i) per channel, and the density of being drawn.
    #[inline(always)]
    pub fn evaluate(&self, sin_theta_i: T, phi: T) -> [T; 4] {
        let knots = self.knots(sin_theta_i, phi);
        // Each corner by itself, and pairs of sums: the fewer wait for one another, the faster.
        let low = self.corner(0, &knots) + self.corner(1, &knots);
        let high = self.corner(2, &knots) + self.corner(3, &knots);
        (low + high).into()
    }

    /// What [`Scattered::evaluate`] has from one row.
    #[inline(always)]
    fn corner(&self, corner: usize, knots: &Knots<T>) -> T::Four {
        let densities: [T; 4] = self.rows[corner].densities(knots).into();
        let part = self.parts[corner];
        let density = |class: usize| T::Four::splat(densities[class]);
        part[1].times_plus(density(1), part[0] * density(0))
            + part[3].times_plus(density(3), part[2] * density(2))
    }

    /// Where a direction lies between the knots.
    #[inline(always)]
    fn knots(&self, sin_theta_i: T, phi: T) -> Knots<T> {
        let [mirror_around, mirror_along] = self.mirrors;
        let mut turn = mirror_around * (phi - self.centre);
        // Two directions and a centre, each within half a turn of 0.
        for _ in 0..2 {
            turn = if turn < T::ZERO { turn + T::TAU } else { turn };
        }
        Knots::about(turn, mirror_along * sin_theta_i)
    }

    /// The inclination and the azimuth of a direction drawn from three numbers in [0, 1): the first picks row and
    /// class, the second the entry, the last two the place about its knot. `u[0]` is a part of this
    /// lobe's chance.
    pub fn sample(&self, u: [T; 4]) -> (Inclination<T>, T) {
        let (corner, class) = self.chosen(u[0] * self.chance);
        let count = (u[1] * T::of(65536.0)).whole().0.min(65535);
        let (line, column) = self.rows[corner].drawn(class, count);
        let [mirror_around, mirror_along] = self.mirrors;
        let sin = T::of(KNOTS[line]) + slanted_tent(u[2], reach(line));
        let sin = mirror_along * sin.max(-T::ONE).min(T::ONE);
        let cos = ((T::ONE - sin) * (T::ONE + sin)).sqrt();
        let turn = (T::of(column as f64) + tent(u[3])) * T::of(STEP_AROUND);
        (Inclination { sin, cos }, self.centre + mirror_around * turn)
    }

    /// The corner and class that a part of the chance falls on.
    fn chosen(&self, left: T) -> (usize, usize) {
        let chance = |part: T::Four| -> T {
            let [_, _, _, chance] = part.into();
            chance
        };
        let chances = four(|corner| four(|class| chance(self.parts[corner][class])));
        let sums = four(|corner| {
            let [a, b, c, d] = chances[corner];
            (a + b) + (c + d)
        });
        let (corner, left) = counted(sums, left);
        (corner, counted(chances[corner], left).0)
    }
}

/// Which of four chances a number falls on, the last there is when rounding leaves none, and by how much it
/// is past those before. Counted and not searched: no branch of it could be foreseen.
#[inline(always)]
fn counted<T: Real>(chances: [T; 4], left: T) -> (usize, T) {
    let [a, b, c, _] = chances;
    let before = [T::ZERO, a, a + b, a + b + c];
    let past =
        usize::from(left >= before[1]) + usize::from(left >= before[2]) + usize::from(left >= before[3]);
    let chosen = if chances[past] > T::ZERO {
        past
    } else {
        chances.iter().rposition(|&chance| chance > T::ZERO).unwrap_or(0)
    };
    (chosen, left - before[chosen])
}

/// A number in [-1, 1] by the density `1 - |x|`.
fn tent<T: Real>(u: T) -> T {
    let u = T::TWO * u;
    if u < T::ONE { u.sqrt() - T::ONE } else { T::ONE - (T::TWO - u).sqrt() }
}

/// A number by a density that falls in straight lines from 0 to nothing at these distances, of which one
/// may be 0.
fn slanted_tent<T: Real>(u: T, (below, above): (f64, f64)) -> T {
    let u = u * T::of(below + above);
    let (below, above) = (T::of(below), T::of(above));
    if u < below {
        below * ((u / below).sqrt() - T::ONE)
    } else {
        above * (T::ONE - (T::ONE - (u - below) / above).max(T::ZERO).sqrt())
    }
}
