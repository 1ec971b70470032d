//! Where a direction lies between the knots of a density.

use crate::arithmetic::real::Real;
use crate::fur::grid::{ALONG, AROUND, KNOTS, STEP_AROUND, knot_below, reach};

/// What lies between two knots along the fibre.
struct Span {
    /// Sine of the lower knot.
    below: f64,
    /// One over the distance of the knots.
    inverse_step: f64,
    /// Density under the tent of either knot of one count of 65536.
    heights: [f64; 2],
}

const SPANS: [Span; ALONG - 1] = {
    const NONE: Span = Span { below: 0.0, inverse_step: 0.0, heights: [0.0; 2] };
    let mut spans = [NONE; ALONG - 1];
    let mut line = 0;
    while line < ALONG - 1 {
        spans[line] = Span {
            below: KNOTS[line],
            inverse_step: 1.0 / (KNOTS[line + 1] - KNOTS[line]),
            heights: [height(line), height(line + 1)],
        };
        line += 1;
    }
    spans
};

/// One over the volume of the tent over a knot, of 65536.
const fn height(line: usize) -> f64 {
    let (below, above) = reach(line);
    1.0 / (65536.0 * STEP_AROUND * 0.5 * (below + above))
}

/// Where a direction lies between the knots.
pub(crate) struct Knots<T> {
    /// The lower line, along the fibre.
    pub line: usize,
    /// The columns on either side, around the fibre.
    pub column: usize,
    pub next: usize,
    /// Density of one count in the lower line's two entries, then in the upper's.
    pub weights: [T; 4],
}

impl<T: Real> Knots<T> {
    /// About an azimuth in [0, 2 pi] and the sine of an inclination.
    #[inline(always)]
    pub fn about(turn: T, sin: T) -> Self {
        let around = turn * T::of(1.0 / STEP_AROUND);
        let (column, left) = around.whole();
        let right = around - left;
        let line = knot_below(sin);
        let Span { below, inverse_step, heights } = &SPANS[line];
        let above = ((sin - T::of(*below)) * T::of(*inverse_step)).max(T::ZERO).min(T::ONE);
        let (low, high) = ((T::ONE - above) * T::of(heights[0]), above * T::of(heights[1]));
        // A whole turn is none.
        let column = if column < AROUND { column } else { 0 };
        let next = if column + 1 < AROUND { column + 1 } else { 0 };
        let left = T::ONE - right;
        Knots { line, column, next, weights: [low * left, low * right, high * left, high * right] }
    }
}
