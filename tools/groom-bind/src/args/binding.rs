//! How roots find their places.

use clap::{Args, ValueEnum};

use super::values::distance;

/// How strands are bound.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Binding")]
pub(crate) struct BindingOptions {
    /// How a strand finds its place on the mesh
    #[arg(long, value_name = "WAY", default_value = "nearest")]
    pub(crate) bind_by: Place,

    /// Tell of strands whose root is farther from the mesh than this (0 or more) [default: none is told of]
    #[arg(long, value_name = "DISTANCE", value_parser = distance)]
    pub(crate) limit: Option<f64>,

    /// What to do with strands beyond the limit: bind them all the same, move them onto the mesh, or leave them out
    /// [default: keep]
    #[arg(long, value_name = "WHAT", requires = "limit")]
    pub(crate) beyond: Option<Far>,
}

/// What says where a strand belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Place {
    /// The place nearest to its root
    Nearest,
    /// Its attribute root_uv, looked up on the mesh (v up)
    Uv,
    /// Its attribute root_triangle: the number of a triangle of the mesh, from 0
    Id,
}

/// What becomes of strands beyond the limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Far {
    Keep,
    Snap,
    Drop,
}
