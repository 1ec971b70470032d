//! glTF 2.0: every strand as line segments of one indexed LINES primitive.
//!
//! glTF has no ratified curves, and a LINE_STRIP a strand would be tens of thousands of draw calls. The
//! attributes are POSITION, COLOR_0 (linear, 8 bits a channel, alpha = 1 - transparency; left out when
//! the groom has neither; blended where any is below 1) and `_WIDTH`, the diameter: a single custom attribute, because Blender 5.0.1
//! mixes up several of different size. Y is up and the unit is the metre, so points and widths are
//! turned and scaled.

mod bytes;
mod document;
mod plan;
mod read;

pub(crate) use plan::{Plan, write_glb};
pub(crate) use read::read;
