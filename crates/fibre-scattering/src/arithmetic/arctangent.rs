//! Four angles at once, in vector arithmetic.

use glam::Vec4;

use crate::arithmetic::lanes::{fused, horner};

/// The angle in [0, pi] between (1, 0) and (x, y) of each, whichever the sign of `y`, within 3e-7 of its own
/// size; 0 at the origin.
///
/// A density around a lobe's centre needs no sign, and an angle that is small needs to be right in its own
/// last digits: smooth lobes lie within 1e-4.
#[inline(always)]
pub(crate) fn angle(y: Vec4, x: Vec4) -> Vec4 {
    // atan(t) / t - 1 over t^2 in [0, 1], as a polynomial of t^2 without its constant: the least relative
    // error of that degree is 1.1e-7 (Lawson's iteration).
    const ARC: [f32; 7] = [
        -0.004_822_531_7,
        0.024_734_054,
        -0.060_203_117,
        0.099_684_72,
        -0.140_413_27,
        0.199_742_14,
        -0.333_323_92,
    ];
    let (across, along) = (y.abs(), x.abs());
    let ratio = across.min(along) / across.max(along).max(Vec4::splat(f32::MIN_POSITIVE));
    let square = ratio * ratio;
    let octant = fused(horner(&ARC, square) * square, ratio, ratio);
    let quadrant =
        Vec4::select(across.cmpgt(along), Vec4::splat(std::f32::consts::FRAC_PI_2) - octant, octant);
    Vec4::select(x.cmplt(Vec4::ZERO), Vec4::splat(std::f32::consts::PI) - quadrant, quadrant)
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use super::angle;

    #[test]
    fn agrees_with_double_precision() {
        let mut worst = 0.0_f64;
        for step in 0..400_000 {
            let turn = f64::from(step) * 1e-5 - 2.0;
            for (y, x) in [turn.sin_cos(), (10.0_f64.powf(-2.0 - turn), 0.7)] {
                let (y, x) = ((0.3 * y) as f32, (0.3 * x) as f32);
                let exact = f64::from(y).abs().atan2(f64::from(x));
                let found = f64::from(angle(Vec4::splat(y), Vec4::splat(x)).x);
                worst = worst.max((found - exact).abs() / exact.max(1e-30));
            }
        }
        assert!(worst < 3e-7, "{worst}");
        let (half, quarter) = (std::f32::consts::PI, std::f32::consts::FRAC_PI_2);
        for (y, x, exact) in [(0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, quarter), (0.0, -2.0, half)] {
            assert_eq!(angle(Vec4::splat(y), Vec4::splat(x)).x, exact);
        }
    }
}
