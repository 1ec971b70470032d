//! Four logarithms at once, in vector arithmetic.

use glam::Vec4;

use crate::arithmetic::lanes::{bits, fused, horner, of_bits};

/// The natural logarithm of each `x`, 0 or normal, within 3e-7 of its own size; minus
/// infinity at 0.
#[inline(always)]
pub(crate) fn ln(x: Vec4) -> Vec4 {
    // Cephes' polynomial for ln(1 + f) - f + f^2/2 over f^3, f from the root of 1/2 to the root of 2.
    const TAIL: [f32; 9] = [
        7.037_683_6e-2,
        -1.151_461e-1,
        1.167_699_9e-1,
        -1.242_014_1e-1,
        1.424_932_3e-1,
        -1.666_805_8e-1,
        2.000_071_5e-1,
        -2.499_999_4e-1,
        3.333_333e-1,
    ];
    const LN_2: Vec4 = Vec4::splat(0.693_359_4);
    const LN_2_REST: Vec4 = Vec4::splat(-2.121_944_4e-4);
    /// Bits of the root of 1/2, from which on mantissas are taken.
    const LEAST: u32 = 0x3f35_04f3;
    let [a, b, c, d] = bits(x);
    let exponent = |bits: u32| (bits.wrapping_sub(LEAST) as i32) >> 23;
    let mantissa = |bits: u32| bits.wrapping_sub((exponent(bits) as u32) << 23);
    let whole = Vec4::new(exponent(a) as f32, exponent(b) as f32, exponent(c) as f32, exponent(d) as f32);
    let f = of_bits([mantissa(a), mantissa(b), mantissa(c), mantissa(d)]) - Vec4::ONE;
    let square = f * f;
    let curve = fused(horner(&TAIL, f) * f, square, whole * LN_2_REST);
    let near = fused(square, Vec4::splat(-0.5), curve) + f;
    let value = fused(whole, LN_2, near);
    Vec4::select(x.cmpgt(Vec4::ZERO), value, Vec4::NEG_INFINITY)
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use super::ln;

    #[test]
    fn agrees_with_double_precision() {
        let mut worst = 0.0_f64;
        for step in 0..1_000_000 {
            let x = 10.0_f32.powf(step as f32 * 7e-5 - 35.0);
            let exact = f64::from(x).ln();
            let found = f64::from(ln(Vec4::splat(x)).x);
            worst = worst.max((found - exact).abs() / exact.abs().max(1e-30));
            let close = 1.0 + f32::EPSILON * step as f32;
            let exact = f64::from(close).ln();
            let found = f64::from(ln(Vec4::splat(close)).x);
            worst = worst.max((found - exact).abs() / exact.abs().max(1e-30));
        }
        assert!(worst < 3e-7, "{worst}");
        assert_eq!(ln(Vec4::ONE), Vec4::ZERO);
        assert_eq!(ln(Vec4::ZERO), Vec4::NEG_INFINITY);
    }
}
