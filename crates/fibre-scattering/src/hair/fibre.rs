//! The model itself, in either precision.
//!
//! f cos(theta_i) = sum over p of A_p(h) M_p(theta_i) N_p(phi): Chiang et al. 2016, "A Practical
//! and Controllable Hair and Fur Model for Production Path Tracing" (doi:10.1111/cgf.12830).

use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::real::{Real, four};
use crate::hair::attenuation::{Chord, attenuations_of_three};
use crate::hair::azimuthal::{Centres, RESIDUAL, TrimmedLogistic};
use crate::hair::ellipse::Ellipse;
use crate::hair::longitudinal::{Inclination, Longitudinal, Mirrors};
use crate::hair::parameters::{HairParameters, azimuthal_deviation};
use crate::hair::surface::Surface;

/// What depends on the material alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fibre<T> {
    pub surface: Surface<T>,
    /// `None` for a round fibre.
    pub ellipse: Option<Ellipse>,
    pub sigma_a: [T; 3],
    lobe_weights: [T; 5],
    /// Sine and cosine of the tilt each lobe gives the outgoing inclination.
    tilts: [(T, T); 4],
    spread: Spread<T>,
}

/// The lobes' shapes, which an evaluation needs.
#[derive(Debug, Clone, Copy)]
struct Spread<T> {
    along: Longitudinal<T>,
    around: TrimmedLogistic<T>,
}

impl<T: Real> Fibre<T> {
    /// `parameters` have passed their check.
    pub fn new(parameters: &HairParameters) -> Self {
        let around = logistic_scale(parameters.beta_n);
        // What shines on wet hair is the water: as smooth as that, without scales, without their tilt.
        let (first_around, first_tilt) = match parameters.film {
            Some(film) => (logistic_scale(film.roughness), 0.0),
            None => (around, 1.0),
        };
        let mut tilts = tilts(f64::from(parameters.alpha));
        tilts[0] *= first_tilt;
        Fibre {
            surface: Surface::new(parameters),
            ellipse: (parameters.aspect < 1.0).then(|| Ellipse { aspect: f64::from(parameters.aspect) }),
            sigma_a: parameters.sigma_a.to_array().map(|s| T::of(f64::from(s))),
            lobe_weights: parameters.lobe_weights.map(|w| T::of(f64::from(w))),
            tilts: tilts.map(|tilt| (T::of(tilt.sin()), T::of(tilt.cos()))),
            spread: Spread {
                along: Longitudinal::new(parameters.variances()),
                around: TrimmedLogistic::new([first_around, around, around]),
            },
        }
    }

    /// Scales of the logistics of R, TT and TRT.
    pub fn azimuthal_scales(&self) -> [T; 3] {
        self.spread.around.scales()
    }

    /// Weights of all lobes but the medulla's.
    pub fn four_weights(&self) -> [T; 4] {
        four(|p| self.lobe_weights[p])
    }

    /// What lies along the fibre as seen from an inclination.
    pub fn longitudinal(&self, theta_o: Inclination<T>) -> (Mirrors<T>, Longitudinal<T>) {
        (Mirrors::new(theta_o, self.tilts), self.spread.along)
    }

    /// Prepares all that does not depend on `wi`.
    #[inline]
    pub fn at(&self, wo: [T; 3], h: T) -> Hit<T> {
        match self.ellipse {
            None => self.at_through(wo, h, |chord| self.sigma_a.map(|sigma_a| sigma_a * chord.length)).0,
            Some(ellipse) => self.at_ellipse(ellipse, wo, h),
        }
    }

    fn at_ellipse(&self, ellipse: Ellipse, wo: [T; 3], h: T) -> Hit<T> {
        let (theta_o, turn_o) = inclination_and_turn(wo);
        let e = self.surface.eta2_minus_1.double();
        let cos_theta = theta_o.cos.min(T::ONE).double();
        let h = h.max(-T::ONE).min(T::ONE).double();
        let crossing = ellipse.crossing(e, cos_theta, turn_o.map(T::double), h);
        let reflected = crossing.cos2.map(|cos2| self.surface.reflectance_of_leaving(T::of(cos2)));
        let [red, green, blue] = self.sigma_a.map(|sigma_a| {
            attenuations_of_three(reflected, crossing.lengths.map(|length| sigma_a * T::of(length)))
        });
        let centres = Centres::of_turns(crossing.turns.map(|(cos, sin)| (T::of(cos), T::of(sin))));
        self.hit(theta_o, turn_o, centres, four(|p| [red[p], green[p], blue[p]]))
    }

    /// [`Fibre::at`] where the optical depth of one crossing, per channel, is `depths` and not that of a
    /// cortex alone; the crossing too.
    pub fn at_through(
        &self,
        wo: [T; 3],
        h: T,
        depths: impl FnOnce(&Chord<T>) -> [T; 3],
    ) -> (Hit<T>, Chord<T>) {
        let h = h.max(-T::ONE).min(T::ONE);
        let (theta_o, turn_o) = inclination_and_turn(wo);
        let chord = Chord::under(&self.surface, theta_o.cos.min(T::ONE), h);
        let attenuations = chord.attenuations_through(depths(&chord));
        (self.hit(theta_o, turn_o, Centres::round(&chord), attenuations), chord)
    }

    /// From where the lobes leave and what each carries, per channel, before it is weighted.
    fn hit(
        &self,
        theta_o: Inclination<T>,
        turn_o: [T; 2],
        centres: Centres<T>,
        attenuations: [[T; 3]; 4],
    ) -> Hit<T> {
        let attenuations = four(|p| {
            let weight = self.lobe_weights[p];
            let [red, green, blue] = attenuations[p];
            [red * weight, green * weight, blue * weight]
        });
        let (probabilities, most) = probabilities(&attenuations);
        Hit {
            turn_o,
            mirrors: Mirrors::new(theta_o, self.tilts),
            centres,
            probabilities,
            most,
            attenuations,
            spread: self.spread,
        }
    }
}

/// The logistic's scale from the roughness around the fibre: Chiang et al. 2016, eq. 8. The root of
/// pi/8 gives the logistic the peak of a Gaussian of that deviation.
fn logistic_scale(beta_n: f32) -> f64 {
    (std::f64::consts::PI / 8.0).sqrt() * azimuthal_deviation(f64::from(beta_n))
}

/// How far each lobe turns the outgoing inclination. The residual has met so many scales that no
/// direction is left.
///
/// Scales open towards the tip, so each is wider at its tip end and its normals lean to the root,
/// the side of negative inclinations: R leaves 2 alpha nearer to the root than a mirror would send
/// it. The outgoing direction is turned instead, and the other way. (pbrt has the opposite signs:
/// its tangents run from tip to root, or its alpha is that of a hair upside down.)
fn tilts(alpha: f64) -> [f64; 4] {
    [2.0 * alpha, -alpha, -4.0 * alpha, 0.0]
}

/// Chance of each lobe, by what it carries in the channel that is absorbed least.
///
/// No channel of any lobe carries more than that one, so value over pdf never exceeds the sum of
/// the weighted attenuations there: a path's throughput is bounded by 1 in every channel, and no
/// lobe that is bright in one channel is starved because it is dark in the others.
/// The sum they were divided by, too.
fn probabilities<T: Real>(attenuations: &[[T; 3]; 4]) -> ([T; 4], T) {
    let most = four(|p| {
        let [red, green, blue] = attenuations[p];
        red.max(green).max(blue)
    });
    let sum = most[0] + most[1] + most[2] + most[3];
    (if sum > T::ZERO { most.map(|most| most / sum) } else { [T::ZERO; 4] }, sum)
}

/// The inclination of a unit direction and the cosine and sine of its azimuth.
pub(crate) fn inclination_and_turn<T: Real>([along, y, z]: [T; 3]) -> (Inclination<T>, [T; 2]) {
    // From the part across the fibre and not from the sine, which knows little about it when the
    // direction grazes the fibre.
    let cos = (y * y + z * z).sqrt();
    let sin = along.max(-T::ONE).min(T::ONE);
    let turn = if cos > T::ZERO { [y / cos, z / cos] } else { [T::ONE, T::ZERO] };
    (Inclination { sin, cos }, turn)
}

/// A fibre met by a ray.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit<T> {
    turn_o: [T; 2],
    mirrors: Mirrors<T>,
    centres: Centres<T>,
    probabilities: [T; 4],
    /// What all lobes together carry, each in the channel that is absorbed least.
    most: T,
    pub attenuations: [[T; 3]; 4],
    spread: Spread<T>,
}

impl<T: Real> Hit<T> {
    /// What all lobes together carry, each in the channel that is absorbed least.
    pub fn most(&self) -> T {
        self.most
    }

    /// The part of a direction across the fibre, turned so that `wo` lies at azimuth 0.
    #[inline(always)]
    fn turned(&self, [_, y, z]: [T; 3]) -> [T; 2] {
        let [cos_o, sin_o] = self.turn_o;
        [y * cos_o + z * sin_o, z * cos_o - y * sin_o]
    }

    /// The direction at an inclination and an azimuth against that of `wo`.
    #[inline]
    pub fn direction(&self, theta_i: Inclination<T>, phi: T) -> [T; 3] {
        let (sin_phi, cos_phi) = phi.sin_cos();
        self.direction_of(theta_i, cos_phi, sin_phi)
    }

    #[inline(always)]
    fn direction_of(&self, theta_i: Inclination<T>, cos_phi: T, sin_phi: T) -> [T; 3] {
        let [cos_o, sin_o] = self.turn_o;
        let y = theta_i.cos * (cos_phi * cos_o - sin_phi * sin_o);
        let z = theta_i.cos * (sin_phi * cos_o + cos_phi * sin_o);
        [theta_i.sin, y, z]
    }

    /// M_p N_p of each lobe, all four in step: that is what makes it fast. And phi_i - phi_o, in [-pi, pi].
    #[inline(always)]
    fn densities(&self, wi: [T; 3]) -> ([T; 4], T) {
        let [along, y, z] = wi;
        let theta_i = Inclination { sin: along, cos: (y * y + z * z).sqrt() };
        let turned = self.turned(wi);
        let (around, azimuth) = self.spread.around.densities(&self.centres, turned);
        let along = self.spread.along.densities(theta_i, &self.mirrors);
        ((around * along).into(), if turned[1] < T::ZERO { -azimuth } else { azimuth })
    }

    /// f cos(theta_i) per lobe and channel, and the density over solid angle.
    #[inline(always)]
    pub fn evaluate_with_pdf(&self, wi: [T; 3]) -> ([[T; 3]; 5], T) {
        let (values, pdf, _) = self.evaluate_with_pdf_and_azimuth(wi);
        (values, pdf)
    }

    /// And phi_i - phi_o, in [-pi, pi].
    #[inline(always)]
    pub fn evaluate_with_pdf_and_azimuth(&self, wi: [T; 3]) -> ([[T; 3]; 5], T, T) {
        let (densities, azimuth) = self.densities(wi);
        let value = |p: usize| {
            let [red, green, blue] = self.attenuations[p];
            let density = densities[p];
            [red * density, green * density, blue * density]
        };
        ([value(0), value(1), value(2), value(3), [T::ZERO; 3]], self.mixed(&densities), azimuth)
    }

    /// The share each lobe scatters; nothing in the lobe of the medulla.
    pub fn attenuations(&self) -> [[T; 3]; 5] {
        let [r, tt, trt, residual] = self.attenuations;
        [r, tt, trt, residual, [T::ZERO; 3]]
    }

    /// The density over solid angle alone.
    pub fn pdf(&self, wi: [T; 3]) -> T {
        self.mixed(&self.densities(wi).0)
    }

    fn mixed(&self, densities: &[T; 4]) -> T {
        (0..4).fold(T::ZERO, |sum, p| sum + self.probabilities[p] * densities[p])
    }

    /// A direction drawn by the pdf and the lobe it was drawn from; nothing where no lobe carries
    /// light.
    pub fn sample_direction(&self, u: [T; 4]) -> Option<([T; 3], usize)> {
        let p = self.chosen(u[0])?;
        let Spread { along, around } = &self.spread;
        // Both logarithms at once, and then both angles.
        let drop = along.drop(p, u[1]);
        let left = T::ONE + drop;
        let [ln_left, ln_odds, ..]: [T; 4] =
            T::Four::from([left, around.odds(p, u[3]), T::ONE, T::ONE]).ln().into();
        // What rounding took from 1 + drop is given back: a wide lobe's drop is small.
        let ln_drop = ln_left + (drop - (left - T::ONE)) / left;
        let phi = if p == RESIDUAL { T::TAU * u[3] } else { around.angle(p, ln_odds) };
        let (sins, coss) = T::Four::from([phi, T::TAU * u[2], T::ZERO, T::ZERO]).sin_cos();
        let ([sin_phi, sin_turn, ..], [cos_phi, cos_turn, ..]): ([T; 4], [T; 4]) = (sins.into(), coss.into());
        let theta_i = along.sample(p, &self.mirrors, ln_drop, (sin_turn, cos_turn));
        let (cos, sin) = self.centres.of_lobe(p);
        let direction =
            self.direction_of(theta_i, cos_phi * cos - sin_phi * sin, sin_phi * cos + cos_phi * sin);
        Some((direction, p))
    }

    /// The lobe a uniform number falls on; the last that has a chance when rounding leaves none.
    ///
    /// Counted and not searched: no branch of it can be foreseen, and a wrong guess would cost as much as half
    /// an evaluation.
    #[inline(always)]
    fn chosen(&self, u: T) -> Option<usize> {
        let [r, tt, trt, _] = self.probabilities;
        let p = usize::from(u >= r) + usize::from(u >= r + tt) + usize::from(u >= r + tt + trt);
        if self.probabilities[p] > T::ZERO {
            return Some(p);
        }
        self.probabilities.iter().rposition(|&probability| probability > T::ZERO)
    }
}
