//! The modified Bessel function of order zero, scaled: `exp(-x) I0(x)`, which never overflows.

/// To single precision: Abramowitz and Stegun 9.8.1 and 9.8.2, both scaled.
///
/// `x >= 0`; the relative error stays below 5e-7.
#[inline]
pub(crate) fn scaled_i0_single(x: f32) -> f32 {
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
    if x < 3.75 {
        let y = x * (1.0 / 3.75);
        horner(&NEAR, y * y) * (-x).exp()
    } else {
        horner(&FAR, 3.75 / x) / x.sqrt()
    }
}

/// The polynomial whose coefficients are given from the highest power down.
#[inline]
fn horner<const N: usize>(coefficients: &[f32; N], x: f32) -> f32 {
    coefficients.iter().fold(0.0, |sum, c| sum * x + c)
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
