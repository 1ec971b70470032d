//! How light spreads around the fibre: the logistic density of Chiang et al. 2016, cut to one turn.

use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::real::Real;
use crate::hair::attenuation::Chord;

/// Position of the residual lobe, the only one without an azimuth of its own.
pub(crate) const RESIDUAL: usize = 3;

/// Where R, TT and TRT leave a smooth fibre, as cosines and sines of their azimuths against that of `wo`.
///
/// The angle between a lobe and a direction is taken from the two as vectors: it has no seam then, and where it
/// is small it is right to its own last digits. The difference of two azimuths is right to those of pi.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Centres<T> {
    coss: [T; 4],
    sins: [T; 4],
}

impl<T: Real> Centres<T> {
    /// Of a round fibre: `2 p gamma_t - 2 gamma_i + p pi`.
    pub fn round(chord: &Chord<T>) -> Self {
        // By the sines and cosines of twice the angles; half a turn for TT is a change of signs.
        let twice = |(sin, cos): (T, T)| (T::ONE - T::TWO * sin * sin, T::TWO * sin * cos);
        let (outside, inside) = (twice(chord.turn_i), twice(chord.turn_t));
        let r = (outside.0, -outside.1);
        let turned =
            |from: (T, T)| (from.0 * inside.0 - from.1 * inside.1, from.1 * inside.0 + from.0 * inside.1);
        let tt = turned(r);
        let trt = turned(tt);
        Centres { coss: [r.0, -tt.0, trt.0, T::ONE], sins: [r.1, -tt.1, trt.1, T::ZERO] }
    }

    /// Of any fibre, from the cosines and sines of R, TT and TRT.
    pub fn of_turns([r, tt, trt]: [(T, T); 3]) -> Self {
        Centres { coss: [r.0, tt.0, trt.0, T::ONE], sins: [r.1, tt.1, trt.1, T::ZERO] }
    }

    /// `(cos, sin)` of lobe `p`'s azimuth.
    pub fn of_lobe(&self, p: usize) -> (T, T) {
        (self.coss[p], self.sins[p])
    }
}

/// A logistic density around 0, cut to [-pi, pi] and made to integrate to 1 there; for the residual lobe
/// one that is the same all around.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrimmedLogistic<T> {
    scales: [T; 4],
    /// `1 / s` of each lobe.
    inverse_scales: [T; 4],
    /// `1 / (s k)` of each lobe, k as below.
    heights: [T; 4],
    /// The share of the untrimmed density inside the turn: `k = tanh(pi / 2s)`.
    inside: [T; 4],
    /// `1 - k`, which `k` itself cannot show for a smooth fibre.
    outside: [T; 4],
}

impl<T: Real> TrimmedLogistic<T> {
    /// Of R, TT and TRT; each of `scales > 0`, in radians.
    pub fn new([r, tt, trt]: [f64; 3]) -> Self {
        let edge = |scale: f64| (-std::f64::consts::PI / scale).exp();
        let inside = |scale: f64| (1.0 - edge(scale)) / (1.0 + edge(scale));
        let lobes = |last: f64, of: &dyn Fn(f64) -> f64| [of(r), of(tt), of(trt), last].map(T::of);
        TrimmedLogistic {
            scales: lobes(0.0, &|scale| scale),
            // A logistic without width is a fourth of its height everywhere.
            inverse_scales: lobes(0.0, &|scale| 1.0 / scale),
            heights: lobes(4.0 / std::f64::consts::TAU, &|scale| 1.0 / (scale * inside(scale))),
            inside: lobes(1.0, &inside),
            outside: lobes(0.0, &|scale| 2.0 * edge(scale) / (1.0 + edge(scale))),
        }
    }

    /// The scales of R, TT and TRT.
    pub fn scales(&self) -> [T; 3] {
        let [r, tt, trt, _] = self.scales;
        [r, tt, trt]
    }

    /// Each lobe's density in the azimuth of the vector `[cos, sin]`, of any length, against that of `wo`. No
    /// exponent is positive: nothing overflows. Also that azimuth without its sign, in [0, pi], which is the
    /// angle to the residual lobe's centre.
    #[inline(always)]
    pub fn densities(&self, centres: &Centres<T>, [cos, sin]: [T; 2]) -> (T::Four, T) {
        let (coss, sins) = (T::Four::from(centres.coss), T::Four::from(centres.sins));
        let (cos, sin) = (T::Four::splat(cos), T::Four::splat(sin));
        let along = coss.times_plus(cos, sins * sin);
        let across = coss * sin - sins * cos;
        let angles = along.angle_to(across);
        let falls = (angles * T::Four::from(self.inverse_scales)).exp_of_minus();
        let below = falls + T::Four::splat(T::ONE);
        let [_, _, _, azimuth]: [T; 4] = angles.into();
        (falls * T::Four::from(self.heights) / (below * below), azimuth)
    }

    /// The ratio whose logarithm, times the scale, is an angle distributed as the density of lobe `p`, one of
    /// R, TT and TRT.
    pub fn odds(&self, p: usize, u: T) -> T {
        let before = self.outside[p] + T::TWO * self.inside[p] * u;
        let after = self.outside[p] + T::TWO * self.inside[p] * (T::ONE - u);
        before / after
    }

    /// That angle, in [-pi, pi].
    pub fn angle(&self, p: usize, ln_odds: T) -> T {
        (self.scales[p] * ln_odds).max(-T::PI).min(T::PI)
    }
}
