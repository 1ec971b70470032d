//! Which rays the rows of a medulla's table stand for.
//!
//! Inside, all depends on the offset and the inclination of the *refracted* ray. Offsets are counted in
//! parts of the widest that still meets the medulla, spaced as sines: paths through a cylinder are even in
//! that measure, and dense where they change fastest.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::arithmetic::real::Real;

const OFFSETS: usize = 10;
const INCLINATIONS: usize = 8;

/// Rows of a table.
pub(crate) const ROWS: usize = OFFSETS * INCLINATIONS;

/// Arc sine of the last row's offset: 0.998 of the widest. At the widest itself nothing enters (h = 1) or
/// nothing is scattered.
const LAST_OFFSET: f64 = 1.507_548_0;

/// Inclination of the last row, 87.5 degrees: along the fibre nothing enters.
const LAST_INCLINATION: f64 = FRAC_PI_2 * 87.5 / 90.0;

/// Offset (as a part of the widest) and inclination, both at least 0, of a row.
pub(crate) fn ray_of_row(row: usize) -> (f64, f64) {
    let offset = (row % OFFSETS) as f64 / (OFFSETS - 1) as f64;
    let inclination = (row / OFFSETS) as f64 / (INCLINATIONS - 1) as f64;
    ((offset * LAST_OFFSET).sin(), inclination * LAST_INCLINATION)
}

/// The widest offset whose ray meets the medulla: `min(1, kappa eta')`.
pub(crate) fn widest_offset<T: Real>(kappa: T, eta2_minus_1: T, cos_theta: T) -> T {
    let reach = kappa * (eta2_minus_1 + cos_theta * cos_theta).sqrt();
    if reach < cos_theta { reach / cos_theta } else { T::ONE }
}

/// The four rows about a ray, and their parts, which sum to 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<T> {
    pub rows: [usize; 4],
    pub parts: [T; 4],
}

impl<T: Real> Place<T> {
    /// Of an offset in [0, 1] (a part of the widest) and an inclination in [0, pi/2]. Past the last row
    /// that row stands in.
    pub fn new(offset: T, inclination: T) -> Self {
        let offsets = T::of((OFFSETS - 1) as f64 / LAST_OFFSET) * offset.min(T::ONE).asin();
        let inclinations = T::of((INCLINATIONS - 1) as f64 / LAST_INCLINATION) * inclination;
        let (column, right) = split(offsets, OFFSETS);
        let (line, above) = split(inclinations, INCLINATIONS);
        let first = line * OFFSETS + column;
        let (left, below) = (T::ONE - right, T::ONE - above);
        Place {
            rows: [first, first + 1, first + OFFSETS, first + OFFSETS + 1],
            parts: [below * left, below * right, above * left, above * right],
        }
    }
}

/// The knot below a coordinate, never the last of `knots`, and how far the coordinate is past it.
fn split<T: Real>(coordinate: T, knots: usize) -> (usize, T) {
    let last = T::of((knots - 1) as f64);
    let coordinate = coordinate.max(T::ZERO).min(last);
    // The last knot is the upper one of the last two.
    let (knot, below) = coordinate.min(last - T::ONE).whole();
    (knot, coordinate - below)
}

/// Knots of the density around the fibre, from the azimuth where unscattered light leaves first.
pub(crate) const AROUND: usize = 46;
/// Knots of the density along the fibre, from sine -1 to 1.
pub(crate) const ALONG: usize = 16;
/// Entries of a row.
pub(crate) const CELLS: usize = AROUND * ALONG;
/// Distance of knots around the fibre, in radians.
pub(crate) const STEP_AROUND: f64 = 2.0 * PI / AROUND as f64;
/// Sines of the knots along the fibre: denser where light grazes it and less leaves, step by step, than at
/// right angles. [`knot_below`] knows their law.
pub(crate) const KNOTS: [f64; ALONG] = [
    -1.0,
    -0.961393753,
    -0.871350170,
    -0.750000000,
    -0.607005622,
    -0.447892442,
    -0.276171589,
    -0.094238899,
    0.094238899,
    0.276171589,
    0.447892442,
    0.607005622,
    0.750000000,
    0.871350170,
    0.961393753,
    1.0,
];

/// The part of the knots' law that is even in sines.
const EVEN: f64 = 0.4;

/// The knot at or below a sine, never the last; but for rounding next to a knot.
///
/// Knots lie at even steps of `a s + (1 - a)(1 - sqrt(1 - |s|))`, which needs no arc sine.
#[inline(always)]
pub(crate) fn knot_below<T: Real>(sin: T) -> usize {
    let from_middle = sin.abs().min(T::ONE);
    let steps = T::of(EVEN) * from_middle + T::of(1.0 - EVEN) * (T::ONE - (T::ONE - from_middle).sqrt());
    let steps = if sin < T::ZERO { -steps } else { steps };
    (T::of(0.5 * (ALONG - 1) as f64) * (steps + T::ONE)).max(T::ZERO).whole().0.min(ALONG - 2)
}

/// Distances from a knot to its neighbours; 0 where there is none.
pub(crate) const fn reach(knot: usize) -> (f64, f64) {
    let below = if knot == 0 { 0.0 } else { KNOTS[knot] - KNOTS[knot - 1] };
    let above = if knot + 1 == ALONG { 0.0 } else { KNOTS[knot + 1] - KNOTS[knot] };
    (below, above)
}

/// The knot next to a sine.
pub(crate) fn nearest_knot(sin: f64) -> usize {
    let below = KNOTS.partition_point(|&knot| knot <= sin).clamp(1, ALONG - 1) - 1;
    if sin - KNOTS[below] < KNOTS[below + 1] - sin { below } else { below + 1 }
}

/// The part of light from a matt surface, `sqrt(1 - s^2)`, that is next to each knot.
pub(crate) fn matt() -> [f64; ALONG] {
    // The integral of twice the root, from -1.
    let below = |s: f64| s * ((1.0 - s) * (1.0 + s)).sqrt() + s.asin() + FRAC_PI_2;
    std::array::from_fn(|knot| {
        let (to_last, to_next) = reach(knot);
        (below(KNOTS[knot] + 0.5 * to_next) - below(KNOTS[knot] - 0.5 * to_last)) / PI
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knots_are_found_where_they_are() {
        for (knot, sines) in KNOTS.windows(2).enumerate() {
            for part in [0.001, 0.499, 0.501, 0.999] {
                let sin = sines[0] + part * (sines[1] - sines[0]);
                assert_eq!((knot_below(sin), knot_below(sin as f32)), (knot, knot));
                assert_eq!(nearest_knot(sin), if part < 0.5 { knot } else { knot + 1 });
            }
        }
        assert_eq!((knot_below(-1.0), knot_below(1.0), knot_below(1.1_f32)), (0, ALONG - 2, ALONG - 2));
        assert!((matt().iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn rows_are_found_where_they_are() {
        for row in 0..ROWS {
            let (offset, inclination) = ray_of_row(row);
            let place = Place::<f64>::new(offset, inclination);
            let found: f64 =
                (0..4).filter(|&corner| place.rows[corner] == row).map(|corner| place.parts[corner]).sum();
            assert!((found - 1.0).abs() < 1e-9, "{row}: {place:?}");
        }
        for (offset, inclination) in [(0.0_f32, 0.0_f32), (1.0, 1.570_796_4), (0.5, 1.0), (1.1, 2.0)] {
            let place = Place::new(offset, inclination);
            assert!(place.rows.iter().all(|&row| row < ROWS));
            assert!((place.parts.iter().sum::<f32>() - 1.0).abs() < 1e-6);
        }
    }
}
