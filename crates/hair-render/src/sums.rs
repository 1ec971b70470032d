//! Sums of the samples of a pixel, kept so that they survive being written down.
//!
//! Two halves of the samples that know nothing of each other tell how exact their mean is. After each pass every
//! sum is rounded to what two `f32` hold, whether it is written to a file then or not: so a render that was
//! stopped, written and read has the bits of one that was not.

use glam::{DVec3, Vec3};

use crate::Aov;
use crate::path::{PARTS, PathLight, RayCounts};

/// Pixels along a tile's edge: small enough that the last tiles keep every core busy.
pub(crate) const TILE: u32 = 16;

/// The sums of a square of pixels: 52 bytes a pixel and 24 more for each pass that is kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TileSums {
    /// Samples a pixel so far; sample n belongs to half n mod 2.
    pub spp: u32,
    /// The beauty's sum in each half.
    pub halves: Vec<[DVec3; 2]>,
    /// Samples that met something (or the background, where it is seen).
    pub covered: Vec<u32>,
    /// Sums of the passes that are kept, pixel by pixel.
    pub parts: Vec<DVec3>,
}

/// What was counted beside the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub rays: RayCounts,
    pub rejected: u64,
}

impl Tally {
    pub fn add(&mut self, other: &Tally) {
        self.rays.closest += other.rays.closest;
        self.rays.shadow += other.rays.shadow;
        self.rejected += other.rejected;
    }
}

/// A finished pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Developed {
    pub beauty: Vec3,
    pub alpha: f32,
    /// Estimated variance of the beauty; `None` when a half is empty.
    pub variance: Option<DVec3>,
}

impl TileSums {
    /// Sums of `pixels` pixels without a sample.
    pub fn empty(pixels: usize, aovs: usize) -> Self {
        TileSums {
            spp: 0,
            halves: vec![[DVec3::ZERO; 2]; pixels],
            covered: vec![0; pixels],
            parts: vec![DVec3::ZERO; pixels * aovs],
        }
    }

    /// Adds a sample to pixel `at`; one that is not finite counts as black. Whether it was finite.
    pub fn add(&mut self, at: usize, half: usize, light: &PathLight, aovs: &[Aov]) -> bool {
        self.covered[at] += u32::from(light.alpha > 0.0);
        if !light.parts.iter().all(|part| part.is_finite()) {
            return false;
        }
        self.halves[at][half] += light.parts.iter().map(|part| part.as_dvec3()).sum::<DVec3>();
        let parts = &mut self.parts[at * aovs.len()..(at + 1) * aovs.len()];
        for (sum, &aov) in parts.iter_mut().zip(aovs) {
            *sum += light.parts[aov as usize].as_dvec3();
        }
        true
    }

    /// Rounds all sums to what a file holds of them.
    pub fn round(&mut self) {
        let sums = self.halves.iter_mut().flatten().chain(&mut self.parts);
        sums.for_each(|sum| *sum = sum.map(|sum| join(split(sum))));
    }

    /// The samples of each half.
    fn counts(&self) -> [u32; 2] {
        [self.spp.div_ceil(2), self.spp / 2]
    }

    /// Pixel `at` as the mean of its samples; black without any.
    pub fn develop(&self, at: usize) -> Developed {
        let [a, b] = self.halves[at];
        let [n, m] = self.counts().map(f64::from);
        let count = (n + m).max(1.0);
        // With halves of n and m samples, (A - B)^2 estimates sigma^2 (1/n + 1/m), and the mean of all has
        // sigma^2 / (n + m): the factor between is n m / (n + m)^2, which is 1/4 for equal halves.
        let variance = (self.spp >= 2).then(|| {
            let difference = a / n - b / m;
            difference * difference * (n * m / (count * count))
        });
        Developed {
            beauty: ((a + b) / count).as_vec3(),
            alpha: (f64::from(self.covered[at]) / count) as f32,
            variance,
        }
    }

    /// Pass `pass` of the `aovs` that are kept, at pixel `at`.
    pub fn part(&self, at: usize, pass: usize, aovs: usize) -> Vec3 {
        (self.parts[at * aovs + pass] / f64::from(self.spp.max(1))).as_vec3()
    }
}

/// The two `f32` that a sum is written as: the nearest, and the nearest to what that leaves (48 bits at least).
/// A sum beyond 3.4e38, which no picture could show, becomes that.
pub(crate) fn split(sum: f64) -> [f32; 2] {
    let nearest = |value: f64| (value as f32).clamp(-f32::MAX, f32::MAX);
    let high = nearest(sum);
    [high, nearest(sum - f64::from(high))]
}

/// The sum that two `f32` stand for.
pub(crate) fn join([high, low]: [f32; 2]) -> f64 {
    // Plus nothing: a zero has no sign, as when it is read.
    f64::from(high) + f64::from(low) + 0.0
}

// A pass is found by its place in `PathLight::parts`.
const _: () = assert!(PARTS == Aov::ALL.len());

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sample(value: f32) -> PathLight {
        let mut light = PathLight { alpha: 1.0, ..Default::default() };
        light.parts[1] = Vec3::splat(value);
        light.parts[4] = Vec3::splat(1.0);
        light
    }

    #[test]
    fn unequal_halves_are_weighed_by_their_samples() {
        let mut tile = TileSums::empty(2, 1);
        for (half, value) in [(0, 1.0), (0, 2.0), (1, 6.0)] {
            assert!(tile.add(1, half, &sample(value), &[Aov::Tt]));
            tile.spp += 1;
        }
        let developed = tile.develop(1);
        assert_eq!((developed.beauty, developed.alpha), (Vec3::splat(4.0), 1.0));
        let expected = 4.5f64.powi(2) * (2.0 / 9.0);
        assert!((developed.variance.unwrap().y - expected).abs() < 1e-12);
        assert_eq!((tile.part(1, 0, 1), tile.part(0, 0, 1)), (Vec3::splat(3.0), Vec3::ZERO));
        assert_eq!(tile.develop(0).beauty, Vec3::ZERO);
    }

    #[test]
    fn broken_samples_do_not_spread() {
        let mut tile = TileSums::empty(1, 0);
        assert!(!tile.add(0, 0, &sample(f32::NAN), &[]));
        tile.spp = 1;
        assert!(tile.develop(0).variance.is_none());
        assert!(tile.add(0, 1, &sample(1.0), &[]));
        tile.spp = 2;
        assert_eq!(tile.develop(0).beauty, Vec3::splat(1.0));
    }

    proptest! {
        /// What was rounded once stays as it is however often it is written and read.
        #[test]
        fn a_rounded_sum_survives_a_file(bits in any::<u64>()) {
            let sum = f64::from_bits(bits);
            prop_assume!(sum.is_finite());
            let kept = join(split(sum));
            prop_assert_eq!(join(split(kept)).to_bits(), kept.to_bits());
            if sum.abs() < 1e38 && sum.abs() > 1e-20 {
                prop_assert!((kept / sum - 1.0).abs() < 2f64.powi(-47), "{} {}", kept, sum);
            }
        }

        /// The same among the sums that occur: those of a few hundred samples.
        #[test]
        fn sums_of_samples_survive_a_file(samples in prop::collection::vec(0.0f32..1e4, 1..300)) {
            let sum: f64 = samples.iter().map(|&s| f64::from(s)).sum();
            let kept = join(split(sum));
            prop_assert_eq!(join(split(kept)).to_bits(), kept.to_bits());
        }
    }
}
