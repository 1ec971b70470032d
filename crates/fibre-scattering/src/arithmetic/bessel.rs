//! The modified Bessel function of order zero, scaled: `exp(-x) I0(x)`, which never overflows.

use glam::Vec4;

use crate::arithmetic::exponential::exp_of_minus;
use crate::arithmetic::lanes::{horner, sqrt};

/// `exp(-fall) exp(-x) I0(x)` to single precision, both at least 0: Abramowitz and Stegun 9.8.1 and 9.8.2.
///
/// The relative error stays below 6e-7 where `fall` is 0. Both ranges are worked out and one is kept: four
/// lobes fall in either, and a branch for each would cost more. One exponential serves both: that of the far
/// range has its `exp(-x)` in the series.
#[inline(always)]
pub(crate) fn exp_of_minus_by_i0(fall: Vec4, x: Vec4) -> Vec4 {
    const NEAR: [f32; 7] =
        [0.004_581_3, 0.036_076_8, 0.265_973_2, 1.206_749_2, 3.089_942_4, 3.515_622_9, 1.0];
    const FAR: [f32; 9] = [
        0.003_923_77,
        -0.016_476_33,
        0.026_355_37,
        -0.020_577_06,
        0.009_162_81,
        -0.001_575_65,
        0.002_253_19,
        0.013_285_92,
        0.398_942_3,
    ];
    const SEAM: f32 = 3.75;
    let is_near = x.cmplt(Vec4::splat(SEAM));
    let exp = exp_of_minus(fall + Vec4::select(is_near, x, Vec4::ZERO));
    let y = x.min(Vec4::splat(SEAM)) * (1.0 / SEAM);
    let near = horner(&NEAR, y * y);
    let inverse = Vec4::ONE / x.max(Vec4::splat(SEAM));
    let far = horner(&FAR, SEAM * inverse) * sqrt(inverse);
    exp * Vec4::select(is_near, near, far)
}

/// To double precision: the power series, whose terms are all positive, up to 30; the asymptotic
/// series beyond, whose smallest term is there below 1e-26.
///
/// `x >= 0`; the relative error stays below 1e-14. Slow: it serves the reference path only.
pub(crate) fn scaled_i0_double(x: f64) -> f64 {
    let next_of: fn(f64, f64) -> f64 = if x < 30.0 {
        |x, k| 0.25 * x * x / (k * k)
    } else {
        |x, k| (2.0 * k - 1.0) * (2.0 * k - 1.0) / (8.0 * x * k)
    };
    let mut term = 1.0;
    let mut sum = 1.0;
    let mut k = 1.0;
    while k < 200.0 {
        term *= next_of(x, k);
        sum += term;
        // The power series grows up to k = x/2 before it falls: only a small term ends it.
        if term < 1e-17 * sum {
            break;
        }
        k += 1.0;
    }
    if x < 30.0 { sum * (-x).exp() } else { sum / (std::f64::consts::TAU * x).sqrt() }
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use super::{exp_of_minus_by_i0, scaled_i0_double};

    #[test]
    fn both_precisions_agree() {
        let mut worst = 0.0_f64;
        for step in 0..400_000 {
            let x = 10.0_f32.powf(step as f32 * 3e-5 - 4.0);
            let exact = scaled_i0_double(f64::from(x));
            worst =
                worst.max((f64::from(exp_of_minus_by_i0(Vec4::ZERO, Vec4::splat(x)).x) / exact - 1.0).abs());
        }
        assert!(worst < 6e-7, "{worst}");
        assert_eq!(exp_of_minus_by_i0(Vec4::ZERO, Vec4::ZERO), Vec4::ONE);
    }

    /// Published values: Abramowitz and Stegun, table 9.8, and the seam of the two series.
    #[test]
    fn double_precision_is_exact() {
        let known = [(0.0, 1.0), (1.0, 0.465_759_607_593_640_4), (10.0, 0.127_833_337_163_428_6)];
        for (x, value) in known {
            assert!((scaled_i0_double(x) - value).abs() < 1e-15, "{x}");
        }
        let (below, above) = (scaled_i0_double(30.0 - 1e-12), scaled_i0_double(30.0));
        assert!((below / above - 1.0).abs() < 1e-13);
    }
}
