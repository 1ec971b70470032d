//! USD: grooms as BasisCurves, in text, crates and packages.

pub(crate) mod read;
pub(crate) mod write;
