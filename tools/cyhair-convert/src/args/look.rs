//! What the strands should look like.

use clap::Args;
use glam::Vec3;

use super::values::{color, width};

/// Options that colour the strands and say how wide they are.
#[derive(Args, Debug)]
#[command(next_help_heading = "Look")]
#[group(id = "look", multiple = true)]
pub(crate) struct Look {
    /// One colour for all: linear r,g,b, each from 0 to 1
    #[arg(long, value_name = "R,G,B", value_parser = color,
        conflicts_with_all = ["root_color", "tip_color"])]
    pub(crate) color: Option<Vec3>,

    /// Colour at the roots, running to --tip-color
    #[arg(long, value_name = "R,G,B", value_parser = color,
        requires = "tip_color")]
    pub(crate) root_color: Option<Vec3>,

    /// Colour at the tips
    #[arg(long, value_name = "R,G,B", value_parser = color,
        requires = "root_color")]
    pub(crate) tip_color: Option<Vec3>,

    /// One width (a diameter, in the output's numbers) for all: 0 or more
    #[arg(long, value_name = "WIDTH", value_parser = width,
        conflicts_with_all = ["root_width", "tip_width"])]
    pub(crate) width: Option<f32>,

    /// Width at the roots, running to --tip-width
    #[arg(long, value_name = "WIDTH", value_parser = width,
        requires = "tip_width")]
    pub(crate) root_width: Option<f32>,

    /// Width at the tips
    #[arg(long, value_name = "WIDTH", value_parser = width,
        requires = "root_width")]
    pub(crate) tip_width: Option<f32>,
}
