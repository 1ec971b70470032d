//! Numbers that arrays can be read as.

use bytemuck::Pod;

use crate::Scalar;

/// A type that the components of an array can be read as: `f32`, `f64`, `i32`, `i64`.
///
/// Whole numbers can be read as any of them if they fit, others only as `f32` or `f64`.
pub trait Number: Pod + Default {
    /// What needs no conversion.
    #[doc(hidden)]
    const SCALAR: Scalar;
    /// The nearest number; `None` where a fraction would be lost.
    #[doc(hidden)]
    fn from_float(value: f64) -> Option<Self>;
    /// The number; `None` if it does not fit.
    #[doc(hidden)]
    fn from_integer(value: i64) -> Option<Self>;
}

impl Number for f32 {
    const SCALAR: Scalar = Scalar::Float;
    #[inline]
    fn from_float(value: f64) -> Option<Self> {
        Some(value as f32)
    }
    #[inline]
    fn from_integer(value: i64) -> Option<Self> {
        Some(value as f32)
    }
}

impl Number for f64 {
    const SCALAR: Scalar = Scalar::Double;
    #[inline]
    fn from_float(value: f64) -> Option<Self> {
        Some(value)
    }
    #[inline]
    fn from_integer(value: i64) -> Option<Self> {
        Some(value as f64)
    }
}

impl Number for i32 {
    const SCALAR: Scalar = Scalar::Int;
    #[inline]
    fn from_float(_: f64) -> Option<Self> {
        None
    }
    #[inline]
    fn from_integer(value: i64) -> Option<Self> {
        value.try_into().ok()
    }
}

impl Number for i64 {
    const SCALAR: Scalar = Scalar::Int64;
    #[inline]
    fn from_float(_: f64) -> Option<Self> {
        None
    }
    #[inline]
    fn from_integer(value: i64) -> Option<Self> {
        Some(value)
    }
}
