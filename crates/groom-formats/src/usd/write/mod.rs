//! USD as text: one BasisCurves prim of linear curves, at `/Groom/Strands`.
//!
//! | groom | USD |
//! |---|---|
//! | points | `points`, `curveVertexCounts`, `extent` (points +- half the largest width) |
//! | radius | `widths`: diameters, always per vertex |
//! | color | `primvars:displayColor` (linear) |
//! | transparency | `primvars:displayOpacity` = 1 - transparency |
//! | id, root_uv | `primvars:id`, `primvars:st` |
//! | any other | `primvars:NAME` |
//! | constant, per strand, per vertex | interpolation `constant`, `uniform`, `vertex` |
//! | unit, up axis | `metersPerUnit`, `upAxis`: nothing is turned or scaled |
//!
//! The curves are polylines, as grooms are, so `type` is `linear`; `basis` and `wrap` then mean nothing
//! but are authored too, because readers differ on the fallbacks.

mod crate_file;
mod primvar;
mod stage;

pub(crate) use crate_file::{write as write_crate, write_animation};
pub(crate) use stage::write as write_usda;
