//! Four exponentials at once, in plain arithmetic that compilers turn into vector code.
//!
//! An evaluation takes eleven exponentials of `f32`; one by one through the system's library they
//! were more than half of its time.

use crate::real::four;

/// `exp(x)` of each `x <= 0` within 2e-7; 0 below -87, where `f32` leaves its normal range.
#[inline(always)]
pub(crate) fn exp_four(x: [f32; 4]) -> [f32; 4] {
    four(|p| exp(x[p]))
}

#[inline(always)]
fn exp(x: f32) -> f32 {
    // Adding 1.5 * 2^23 rounds to an integer and leaves it in the low bits.
    const ROUNDER: f32 = 12_582_912.0;
    const SMALLEST: f32 = -87.0;
    // ln 2 in two parts: the first has few bits, so that its multiples are exact.
    const LN_2: f32 = 0.693_359_4;
    const LN_2_REST: f32 = -2.121_944_4e-4;
    let bounded = if x > SMALLEST { x } else { SMALLEST };
    let rounded = bounded * std::f32::consts::LOG2_E + ROUNDER;
    let whole = rounded - ROUNDER;
    let rest = (bounded - whole * LN_2) - whole * LN_2_REST;
    // Cephes' polynomial for |rest| <= ln(2) / 2.
    let tail = 1.987_569_1e-4;
    let tail = tail * rest + 1.398_199_9e-3;
    let tail = tail * rest + 8.333_452e-3;
    let tail = tail * rest + 4.166_579_6e-2;
    let tail = tail * rest + 1.666_666_5e-1;
    let tail = tail * rest + 0.5;
    let mantissa = (tail * rest * rest + rest) + 1.0;
    let power = f32::from_bits(rounded.to_bits().wrapping_add(127) << 23);
    if x > SMALLEST { mantissa * power } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::exp;

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
