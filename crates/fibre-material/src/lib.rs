//! Materials of hair and fur as people describe them, and what they come to on a groom.

mod color;
mod error;
mod material;
mod varying;

pub use color::HairColor;
pub use error::MaterialError;
pub use material::{Dressed, Field, Material};
pub use varying::Varying;
