//! How much light each lobe carries: Fresnel's equations and Beer's law over the chord.

use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::real::{Real, four};
use crate::hair::surface::Surface;

/// The fibre's cross-section as light from one direction meets it at one offset.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chord<T> {
    /// The share reflected at the surface.
    pub fresnel: T,
    /// Length of one crossing of the fibre, in radii.
    pub length: T,
    /// Sine and cosine of `gamma_i`, the angle of the ray against the normal outside, in the cross-section.
    pub turn_i: (T, T),
    /// The same of `gamma_t`, inside.
    pub turn_t: (T, T),
    /// Length of a path inside over its length in the cross-section: `1 / cos(theta_t)`.
    pub stretch: T,
}

impl<T: Real> Chord<T> {
    /// `eta2_minus_1` is `eta^2 - 1 > 0`; `cos_theta` in [0, 1]; `h` in [-1, 1].
    ///
    /// Every root is of `eta^2 - 1` plus a square: written so, neither grazing light nor an index
    /// next to 1 cancels, and `eta' = sqrt(eta^2 - sin^2) / cos` is never divided by.
    pub fn new(eta2_minus_1: T, cos_theta: T, h: T) -> Self {
        Chord::reflecting(eta2_minus_1, cos_theta, h, |cos| fresnel(eta2_minus_1, cos))
    }

    /// [`Chord::new`] under a surface that is not bare.
    pub fn under(surface: &Surface<T>, cos_theta: T, h: T) -> Self {
        Chord::reflecting(surface.eta2_minus_1, cos_theta, h, |cos| surface.reflectance(cos))
    }

    fn reflecting(e: T, cos_theta: T, h: T, reflectance: impl FnOnce(T) -> T) -> Self {
        let cos2_theta = cos_theta * cos_theta;
        let cos2_gamma = (T::ONE - h) * (T::ONE + h);
        let eta2 = T::ONE + e;
        let bent = (e + cos2_theta).sqrt();
        let bent_across = (e + cos2_theta * cos2_gamma).sqrt();
        let sin_gamma_t = h * cos_theta / bent;
        let cos_gamma_t = bent_across / bent;
        // 2 cos(gamma_t) / cos(theta_t), where cos(theta_t) = bent / eta.
        let length = T::TWO * cos_gamma_t * eta2.sqrt() / bent;
        Chord {
            fresnel: reflectance(cos_theta * cos2_gamma.sqrt()),
            length,
            turn_i: (h, cos2_gamma.sqrt()),
            turn_t: (sin_gamma_t, cos_gamma_t),
            stretch: eta2.sqrt() / bent,
        }
    }

    /// `gamma_t - gamma_i`: by how much the surface bends the ray around the axis.
    pub fn bend(&self) -> T {
        let (outside, inside) = (self.turn_i.0, self.turn_t.0.max(-T::ONE).min(T::ONE));
        inside.asin() - outside.asin()
    }

    /// A_0 .. A_3 of each channel, where one crossing lets `exp(-depth)` pass; they sum to 1 when all passes.
    ///
    /// The last is the whole geometric series that begins with two inner reflections.
    #[inline(always)]
    pub fn attenuations_through(&self, [red, green, blue]: [T; 3]) -> [[T; 3]; 4] {
        let (pass, caught) = T::Four::from([red, green, blue, T::ZERO]).fall_and_rest();
        let reflected = self.fresnel;
        let entered = T::ONE - reflected;
        let lanes = T::Four::splat;
        let tt = pass * lanes(entered * entered);
        let trt = tt * pass * lanes(reflected);
        // 1 - F T as two positive parts: both vanish only where nothing enters, and TRT with them.
        let rest: [T; 4] = caught.times_plus(lanes(reflected), lanes(entered)).into();
        let rest = four(|channel| if rest[channel] > T::ZERO { rest[channel] } else { T::ONE });
        let residual = trt * pass * lanes(reflected) / T::Four::from(rest);
        [lanes(reflected), tt, trt, residual].map(|lobe| {
            let [red, green, blue, _] = lobe.into();
            [red, green, blue]
        })
    }
}

/// A_0 .. A_3 of a fibre that is not round: `reflected` is what the surface reflects where it is met for the
/// first, second and third time, `depths` are the optical depths of the two crossings between.
///
/// What has been reflected twice inside goes on as if every meeting from there on were the mean of those
/// three, and every crossing the mean of those two: a geometric series, which without absorption returns all
/// of it. (Of three, for the two inside may be total, and no ray that entered is caught for ever.)
pub(crate) fn attenuations_of_three<T: Real>(reflected: [T; 3], depths: [T; 2]) -> [T; 4] {
    let passes = depths.map(|depth| (-depth).exp());
    let entered = T::ONE - reflected[0];
    let tt = entered * (T::ONE - reflected[1]) * passes[0];
    let once = entered * reflected[1] * passes[0] * passes[1];
    let trt = once * (T::ONE - reflected[2]);
    let left = once * reflected[2];
    let mean = (reflected[0] + reflected[1] + reflected[2]) * T::of(1.0 / 3.0);
    let leaving = (entered + (T::ONE - reflected[1]) + (T::ONE - reflected[2])) * T::of(1.0 / 3.0);
    let depth = T::of(0.5) * (depths[0] + depths[1]);
    // 1 - F T as two positive parts, as above.
    let rest = leaving - mean * (-depth).exp_m1();
    let residual = if rest > T::ZERO { left * ((-depth).exp() * leaving / rest) } else { T::ZERO };
    [reflected[0], tt, trt, residual]
}

/// Unpolarised reflectance of a dielectric of `eta^2 = 1 + e` at `cos` of incidence.
pub(crate) fn fresnel<T: Real>(e: T, cos: T) -> T {
    let inside = (e + cos * cos).sqrt();
    let eta2 = T::ONE + e;
    let across_below = cos + inside;
    let along_below = eta2 * cos + inside;
    // The textbook differences over sums, multiplied out: nothing cancels for an index next to 1.
    let across = e / (across_below * across_below);
    let along = e * ((eta2 + T::ONE) * cos * cos - T::ONE) / (along_below * along_below);
    (T::of(0.5) * (across * across + along * along)).min(T::ONE)
}
