//! Fur, in either precision: hair's lobes, dimmed by the medulla, and the light the medulla scatters.
//!
//! Light that is not scattered obeys the hair model, with a medulla on its way: where Yan et al. 2017
//! ("An Efficient and Practical Near and Far Field Fur Reflectance Model", doi:10.1145/3072959.3073600) have
//! `T = exp(-2 s_c sigma'_ca - 2 s_m (sigma'_ma + sigma'_ms))` for one crossing. All the rest is
//! scattered, and without absorption none of it is lost: its share is `1 - sum A_p`.

use std::sync::Arc;

use crate::arithmetic::real::Real;
use crate::fur::grid::{Place, widest_offset};
use crate::fur::medulla::FurParameters;
use crate::fur::scattered::{Passed, Scattered};
use crate::fur::table::MedullaTable;
use crate::hair::attenuation::Chord;
use crate::hair::fibre::{Fibre, Hit};

/// A material of fur.
#[derive(Debug, Clone)]
pub(crate) struct Fur<T> {
    fibre: Fibre<T>,
    eta2_minus_1: T,
    kappa: T,
    sigma_s: T,
    weight: T,
    pub table: Option<Arc<MedullaTable>>,
}

impl<T: Real> Fur<T> {
    /// `parameters` have passed their check; `table` is theirs, and there if anything scatters.
    pub fn new(parameters: &FurParameters, table: Option<Arc<MedullaTable>>) -> Self {
        let FurParameters { hair, medulla } = parameters;
        let eta = f64::from(hair.eta);
        Fur {
            fibre: Fibre::new(hair),
            eta2_minus_1: T::of((eta - 1.0) * (eta + 1.0)),
            kappa: T::of(f64::from(medulla.kappa)),
            sigma_s: T::of(f64::from(if medulla.scatters() { medulla.sigma_s } else { 0.0 })),
            weight: T::of(f64::from(hair.lobe_weights[4])),
            table,
        }
    }

    /// Prepares all that does not depend on `wi`. `passed` says what a row of the table lets pass for this
    /// absorption, of cortex and medulla, which is at least 0.
    pub fn at(
        &self,
        wo: [T; 3],
        h: T,
        [cortex, medulla]: [[T; 3]; 2],
        passed: impl Fn(&MedullaTable, usize) -> Passed<T>,
    ) -> FurHit<'_, T> {
        if self.kappa <= T::ZERO {
            let mut hair = self.fibre;
            hair.sigma_a = cortex;
            return FurHit::new(hair.at(wo, h), None);
        }
        let mut depth = T::ZERO;
        let (hair, chord) = self.fibre.at_through(wo, h, |chord| {
            let half = self.half_of_medulla(chord);
            let in_medulla = T::TWO * half * chord.stretch;
            depth = self.sigma_s * in_medulla;
            let in_cortex = if half > T::ZERO { chord.length - in_medulla } else { chord.length };
            let of = |channel: usize| cortex[channel] * in_cortex + medulla[channel] * in_medulla + depth;
            [of(0), of(1), of(2)]
        });
        let share = self.weight * scattered_share(chord.fresnel, depth);
        let scattered = match self.table.as_deref() {
            Some(table) if share > T::ZERO => Some(self.scattered(table, wo, h, &chord, share, passed)),
            _ => None,
        };
        FurHit::new(hair, scattered)
    }

    /// Half of the chord through the medulla in the cross-section; 0 for a ray that passes it by.
    fn half_of_medulla(&self, chord: &Chord<T>) -> T {
        let offset = chord.turn_t.0;
        ((self.kappa - offset) * (self.kappa + offset)).max(T::ZERO).sqrt()
    }

    fn scattered<'a>(
        &self,
        table: &'a MedullaTable,
        [along, y, z]: [T; 3],
        h: T,
        chord: &Chord<T>,
        share: T,
        passed: impl Fn(&MedullaTable, usize) -> Passed<T>,
    ) -> Scattered<'a, T> {
        let cos_theta = (y * y + z * z).sqrt();
        let widest = widest_offset(self.kappa, self.eta2_minus_1, cos_theta);
        let place = Place::new(h.abs() / widest, along.abs().atan2(cos_theta));
        let sign = |x: T| if x < T::ZERO { -T::ONE } else { T::ONE };
        // Phi_1, at most half a turn from pi either way; the table wants it below pi.
        let centre = T::TWO * chord.bend() + sign(h) * T::PI;
        Scattered::new(table, &place, share, |row| passed(table, row), centre, [sign(h), sign(along)])
    }
}

/// `1 - sum A_p` without absorption, where one crossing scatters `1 - exp(-depth)`: as a product, which
/// does not cancel where little is scattered.
fn scattered_share<T: Real>(fresnel: T, depth: T) -> T {
    let caught = -(-depth).exp_m1();
    let entered = T::ONE - fresnel;
    let below = entered + fresnel * caught;
    if below > T::ZERO { entered * caught / below } else { T::ZERO }
}

/// A fibre of fur met by a ray.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FurHit<'a, T: Real> {
    hair: Hit<T>,
    /// Chance of the four lobes of hair.
    unscattered: T,
    scattered: Option<Scattered<'a, T>>,
}

impl<'a, T: Real> FurHit<'a, T> {
    fn new(hair: Hit<T>, scattered: Option<Scattered<'a, T>>) -> Self {
        let Some(mut scattered) = scattered else {
            return FurHit { hair, unscattered: T::ONE, scattered: None };
        };
        let most = hair.most();
        let both = most + scattered.chance;
        let chance = if both > T::ZERO { scattered.chance / both } else { T::ZERO };
        scattered.set_chance(chance);
        let unscattered = if most > T::ZERO { T::ONE - chance } else { T::ZERO };
        FurHit { hair, unscattered, scattered: (chance > T::ZERO).then_some(scattered) }
    }

    /// f cos(theta_i) per lobe and channel, and the density over solid angle.
    #[inline]
    pub fn evaluate_with_pdf(&self, wi: [T; 3]) -> ([[T; 3]; 5], T) {
        let (mut values, pdf, azimuth) = self.hair.evaluate_with_pdf_and_azimuth(wi);
        let Some(scattered) = &self.scattered else {
            return (values, pdf);
        };
        let [red, green, blue, density] = scattered.evaluate(wi[0], azimuth);
        values[4] = [red, green, blue];
        (values, self.unscattered * pdf + density)
    }

    /// The share each lobe scatters.
    pub fn attenuations(&self) -> [[T; 3]; 5] {
        let mut shares = self.hair.attenuations();
        if let Some(scattered) = &self.scattered {
            shares[4] = scattered.albedo;
        }
        shares
    }

    /// A direction drawn by the pdf and the lobe it was drawn from; nothing where no lobe carries light.
    pub fn sample_direction(&self, u: [T; 4]) -> Option<([T; 3], usize)> {
        let Some(scattered) = &self.scattered else {
            return self.hair.sample_direction(u);
        };
        if u[0] < self.unscattered {
            return self.hair.sample_direction([u[0] / self.unscattered, u[1], u[2], u[3]]);
        }
        let part = ((u[0] - self.unscattered) / scattered.chance).min(T::ONE);
        let (theta_i, phi) = scattered.sample([part, u[1], u[2], u[3]]);
        Some((self.hair.direction(theta_i, phi), 4))
    }
}
