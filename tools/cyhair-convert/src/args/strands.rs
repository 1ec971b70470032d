//! What to do to the strands.

use clap::{Args, value_parser};

use super::Up;
use super::values::factor;

/// Options that thin out, move or resample the strands; done in the order of the help.
#[derive(Args, Debug)]
#[command(next_help_heading = "Strands")]
#[group(id = "strands", multiple = true)]
pub(crate) struct Strands {
    /// Keep every Nth strand (1 or more) [default: 1, all]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) stride: Option<u32>,

    /// Keep at most N strands, evenly spread (1 or more; after --stride) [default: all]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) max_strands: Option<u32>,

    /// Give every strand N points, evenly spaced (2 or more) [default: as they are]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(2..))]
    pub(crate) resample: Option<u32>,

    /// Multiply points and widths (over 0) [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    pub(crate) scale: Option<f32>,

    /// Turn the groom so that this axis is up in the output [default: as the input; glTF: y]
    #[arg(long, value_name = "AXIS")]
    pub(crate) up: Option<Up>,
}
