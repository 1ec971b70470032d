//! What can be wrong with a sweep.

/// A sweep that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// There is no row of that name.
    #[error("there is no row `{name}`: expected one of {known}")]
    Row {
        /// The name.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A cell's size is out of its range.
    #[error("size of a cell is {found}, expected 16..=4096 pixels")]
    Size {
        /// Pixels along an edge.
        found: u32,
    },
    /// The material of a cell is out of its range.
    #[error(transparent)]
    Material(#[from] fibre_material::MaterialError),
    /// A picture could not be rendered.
    #[error(transparent)]
    Render(#[from] hair_render::RenderError),
}
