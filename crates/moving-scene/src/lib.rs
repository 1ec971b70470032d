//! What moves in a picture, frame by frame, as the renderer takes it.
//!
//! | from | by | becomes |
//! |---|---|---|
//! | a groom's file | [`GroomAt`] | strands at a frame, and their way through the shutter |
//! | a mesh's file | [`FilmedMesh`] | a posed mesh, and its way; a piece for each base colour ([`by_base_color`]) |
//! | a still groom and a mesh | [`BoundGroom`] | strands that go with the mesh |
//!
//! [`Exposure`] says how long the shutter is open, and what strands are blurred by. Frames are those of the animation;
//! what is asked for outside of it stands as at the nearest frame, which is told.
//!
//! Every frame is the same whatever frames were asked for before it: many machines may share them.

mod base_colors;
mod bound_groom;
mod error;
mod exposure;
mod filmed_mesh;
mod groom_at;
mod outside;
#[cfg(test)]
mod tests;
mod way;

pub use base_colors::by_base_color;
pub use bound_groom::{Bindings, BoundGroom, Carried};
pub use error::MovingSceneError;
pub use exposure::{Exposure, USUAL_RATE};
pub use filmed_mesh::{FilmedMesh, MeshAsked, animation_named, is_stage};
pub use groom_at::GroomAt;
pub use outside::outside;
