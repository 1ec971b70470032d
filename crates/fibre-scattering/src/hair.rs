//! Hair after Chiang et al. 2016, and what goes beyond it: layers, a film of water, ellipses, the far field.

pub(crate) mod attenuation;
pub(crate) mod azimuthal;
pub(crate) mod bcsdf;
pub(crate) mod ellipse;
pub(crate) mod far_cells;
pub(crate) mod far_field;
pub(crate) mod fibre;
pub(crate) mod longitudinal;
pub(crate) mod parameters;
pub(crate) mod reference;
pub(crate) mod surface;
