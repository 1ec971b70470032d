//! What the input does not say of itself.

use clap::Args;
use groom_formats::ReadOptions;

use super::values::{Up, unit};

/// How the input is read.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Reading")]
pub(crate) struct Reading {
    /// Up axis of the input, where the file does not say [default: z for HAIR and text; --formats]
    #[arg(long, value_name = "AXIS")]
    pub(crate) input_up: Option<Up>,

    /// Metres in one unit of the input (over 0; Yuksel's models: 0.00254) [default: what the file says, or 1]
    #[arg(long, value_name = "METRES", value_parser = unit)]
    pub(crate) meters_per_unit: Option<f64>,

    /// Mend what is odd or broken in the input, as far as that can be done, and say what was done
    #[arg(long)]
    pub(crate) repair: bool,

    /// Points of every strand in a file that is a bare list of points (.ply; 1 or more)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) points_per_strand: Option<u32>,

    /// How far a polyline may lie from the cubic curve it is read from (over 0, in the input's units)
    /// [default: a thousandth of the curve's length]
    #[arg(long, value_name = "DISTANCE", value_parser = distance)]
    pub(crate) curve_error: Option<f32>,

    /// Read an animated input at this frame only [default: every frame if the output can move, else the first]
    #[arg(long, value_name = "FRAME", value_parser = frame, allow_hyphen_values = true)]
    pub(crate) time: Option<f64>,

    /// Let usd-core flatten a USD input first: composition, skins, blend shapes (needs Python with usd-core)
    #[arg(long)]
    pub(crate) bake: bool,
}

impl Reading {
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            up_axis: self.input_up.map(Into::into),
            meters_per_unit: self.meters_per_unit,
            repair: self.repair,
            points_per_strand: self.points_per_strand,
            curve_error: self.curve_error,
            time: self.time,
            ..ReadOptions::default()
        }
    }
}

fn distance(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|v: &f32| v.is_finite() && *v > 0.0).ok_or("expected a number over 0".into())
}

fn frame(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v: &f64| v.is_finite()).ok_or("expected a frame number".into())
}
