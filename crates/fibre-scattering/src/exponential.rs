//! Four exponentials at once, in vector arithmetic.
//!
//! An evaluation takes twelve exponentials of `f32`; through the system's library they would
//! be as many calls.

use glam::Vec4;

use crate::real::four;

/// `exp(x)` of each `x <= 0` within 2e-7; 0 below -87, where `f32` leaves its normal range.
#[inline(always)]
pub(crate) fn exp_four(x: Vec4) -> Vec4 {
    // Adding 1.5 * 2^23 rounds to an integer and leaves it in the low bits.
    const ROUNDER: Vec4 = Vec4::splat(12_582_912.0);
    const SMALLEST: Vec4 = Vec4::splat(-87.0);
    // ln 2 in two parts: the first has few bits, so that its multiples are exact.
    const LN_2: f32 = 0.693_359_4;
    const LN_2_REST: f32 = -2.121_944_4e-4;
    // Cephes' polynomial for |rest| <= ln(2) / 2, from the highest power down.
    const TAIL: [f32; 6] =
        [1.987_569_1e-4, 1.398_199_9e-3, 8.333_452e-3, 4.166_579_6e-2, 1.666_666_5e-1, 0.5];
    let bounded = x.max(SMALLEST);
    let rounded = bounded * std::f32::consts::LOG2_E + ROUNDER;
    let whole = rounded - ROUNDER;
    let rest = (bounded - whole * LN_2) - whole * LN_2_REST;
    let mantissa = (horner(&TAIL, rest) * rest * rest + rest) + Vec4::ONE;
    let bits = rounded.to_array();
    let power = four(|p| f32::from_bits(bits[p].to_bits().wrapping_add(127) << 23));
    let value = mantissa * Vec4::from_array(power);
    Vec4::select(x.cmpgt(SMALLEST), value, Vec4::ZERO)
}

/// The polynomial whose coefficients are given from the highest power down.
#[inline(always)]
pub(crate) fn horner<const N: usize>(coefficients: &[f32; N], x: Vec4) -> Vec4 {
    let mut sum = Vec4::splat(coefficients[0]);
    for &coefficient in &coefficients[1..] {
        sum = sum * x + Vec4::splat(coefficient);
    }
    sum
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use super::exp_four;

    fn exp(x: f32) -> f32 {
        exp_four(Vec4::splat(x)).x
    }

    #[test]
    fn agrees_with_double_precision() {
        let mut worst = 0.0_f64;
        for step in 0..1_000_000 {
            let x = -86.9 * (step as f32 / 1e6);
            worst = worst.max((f64::from(exp(x)) / f64::from(x).exp() - 1.0).abs());
        }
        assert!(worst < 2e-7, "{worst}");
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-88.0), 0.0);
        assert_eq!(exp(f32::NEG_INFINITY), 0.0);
    }
}
