//! The two precisions the model is written for.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::{bessel, exponential};

/// One value per lobe. Written out, and not `array::from_fn` or `map`, which stay calls and keep the
/// four from becoming one vector.
#[inline(always)]
pub(crate) fn four<T>(value: impl Fn(usize) -> T) -> [T; 4] {
    [value(0), value(1), value(2), value(3)]
}

/// `f32` for rendering, `f64` to know how good that is.
pub(crate) trait Real:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    const ZERO: Self;
    const ONE: Self;
    const TWO: Self;
    const PI: Self;
    const TAU: Self;
    /// What `TAU` is short of a full turn.
    const TAU_REST: Self;

    fn of(value: f64) -> Self;
    fn abs(self) -> Self;
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn exp_m1(self) -> Self;
    fn ln(self) -> Self;
    fn ln_1p(self) -> Self;
    fn asin(self) -> Self;
    fn atan2(self, x: Self) -> Self;
    fn sin_cos(self) -> (Self, Self);
    /// `exp(x)` of each `x <= 0`.
    fn exp_four(x: [Self; 4]) -> [Self; 4];
    /// `exp(-x) I0(x)` of each `x >= 0`.
    fn scaled_bessel_i0_four(x: [Self; 4]) -> [Self; 4];
}

macro_rules! real {
    ($real:ident, $tau_rest:literal, $exp:expr, $bessel:expr) => {
        impl Real for $real {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const PI: Self = std::$real::consts::PI;
            const TAU: Self = std::$real::consts::TAU;
            const TAU_REST: Self = $tau_rest;

            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $real
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $real::abs(self)
            }
            fn max(self, other: Self) -> Self {
                $real::max(self, other)
            }
            fn min(self, other: Self) -> Self {
                $real::min(self, other)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $real::sqrt(self)
            }
            fn exp(self) -> Self {
                $real::exp(self)
            }
            fn exp_m1(self) -> Self {
                $real::exp_m1(self)
            }
            fn ln(self) -> Self {
                $real::ln(self)
            }
            fn ln_1p(self) -> Self {
                $real::ln_1p(self)
            }
            fn asin(self) -> Self {
                $real::asin(self)
            }
            fn atan2(self, x: Self) -> Self {
                $real::atan2(self, x)
            }
            fn sin_cos(self) -> (Self, Self) {
                $real::sin_cos(self)
            }
            #[inline(always)]
            fn exp_four(x: [Self; 4]) -> [Self; 4] {
                $exp(x)
            }
            #[inline(always)]
            fn scaled_bessel_i0_four(x: [Self; 4]) -> [Self; 4] {
                $bessel(x)
            }
        }
    };
}

real!(f32, -1.748_455_6e-7, |x: [f32; 4]| exponential::exp_four(x.into()).to_array(), |x: [f32; 4]| {
    bessel::scaled_i0_four(x.into()).to_array()
});
real!(f64, 2.449_293_598_294_706_4e-16, |x: [f64; 4]| four(|p| x[p].exp()), |x: [f64; 4]| x
    .map(bessel::scaled_i0_double));
