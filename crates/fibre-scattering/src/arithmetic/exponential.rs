//! Four exponentials at once, in vector arithmetic.
//!
//! An evaluation takes eight exponentials of `f32`; through the system's library they would be as many
//! calls.

use glam::Vec4;

use crate::arithmetic::lanes::{bits, fused, horner, of_bits};

/// Beyond it `exp` leaves the normal range of `f32`.
const GREATEST: Vec4 = Vec4::splat(87.0);

/// `exp(-x)` of each `x >= 0` within 2e-7; 0 above 87.
#[inline(always)]
pub(crate) fn exp_of_minus(x: Vec4) -> Vec4 {
    let Parts { power, tail } = parts(x);
    let value = fused(tail, power, power);
    Vec4::select(x.cmplt(GREATEST), value, Vec4::ZERO)
}

/// `exp(-x)` and `1 - exp(-x)` of each `x >= 0`, both within 3e-7 of their own size.
#[inline(always)]
pub(crate) fn fall_and_rest(x: Vec4) -> (Vec4, Vec4) {
    let Parts { power, tail } = parts(x);
    // Where 1 - exp is small the power is 1, and the tail is all there is.
    let rest = (Vec4::ONE - power) - power * tail;
    let within = x.cmplt(GREATEST);
    (Vec4::select(within, fused(tail, power, power), Vec4::ZERO), Vec4::select(within, rest, Vec4::ONE))
}

/// `exp(-x) = power (1 + tail)`, the power one of 2.
struct Parts {
    power: Vec4,
    tail: Vec4,
}

#[inline(always)]
fn parts(x: Vec4) -> Parts {
    // Adding 1.5 * 2^23 rounds to an integer and leaves it in the low bits.
    const ROUNDER: Vec4 = Vec4::splat(12_582_912.0);
    // ln 2 in two parts: the first has few bits, so that its multiples are exact.
    const LN_2: Vec4 = Vec4::splat(0.693_359_4);
    const LN_2_REST: Vec4 = Vec4::splat(-2.121_944_4e-4);
    // Cephes' polynomial for |rest| <= ln(2) / 2, from the highest power down.
    const TAIL: [f32; 6] =
        [1.987_569_1e-4, 1.398_199_9e-3, 8.333_452e-3, 4.166_579_6e-2, 1.666_666_5e-1, 0.5];
    let bounded = x.min(GREATEST);
    let rounded = fused(bounded, Vec4::splat(-std::f32::consts::LOG2_E), ROUNDER);
    let whole = rounded - ROUNDER;
    let rest = fused(-whole, LN_2_REST, fused(-whole, LN_2, -bounded));
    let tail = fused(horner(&TAIL, rest), rest * rest, rest);
    let [a, b, c, d] = bits(rounded);
    let power = |bits: u32| bits.wrapping_add(127) << 23;
    Parts { power: of_bits([power(a), power(b), power(c), power(d)]), tail }
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use super::{exp_of_minus, fall_and_rest};

    #[test]
    fn agrees_with_double_precision() {
        let (mut worst, mut worst_rest) = (0.0_f64, 0.0_f64);
        for step in 0..1_000_000 {
            let x = 86.9 * (step as f32 / 1e6);
            let exact = (-f64::from(x)).exp();
            worst = worst.max((f64::from(exp_of_minus(Vec4::splat(x)).x) / exact - 1.0).abs());
            let small = 10.0_f32.powf(step as f32 * 8e-6 - 6.0);
            let rest = -(-f64::from(small)).exp_m1();
            worst_rest =
                worst_rest.max((f64::from(fall_and_rest(Vec4::splat(small)).1.x) / rest - 1.0).abs());
        }
        assert!(worst < 2e-7 && worst_rest < 3e-7, "{worst} {worst_rest}");
        for (x, fall) in [(0.0, 1.0), (88.0, 0.0), (f32::INFINITY, 0.0)] {
            assert_eq!(exp_of_minus(Vec4::splat(x)).x, fall);
            assert_eq!(fall_and_rest(Vec4::splat(x)), (Vec4::splat(fall), Vec4::splat(1.0 - fall)));
        }
    }
}
