//! How light spreads along the fibre: M_p of d'Eon et al. 2011, "An Energy-Conserving Hair
//! Reflectance Model" (doi:10.1111/j.1467-8659.2011.01976.x).

use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::real::Real;

/// The sine and cosine of an inclination against the fibre's normal plane; `cos >= 0`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inclination<T> {
    pub sin: T,
    pub cos: T,
}

impl<T: Real> Inclination<T> {
    /// Turned by an angle given by its sine and cosine. Past the pole the cosine is folded back
    /// to the near side, so that a cone stays a cone.
    #[inline]
    pub fn turned(self, (sin, cos): (T, T)) -> Self {
        Inclination {
            sin: (self.sin * cos + self.cos * sin).max(-T::ONE).min(T::ONE),
            cos: (self.cos * cos - self.sin * sin).abs(),
        }
    }
}

/// M of the four lobes, with all that depends on their variances alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Longitudinal<T> {
    variances: [T; 4],
    inverse_variances: [T; 4],
    /// `1 / (v (1 - exp(-2/v)))`
    scales: [T; 4],
    /// `exp(-2/v) - 1`
    ranges: [T; 4],
}

/// The outgoing inclination as each lobe's scales see it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mirrors<T> {
    sins: [T; 4],
    coss: [T; 4],
}

impl<T: Real> Mirrors<T> {
    /// `theta_o` turned by each lobe's tilt.
    pub fn new(theta_o: Inclination<T>, tilts: [(T, T); 4]) -> Self {
        let turned = tilts.map(|tilt| theta_o.turned(tilt));
        Mirrors { sins: turned.map(|theta| theta.sin), coss: turned.map(|theta| theta.cos) }
    }
}

impl<T: Real> Longitudinal<T> {
    /// `variances > 0`, in radians squared where they are small.
    pub fn new(variances: [f64; 4]) -> Self {
        let range = |v: f64| (-2.0 / v).exp_m1();
        Longitudinal {
            variances: variances.map(T::of),
            inverse_variances: variances.map(|v| T::of(1.0 / v)),
            scales: variances.map(|v| T::of(-1.0 / (v * range(v)))),
            ranges: variances.map(|v| T::of(range(v))),
        }
    }

    /// Each lobe's density of `theta_i` against `cos(theta_i) d(theta_i)`.
    ///
    /// d'Eon's `csch(1/v) / 2v exp(-sin sin / v) I0(cos cos / v)` is the difference of huge
    /// exponents for a smooth fibre. Writing the exponent as the squared chord between the two
    /// directions and scaling I0 leaves nothing to cancel, and needs no case for small variance.
    #[inline(always)]
    pub fn densities(&self, theta_i: Inclination<T>, mirrors: &Mirrors<T>) -> T::Four {
        let (sins, coss) = (T::Four::from(mirrors.sins), T::Four::from(mirrors.coss));
        let inverse_variances = T::Four::from(self.inverse_variances);
        let cos_i = T::Four::splat(theta_i.cos);
        let across = cos_i - coss;
        let along = T::Four::splat(theta_i.sin) + sins;
        let half_chords = T::Four::splat(T::of(0.5)) * across.times_plus(across, along * along);
        let falls = half_chords * inverse_variances;
        falls.exp_of_minus_by_i0(cos_i * coss * inverse_variances) * T::Four::from(self.scales)
    }

    /// What [`Longitudinal::sample`] needs the logarithm of, as 1 plus this, for a uniform number.
    pub fn drop(&self, p: usize, u: T) -> T {
        u * self.ranges[p]
    }

    /// An inclination distributed as lobe `p`'s density says, after d'Eon et al. 2013: from the logarithm of
    /// 1 plus its [`Longitudinal::drop`], and sine and cosine of a turn that is evenly distributed.
    ///
    /// Both coordinates of the point on the cone are formed, not one from the other, so that
    /// the cosine is as good at grazing angles as anywhere.
    pub fn sample(
        &self,
        p: usize,
        mirrors: &Mirrors<T>,
        ln_drop: T,
        (sin_turn, cos_turn): (T, T),
    ) -> Inclination<T> {
        let (mirror_sin, mirror_cos) = (mirrors.sins[p], mirrors.coss[p]);
        let fall = -self.variances[p] * ln_drop;
        let fall = fall.max(T::ZERO).min(T::TWO);
        let toward = T::ONE - fall;
        let aside = (fall * (T::TWO - fall)).sqrt();
        let along = aside * cos_turn * mirror_cos - toward * mirror_sin;
        let outward = aside * cos_turn * mirror_sin + toward * mirror_cos;
        let sideways = aside * sin_turn;
        Inclination {
            sin: along.max(-T::ONE).min(T::ONE),
            cos: (outward * outward + sideways * sideways).sqrt(),
        }
    }
}
