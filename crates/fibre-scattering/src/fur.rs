//! Fur: hair around a medulla that scatters, and the table of where that light leaves.

pub(crate) mod bcsdf;
pub(crate) mod bytes;
pub(crate) mod counts;
pub(crate) mod density;
pub(crate) mod grid;
pub(crate) mod knots;
pub(crate) mod medulla;
pub(crate) mod model;
pub(crate) mod paths;
pub(crate) mod reference;
pub(crate) mod row;
pub(crate) mod scattered;
pub(crate) mod table;
pub(crate) mod walk;
pub(crate) mod yan;
pub(crate) mod yan_medulla;
