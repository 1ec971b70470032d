//! What can be wrong with what moves.

use std::path::PathBuf;

use groom::GroomError;
use groom_binding::BindingError;
use groom_formats::FormatError;
use hair_render::RenderError;
use moving_mesh::MeshError;

/// Something that cannot be shown at a frame.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MovingSceneError {
    /// The groom's file.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The mesh's file.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Motion that cannot be shown.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Strands that cannot be bound.
    #[error(transparent)]
    Binding(#[from] BindingError),
    /// Strands that cannot be left out.
    #[error("beyond: {0}")]
    Groom(#[from] GroomError),
    /// A file that does not hold what strands are to be blurred by.
    #[error("blur {asked}: {} has no {missing}; expected {expected}", path.display())]
    NoMotion {
        /// The groom.
        path: PathBuf,
        /// What was asked for.
        asked: &'static str,
        /// What it would need.
        missing: &'static str,
        /// What it can be blurred by.
        expected: &'static str,
    },
    /// A frame that is no number.
    #[error("frame is {0}, expected a finite number")]
    Frame(f64),
    /// A limit beyond which every strand lies.
    #[error("`beyond: drop` leaves no strand: all {strands} are farther than {limit} from the mesh")]
    NothingBound {
        /// How many strands there are.
        strands: usize,
        /// The limit, in the mesh's unit.
        limit: f64,
    },
}
