//! The two precisions the model is written for.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::{DVec4, Vec4};

use crate::arithmetic::lanes::Lanes;

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
    /// Four of them, one per lobe.
    type Four: Lanes<Self>;

    fn of(value: f64) -> Self;
    /// The whole part of a value of at least 0 and below 2^31, to count with and to reckon with.
    fn whole(self) -> (usize, Self);
    /// The same in double precision.
    fn double(self) -> f64;
    fn abs(self) -> Self;
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn exp_m1(self) -> Self;
    fn asin(self) -> Self;
    fn atan2(self, x: Self) -> Self;
    fn sin_cos(self) -> (Self, Self);
}

macro_rules! real {
    ($real:ident, $four:ident) => {
        impl Real for $real {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const PI: Self = std::$real::consts::PI;
            const TAU: Self = std::$real::consts::TAU;
            type Four = $four;

            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $real
            }
            fn double(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn whole(self) -> (usize, Self) {
                // Through 32 bits with a sign, the only whole numbers vector units turn to and from.
                let whole = self as i32;
                (whole as usize, whole as $real)
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
            fn asin(self) -> Self {
                $real::asin(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                let [angle, ..]: [Self; 4] = Lanes::angle_to($four::splat(x), $four::splat(self)).into();
                angle.copysign(self)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = Lanes::sin_cos($four::splat(self));
                (sin.x, cos.x)
            }
        }
    };
}

real!(f32, Vec4);
real!(f64, DVec4);
