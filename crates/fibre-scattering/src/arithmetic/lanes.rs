//! Four values in step, one per lobe: one vector where the machine has them.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::{DVec4, Vec4};

use crate::arithmetic::arctangent;
use crate::arithmetic::bessel;
use crate::arithmetic::exponential;
use crate::arithmetic::logarithm;
use crate::arithmetic::sine;

/// Four numbers of one precision.
pub(crate) trait Lanes<T>:
    Copy
    + Debug
    + From<[T; 4]>
    + Into<[T; 4]>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn splat(value: T) -> Self;
    /// Whole numbers, exactly. By reference: handed over as a value the four would be one, to take apart again.
    fn of_counts(counts: &[u16; 4]) -> Self;
    /// `self * factor + term`, rounded once where that costs nothing.
    fn times_plus(self, factor: Self, term: Self) -> Self;
    /// `exp(-self)` of values of at least 0.
    fn exp_of_minus(self) -> Self;
    /// `exp(-self)` and `1 - exp(-self)` of values of at least 0, both to their last digits.
    fn fall_and_rest(self) -> (Self, Self);
    /// `exp(-self) exp(-x) I0(x)`, both at least 0.
    fn exp_of_minus_by_i0(self, x: Self) -> Self;
    /// The angle in [0, pi] between (1, 0) and (self, y), whichever the sign of `y`.
    fn angle_to(self, y: Self) -> Self;
    /// The natural logarithm of values above 0; minus infinity at 0.
    fn ln(self) -> Self;
    /// Sine and cosine of angles within two turns.
    fn sin_cos(self) -> (Self, Self);
}

impl Lanes<f32> for Vec4 {
    #[inline(always)]
    fn splat(value: f32) -> Self {
        Vec4::splat(value)
    }
    #[inline(always)]
    fn of_counts(&[a, b, c, d]: &[u16; 4]) -> Self {
        // Through 32 bits with a sign, the only whole numbers vector units turn to floats.
        let float = |count: u16| i32::from(count) as f32;
        Vec4::new(float(a), float(b), float(c), float(d))
    }
    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        fused(self, factor, term)
    }
    #[inline(always)]
    fn exp_of_minus(self) -> Self {
        exponential::exp_of_minus(self)
    }
    #[inline(always)]
    fn fall_and_rest(self) -> (Self, Self) {
        exponential::fall_and_rest(self)
    }
    #[inline(always)]
    fn exp_of_minus_by_i0(self, x: Self) -> Self {
        bessel::exp_of_minus_by_i0(self, x)
    }
    #[inline(always)]
    fn angle_to(self, y: Self) -> Self {
        arctangent::angle(y, self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        logarithm::ln(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sine::sin_cos(self)
    }
}

/// What the four values are made of by a function of one, two.
fn each(x: DVec4, y: DVec4, f: impl Fn(f64, f64) -> f64) -> DVec4 {
    DVec4::new(f(x.x, y.x), f(x.y, y.y), f(x.z, y.z), f(x.w, y.w))
}

impl Lanes<f64> for DVec4 {
    fn splat(value: f64) -> Self {
        DVec4::splat(value)
    }
    fn of_counts(&[a, b, c, d]: &[u16; 4]) -> Self {
        DVec4::new(a.into(), b.into(), c.into(), d.into())
    }
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }
    fn exp_of_minus(self) -> Self {
        each(self, self, |x, _| (-x).exp())
    }
    fn fall_and_rest(self) -> (Self, Self) {
        (self.exp_of_minus(), each(self, self, |x, _| -(-x).exp_m1()))
    }
    fn exp_of_minus_by_i0(self, x: Self) -> Self {
        each(self, x, |fall, x| (-fall).exp() * bessel::scaled_i0_double(x))
    }
    fn angle_to(self, y: Self) -> Self {
        each(y, self, |y, x| y.abs().atan2(x))
    }
    fn ln(self) -> Self {
        each(self, self, |x, _| x.ln())
    }
    fn sin_cos(self) -> (Self, Self) {
        (each(self, self, |x, _| x.sin()), each(self, self, |x, _| x.cos()))
    }
}

/// `x * factor + term` in one instruction where the target has it. Elsewhere one rounding for two would be a
/// call into the system's library, thirty times as slow.
#[inline(always)]
pub(crate) fn fused(x: Vec4, factor: Vec4, term: Vec4) -> Vec4 {
    if cfg!(target_feature = "fma") { x.mul_add(factor, term) } else { x * factor + term }
}

/// The root of each: written out, since `glam` has none and `map` would not become one vector.
#[inline(always)]
pub(crate) fn sqrt(x: Vec4) -> Vec4 {
    let [a, b, c, d] = x.to_array();
    Vec4::new(a.sqrt(), b.sqrt(), c.sqrt(), d.sqrt())
}

/// The polynomial whose coefficients are given from the highest power down.
#[inline(always)]
pub(crate) fn horner<const N: usize>(coefficients: &[f32; N], x: Vec4) -> Vec4 {
    let mut sum = Vec4::splat(coefficients[0]);
    for &coefficient in &coefficients[1..] {
        sum = fused(sum, x, Vec4::splat(coefficient));
    }
    sum
}

/// The bits of each, as whole numbers.
#[inline(always)]
pub(crate) fn bits(x: Vec4) -> [u32; 4] {
    let [a, b, c, d] = x.to_array();
    [a.to_bits(), b.to_bits(), c.to_bits(), d.to_bits()]
}

/// The number of each pattern of bits.
#[inline(always)]
pub(crate) fn of_bits([a, b, c, d]: [u32; 4]) -> Vec4 {
    Vec4::new(f32::from_bits(a), f32::from_bits(b), f32::from_bits(c), f32::from_bits(d))
}
