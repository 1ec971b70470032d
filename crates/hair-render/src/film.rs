//! Adding up samples: two halves that know nothing of each other tell how exact their mean is.

use glam::{DVec3, Vec3};

use crate::path::{PARTS, PathLight};

/// The samples of one pixel, in two halves.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pixel {
    halves: [Half; 2],
    pub rejected: u32,
}

#[derive(Clone, Copy, Debug, Default)]
struct Half {
    parts: [DVec3; PARTS],
    alpha: f64,
    count: u32,
}

/// A finished pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Developed {
    pub parts: [Vec3; PARTS],
    pub beauty: Vec3,
    pub alpha: f32,
    /// Estimated variance of the beauty; `None` when a half is empty.
    pub variance: Option<DVec3>,
}

impl Pixel {
    /// Adds a sample; one that is not finite counts as black and is counted.
    pub fn add(&mut self, half: usize, light: &PathLight) {
        let half = &mut self.halves[half];
        half.count += 1;
        half.alpha += f64::from(light.alpha);
        if light.parts.iter().all(|part| part.is_finite()) {
            for (sum, part) in half.parts.iter_mut().zip(light.parts) {
                *sum += part.as_dvec3();
            }
        } else {
            self.rejected += 1;
        }
    }

    pub fn develop(&self) -> Developed {
        let [a, b] = &self.halves;
        let count = f64::from(a.count + b.count).max(1.0);
        let parts: [DVec3; PARTS] = std::array::from_fn(|i| (a.parts[i] + b.parts[i]) / count);
        let beauty: DVec3 = parts.iter().sum();
        Developed {
            parts: parts.map(|p| p.as_vec3()),
            beauty: beauty.as_vec3(),
            alpha: ((a.alpha + b.alpha) / count) as f32,
            variance: self.variance(),
        }
    }

    /// With halves of n and m samples, (A - B)^2 estimates sigma^2 (1/n + 1/m), and the mean of all
    /// has sigma^2 / (n + m): the factor between is n m / (n + m)^2, which is 1/4 for equal halves.
    fn variance(&self) -> Option<DVec3> {
        let [a, b] = &self.halves;
        if a.count == 0 || b.count == 0 {
            return None;
        }
        let (n, m) = (f64::from(a.count), f64::from(b.count));
        let mean = |half: &Half, count: f64| half.parts.iter().sum::<DVec3>() / count;
        let difference = mean(a, n) - mean(b, m);
        Some(difference * difference * (n * m / ((n + m) * (n + m))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(value: f32) -> PathLight {
        let mut light = PathLight { alpha: 1.0, ..Default::default() };
        light.parts[1] = Vec3::splat(value);
        light.parts[4] = Vec3::splat(1.0);
        light
    }

    #[test]
    fn unequal_halves_are_weighed_by_their_samples() {
        let mut pixel = Pixel::default();
        for (half, value) in [(0, 1.0), (0, 2.0), (1, 6.0)] {
            pixel.add(half, &sample(value));
        }
        let developed = pixel.develop();
        assert_eq!((developed.beauty, developed.alpha), (Vec3::splat(4.0), 1.0));
        let expected = 4.5f64.powi(2) * (2.0 / 9.0);
        assert!((developed.variance.unwrap().y - expected).abs() < 1e-12);
    }

    #[test]
    fn broken_samples_do_not_spread() {
        let mut pixel = Pixel::default();
        pixel.add(0, &sample(f32::NAN));
        pixel.add(0, &sample(1.0));
        assert_eq!((pixel.rejected, pixel.develop().beauty), (1, Vec3::splat(1.0)));
        assert_eq!(pixel.develop().variance, None);
    }
}
