//! What to do to the strands.

use clap::{Args, value_parser};
use glam::{DMat4, DVec3};

use super::Up;
use super::values::{Smooth, Turn, factor, length, matrix, smooth, step, turn, vector};

/// Options that thin out, move and reshape the strands; [`crate::edit`] has their order.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Strands")]
#[group(id = "strands", multiple = true)]
pub(crate) struct Strands {
    /// Keep every Nth strand (1 or more) [default: 1, all]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) stride: Option<u32>,

    /// Keep at most N strands, evenly spread (1 or more) [default: all]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) max_strands: Option<u32>,

    /// Keep strands of at least this length (0 or more, in the output's numbers) [default: all]
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_hyphen_values = true)]
    pub(crate) min_length: Option<f32>,

    /// Keep strands of at most this length (0 or more, in the output's numbers) [default: all]
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_hyphen_values = true)]
    pub(crate) max_length: Option<f32>,

    /// Multiply points, widths and velocities (over 0) [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_hyphen_values = true)]
    pub(crate) scale: Option<f32>,

    /// Turn about x, y, z or an axis as 1,1,0 through the origin, by degrees: z:90; may be given again
    #[arg(long, value_name = "AXIS:DEGREES", value_parser = turn, allow_hyphen_values = true)]
    pub(crate) rotate: Vec<Turn>,

    /// Move the points
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) translate: Option<DVec3>,

    /// Transform by a matrix for column vectors, row by row (the last four numbers are 0,0,0,1); widths
    /// go by the cube root of its determinant
    #[arg(long, value_name = "16 NUMBERS", value_parser = matrix, allow_hyphen_values = true,
        conflicts_with_all = ["scale", "rotate", "translate"])]
    pub(crate) matrix: Option<DMat4>,

    /// Turn the groom so that this axis is up in the output [default: as the input; glTF: y]
    #[arg(long, value_name = "AXIS")]
    pub(crate) up: Option<Up>,

    /// Make tips roots and roots tips
    #[arg(long)]
    pub(crate) reverse: bool,

    /// Smooth along the strand N times, as strongly as said (0 to 1); roots and tips stay
    /// [default strength: 0.5]
    #[arg(long, value_name = "N[:STRENGTH]", value_parser = smooth)]
    pub(crate) smooth: Option<Smooth>,

    /// Let smoothing keep the segments' lengths and move the tips
    #[arg(long, requires = "smooth")]
    pub(crate) keep_length: bool,

    /// Give every strand N points, evenly spaced (2 or more) [default: as they are]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(2..),
        conflicts_with = "resample_step")]
    pub(crate) resample: Option<u32>,

    /// Give every strand points no farther apart than this (over 0, in the output's numbers)
    #[arg(long, value_name = "LENGTH", value_parser = step, allow_hyphen_values = true)]
    pub(crate) resample_step: Option<f32>,

    /// Mark N strands, spread by place and shape, as guides: attribute guide, 1 or 0 (1 or more)
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) guides: Option<u32>,

    /// Keep the guides only: those of --guides, or those the input marks
    #[arg(long)]
    pub(crate) guides_only: bool,

    /// Say for every strand the id of its guide: attribute closest_guide
    #[arg(long, requires = "guides")]
    pub(crate) closest_guide: bool,

    /// Leave out points as long as points and widths stay within this distance (0 or more, in the output's
    /// numbers) [default: none]
    #[arg(long, value_name = "DISTANCE", value_parser = length, allow_hyphen_values = true)]
    pub(crate) tolerance: Option<f32>,

    /// Round positions to a grid of 2^BITS steps along the groom's longest side (4 to 24) [default: not]
    #[arg(long, value_name = "BITS", value_parser = value_parser!(u32).range(4..=24))]
    pub(crate) quantize: Option<u32>,
}
