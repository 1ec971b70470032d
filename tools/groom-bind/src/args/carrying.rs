//! How strands follow.

use clap::{Args, ValueEnum};

use super::values::{distance, over_zero};

/// How strands are carried.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Carrying")]
pub(crate) struct Carrying {
    /// How a strand follows its place
    #[arg(long, value_name = "HOW", default_value = "rigid")]
    pub(crate) mode: Mode,

    /// Blended strands keep the lengths of their segments instead of stretching with the mesh
    #[arg(long)]
    pub(crate) keep_length: bool,

    /// Push points out of the mesh where they enter it, this far off it (0 or more) [default: 0]; segments keep
    /// their length
    #[arg(long, value_name = "DISTANCE", value_parser = distance, num_args = 0..=1, require_equals = true,
        default_missing_value = "0")]
    pub(crate) avoid_penetration: Option<f64>,

    /// Strands whose root moves farther than this from frame to frame jump: they get no velocity (over 0)
    /// [default: none does]
    #[arg(long, value_name = "DISTANCE", value_parser = over_zero)]
    pub(crate) teleport: Option<f64>,
}

/// How a strand follows its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    /// As one piece: lengths and shape are kept
    Rigid,
    /// The root rigidly, the tip with the mesh around it: follows stretch
    Blended,
}
