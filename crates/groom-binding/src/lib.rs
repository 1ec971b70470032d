//! Strands bound to a surface and carried by it as it moves.
//!
//! A strand is bound by its root: triangle, place in it, height over it, and the frame of the surface there, all
//! of the pose the strand was made for. At another pose the same place gives another frame, and the strand goes
//! with it. Knows meshes by their triangles and poses, not by their files, and no light.

mod error;

pub use error::BindingError;
