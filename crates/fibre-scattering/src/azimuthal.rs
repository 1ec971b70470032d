//! How light spreads around the fibre: the logistic density of Chiang et al. 2016, cut to one turn.

use crate::real::{Real, four};

/// A logistic density around 0, cut to [-pi, pi] and made to integrate to 1 there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrimmedLogistic<T> {
    scale: T,
    inverse_scale: T,
    /// `1 / (s k)`, k as below.
    height: T,
    /// The share of the untrimmed density inside the turn: `k = tanh(pi / 2s)`.
    inside: T,
    /// `1 - k`, which `k` itself cannot show for a smooth fibre.
    outside: T,
}

impl<T: Real> TrimmedLogistic<T> {
    /// `scale > 0`, in radians.
    pub fn new(scale: f64) -> Self {
        let edge = (-std::f64::consts::PI / scale).exp();
        let inside = (1.0 - edge) / (1.0 + edge);
        TrimmedLogistic {
            scale: T::of(scale),
            inverse_scale: T::of(1.0 / scale),
            height: T::of(1.0 / (scale * inside)),
            inside: T::of(inside),
            outside: T::of(2.0 * edge / (1.0 + edge)),
        }
    }

    /// The density at each `x` in [-pi, pi]. No exponent is positive: nothing overflows.
    #[inline(always)]
    pub fn densities(&self, x: [T; 4]) -> [T; 4] {
        let falls = T::exp_four(four(|p| -x[p].abs() * self.inverse_scale));
        four(|p| {
            let below = T::ONE + falls[p];
            falls[p] * self.height / (below * below)
        })
    }

    /// An angle distributed as [`TrimmedLogistic::densities`] says.
    pub fn sample(&self, u: T) -> T {
        let before = self.outside + T::TWO * self.inside * u;
        let after = self.outside + T::TWO * self.inside * (T::ONE - u);
        (self.scale * (before / after).ln()).max(-T::PI).min(T::PI)
    }
}

/// The same angle in [-pi, pi], for angles within a turn of it.
///
/// A turn is taken in two parts: the f32 next to it is 1.7e-7 too long, and the gap that leaves
/// where a smooth fibre's lobe lies across the seam would cost it 3e-4 of its light.
#[inline(always)]
pub(crate) fn wrapped<T: Real>(angle: T) -> T {
    let turn = if angle > T::PI {
        T::ONE
    } else if angle < -T::PI {
        -T::ONE
    } else {
        T::ZERO
    };
    (angle - turn * T::TAU) - turn * T::TAU_REST
}
