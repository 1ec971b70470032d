//! Four sines and cosines at once, in vector arithmetic.

use glam::Vec4;

use crate::arithmetic::lanes::{bits, fused, horner, of_bits};

/// Sine and cosine of each angle within a few turns, within 2e-7.
#[inline(always)]
pub(crate) fn sin_cos(x: Vec4) -> (Vec4, Vec4) {
    const ROUNDER: Vec4 = Vec4::splat(12_582_912.0);
    // pi / 2 in three parts, of which multiples of the first two are exact.
    const QUARTER: [Vec4; 3] =
        [Vec4::splat(1.570_312_5), Vec4::splat(4.837_513e-4), Vec4::splat(7.549_79e-8)];
    // Cephes' polynomials up to pi / 4, from the highest power down.
    const SINE: [f32; 3] = [-1.951_529_6e-4, 8.332_161e-3, -1.666_665_5e-1];
    const COSINE: [f32; 3] = [2.443_315_7e-5, -1.388_731_6e-3, 4.166_664_6e-2];
    let rounded = fused(x, Vec4::splat(std::f32::consts::FRAC_2_PI), ROUNDER);
    let quarters = rounded - ROUNDER;
    let rest = fused(-quarters, QUARTER[2], fused(-quarters, QUARTER[1], fused(-quarters, QUARTER[0], x)));
    let square = rest * rest;
    let sine = fused(horner(&SINE, square) * square, rest, rest);
    let cosine = fused(horner(&COSINE, square) * square, square, fused(square, Vec4::splat(-0.5), Vec4::ONE));
    let [a, b, c, d] = bits(rounded);
    // Odd quarters exchange the two; the second and third turn the sine's sign, the first and second the cosine's.
    let odd = |bits: u32| 0_u32.wrapping_sub(bits & 1);
    let odd = [odd(a), odd(b), odd(c), odd(d)];
    let turned = |bits: u32| (bits & 2) << 30;
    let turned_next = |bits: u32| (bits.wrapping_add(1) & 2) << 30;
    let (s, t) = (bits(sine), bits(cosine));
    let pick = |p: usize, q: u32| {
        let sin = (s[p] & !odd[p]) | (t[p] & odd[p]);
        let cos = (t[p] & !odd[p]) | (s[p] & odd[p]);
        (sin ^ turned(q), cos ^ turned_next(q))
    };
    let (w, x, y, z) = (pick(0, a), pick(1, b), pick(2, c), pick(3, d));
    (of_bits([w.0, x.0, y.0, z.0]), of_bits([w.1, x.1, y.1, z.1]))
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use super::sin_cos;

    #[test]
    fn agrees_with_double_precision() {
        let mut worst = 0.0_f64;
        for step in 0..1_000_000 {
            let x = step as f32 * 2.5e-5 - 12.5;
            let (sin, cos) = sin_cos(Vec4::splat(x));
            let exact = f64::from(x).sin_cos();
            worst = worst.max((f64::from(sin.x) - exact.0).abs()).max((f64::from(cos.y) - exact.1).abs());
        }
        assert!(worst < 2e-7, "{worst}");
        assert_eq!(sin_cos(Vec4::ZERO), (Vec4::ZERO, Vec4::ONE));
    }
}
