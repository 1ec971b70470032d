//! How light spreads along the fibre: M_p of d'Eon et al. 2011, "An Energy-Conserving Hair
//! Reflectance Model" (doi:10.1111/j.1467-8659.2011.01976.x).

use crate::real::Real;

/// The sine and cosine of an inclination against the fibre's normal plane; `cos >= 0`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inclination<T> {
    pub sin: T,
    pub cos: T,
}

impl<T: Real> Inclination<T> {
    /// Turned by an angle given by its sine and cosine. Past the pole the cosine is folded back
    /// to the near side, so that a cone stays a cone.
    pub fn turned(self, (sin, cos): (T, T)) -> Self {
        Inclination {
            sin: (self.sin * cos + self.cos * sin).max(-T::ONE).min(T::ONE),
            cos: (self.cos * cos - self.sin * sin).abs(),
        }
    }
}

/// M of one variance, with all that depends on the variance alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Longitudinal<T> {
    variance: T,
    inverse_variance: T,
    /// `1 / (v (1 - exp(-2/v)))`
    scale: T,
    /// `exp(-2/v) - 1`
    range: T,
}

impl<T: Real> Longitudinal<T> {
    /// `variance > 0`, in radians squared where it is small.
    pub fn new(variance: f64) -> Self {
        let range = (-2.0 / variance).exp_m1();
        Longitudinal {
            variance: T::of(variance),
            inverse_variance: T::of(1.0 / variance),
            scale: T::of(-1.0 / (variance * range)),
            range: T::of(range),
        }
    }

    /// The density of `theta_i` against `cos(theta_i) d(theta_i)`, for light mirrored by `mirror`.
    ///
    /// d'Eon's `csch(1/v) / 2v exp(-sin sin / v) I0(cos cos / v)` is the difference of huge
    /// exponents for a smooth fibre. Writing the exponent as the squared chord between the two
    /// directions and scaling I0 leaves nothing to cancel, and needs no case for small variance.
    #[inline]
    pub fn density(&self, theta_i: Inclination<T>, mirror: Inclination<T>) -> T {
        let across = theta_i.cos - mirror.cos;
        let along = theta_i.sin + mirror.sin;
        let half_chord = T::of(0.5) * (across * across + along * along);
        let fall = (-half_chord * self.inverse_variance).exp();
        if fall == T::ZERO {
            return T::ZERO;
        }
        let bessel = (theta_i.cos * mirror.cos * self.inverse_variance).scaled_bessel_i0();
        fall * bessel * self.scale
    }

    /// An inclination distributed as [`Longitudinal::density`] says, after d'Eon et al. 2013.
    ///
    /// Both coordinates of the point on the cone are formed, not one from the other, so that
    /// the cosine is as good at grazing angles as anywhere.
    pub fn sample(&self, mirror: Inclination<T>, u: [T; 2]) -> Inclination<T> {
        let fall = -self.variance * (u[0] * self.range).ln_1p();
        let fall = fall.max(T::ZERO).min(T::TWO);
        let toward = T::ONE - fall;
        let aside = (fall * (T::TWO - fall)).sqrt();
        let (sin_turn, cos_turn) = (T::TAU * u[1]).sin_cos();
        let along = aside * cos_turn * mirror.cos - toward * mirror.sin;
        let outward = aside * cos_turn * mirror.sin + toward * mirror.cos;
        let sideways = aside * sin_turn;
        Inclination {
            sin: along.max(-T::ONE).min(T::ONE),
            cos: (outward * outward + sideways * sideways).sqrt(),
        }
    }
}
