//! How wrong a picture is, as told by its own two halves.

use glam::{DVec3, Vec3};

/// How far to look for what a pixel's value would be without noise, in pixels.
const REACH: usize = 3;

/// Mean over covered pixels and channels of `variance / (value^2 + 0.01)`; 0 when nothing is covered.
///
/// A pixel's own value must not stand below its own variance: a pixel that is too bright by luck would
/// excuse its own error, and the figure of a noisy picture would come out far too good. So the value is
/// the mean radiance of the pixels around it, times its own coverage.
pub(crate) fn rel_mse(width: usize, beauty: &[Vec3], alpha: &[f32], variance: &[DVec3]) -> f64 {
    let height = beauty.len() / width;
    let (mut sum, mut count) = (0.0, 0u64);
    for (at, variance) in variance.iter().enumerate().filter(|&(at, _)| alpha[at] > 0.0) {
        let value = around(at % width, at / width, width, height, beauty, alpha) * f64::from(alpha[at]);
        sum += (*variance / (value * value + 0.01)).element_sum() / 3.0;
        count += 1;
    }
    sum / count.max(1) as f64
}

/// Mean radiance of what is covered around a pixel, the pixel itself left out; its own where it is alone.
fn around(x: usize, y: usize, width: usize, height: usize, beauty: &[Vec3], alpha: &[f32]) -> DVec3 {
    let (mut light, mut coverage) = (DVec3::ZERO, 0.0);
    for row in y.saturating_sub(REACH)..(y + REACH + 1).min(height) {
        for column in x.saturating_sub(REACH)..(x + REACH + 1).min(width) {
            if (column, row) != (x, y) {
                light += beauty[row * width + column].as_dvec3();
                coverage += f64::from(alpha[row * width + column]);
            }
        }
    }
    if coverage > 0.0 {
        return light / coverage;
    }
    let own = y * width + x;
    beauty[own].as_dvec3() / f64::from(alpha[own])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_from_the_neighbours_and_empty_pixels_do_not_count() {
        let beauty = [Vec3::ONE, Vec3::splat(50.0), Vec3::ONE, Vec3::ZERO];
        let alpha = [1.0, 1.0, 1.0, 0.0];
        let variance = [0.0, 1.01, 0.0, 9.0].map(DVec3::splat);
        let found = rel_mse(4, &beauty, &alpha, &variance);
        assert!((found - 1.0 / 3.0).abs() < 1e-9, "{found}");
        assert_eq!(rel_mse(1, &[Vec3::ZERO], &[0.0], &[DVec3::ONE]), 0.0);
        assert!((rel_mse(1, &[Vec3::ONE], &[1.0], &[DVec3::splat(1.01)]) - 1.0).abs() < 1e-9);
    }
}
