//! Single and double precision, four values in step, and the functions the models need of them.

pub(crate) mod arctangent;
pub(crate) mod bessel;
pub(crate) mod exponential;
pub(crate) mod lanes;
pub(crate) mod logarithm;
pub(crate) mod real;
pub(crate) mod sine;
