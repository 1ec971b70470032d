//! Sines that are the same bits on every machine, which those of the system's library are not.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Sine of `x`, right to 1e-9 before it is rounded to single precision.
pub(crate) fn sin(x: f64) -> f32 {
    let turns = (x / TAU).round();
    let mut x = x - turns * TAU;
    // The series is short only near zero.
    if x > FRAC_PI_2 {
        x = PI - x;
    } else if x < -FRAC_PI_2 {
        x = -PI - x;
    }
    let square = x * x;
    let (mut term, mut sum) = (x, x);
    for n in [6.0, 20.0, 42.0, 72.0, 110.0, 156.0] {
        term *= -square / n;
        sum += term;
    }
    sum as f32
}

/// Cosine of `x`, as [`sin`].
pub(crate) fn cos(x: f64) -> f32 {
    sin(x + FRAC_PI_2)
}

#[cfg(test)]
mod tests {
    #[test]
    fn agrees_with_the_system() {
        for i in -2000..2000 {
            let x = f64::from(i) * 0.0173;
            assert!((f64::from(super::sin(x)) - x.sin()).abs() < 4e-8, "{x}");
            assert!((f64::from(super::cos(x)) - x.cos()).abs() < 4e-8, "{x}");
        }
    }
}
