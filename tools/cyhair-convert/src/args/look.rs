//! What the strands should look like.

use std::path::PathBuf;

use clap::Args;
use glam::Vec3;
use groom::{Expression, Ramp};

use super::values::{V, color, expression, ramp, setting, width};

/// Options that colour the strands, say how wide they are and set their attributes; [`crate::edit`] has
/// their order.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Look")]
#[group(id = "look", multiple = true)]
pub(crate) struct Look {
    /// One colour for all: linear r,g,b, each from 0 to 1
    #[arg(long, value_name = "R,G,B", value_parser = color,
        conflicts_with_all = ["root_color", "tip_color", "color_from_texture"])]
    pub(crate) color: Option<Vec3>,

    /// Colour at the roots, running to --tip-color
    #[arg(long, value_name = "R,G,B", value_parser = color, requires = "tip_color",
        conflicts_with = "color_from_texture")]
    pub(crate) root_color: Option<Vec3>,

    /// Colour at the tips
    #[arg(long, value_name = "R,G,B", value_parser = color, requires = "root_color")]
    pub(crate) tip_color: Option<Vec3>,

    /// Colours from a picture (.png as sRGB, or .hdr) at the strands' root_uv; it repeats outside 0..1
    #[arg(long, value_name = "PICTURE")]
    pub(crate) color_from_texture: Option<PathBuf>,

    /// Which way v runs in that picture: up from the bottom (USD, Blender, Houdini) or down from the top
    /// (glTF) [default: up]
    #[arg(long, value_name = "WAY", requires = "color_from_texture")]
    pub(crate) texture_v: Option<V>,

    /// One width (a diameter, in the output's numbers) for all: 0 or more
    #[arg(long, value_name = "WIDTH", value_parser = width, allow_hyphen_values = true,
        conflicts_with_all = ["root_width", "tip_width"])]
    pub(crate) width: Option<f32>,

    /// Width at the roots, running to --tip-width
    #[arg(long, value_name = "WIDTH", value_parser = width, allow_hyphen_values = true, requires = "tip_width")]
    pub(crate) root_width: Option<f32>,

    /// Width at the tips
    #[arg(long, value_name = "WIDTH", value_parser = width, allow_hyphen_values = true, requires = "root_width")]
    pub(crate) tip_width: Option<f32>,

    /// Multiply the widths along the strand, 0 root to 1 tip: 0:1,0.5:0.8,1:0.2
    #[arg(long, value_name = "ALONG:FACTOR,...", value_parser = ramp)]
    pub(crate) width_ramp: Option<Ramp>,

    /// Melanin, 0 white to 1 black, as a number or by strand as 0.6~0.1: attribute melanin
    #[arg(long, value_name = "VALUE", value_parser = expression, allow_hyphen_values = true)]
    pub(crate) melanin: Option<Expression>,

    /// Redness of the melanin, 0 to 1, as a number or by strand: attribute redness
    #[arg(long, value_name = "VALUE", value_parser = expression, allow_hyphen_values = true)]
    pub(crate) redness: Option<Expression>,

    /// Set an attribute: a number, 0.6~0.1 (another one from 0.5 to 0.7 for each strand, by its id), two or
    /// three of them as 1,2,3, or int:3; `width` is a diameter; may be given again
    #[arg(long, value_name = "NAME=VALUE", value_parser = setting)]
    pub(crate) set: Vec<(String, Expression)>,

    /// Seed of what is random: a~b and the first of the --guides [default: 0]
    #[arg(long, value_name = "SEED")]
    pub(crate) seed: Option<u64>,
}
