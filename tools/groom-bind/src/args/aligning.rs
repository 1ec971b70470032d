//! How the groom comes to lie on the mesh.

use clap::{Args, ValueEnum, value_parser};
use glam::{DMat4, DVec3};
use groom::UpAxis;
use groom_formats::ReadOptions;

use super::values::{matrix, over_zero, vector};

/// An axis on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Up {
    Y,
    Z,
}

impl From<Up> for UpAxis {
    fn from(up: Up) -> Self {
        match up {
            Up::Y => UpAxis::Y,
            Up::Z => UpAxis::Z,
        }
    }
}

/// How the groom is read and brought into the mesh's numbers.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "The groom, and how it comes to lie on the mesh (in this order)")]
pub(crate) struct Aligning {
    /// Up axis of the groom, where its file does not say [default: z for HAIR and text, else y]; it is turned to
    /// that of the mesh (y, unless a USD mesh says z)
    #[arg(long, value_name = "AXIS")]
    pub(crate) up: Option<Up>,

    /// Metres in one unit of the groom (over 0; Yuksel's models: 0.00254), where its file does not say; where
    /// groom and mesh both say, the groom is scaled to the mesh's unit
    #[arg(long, value_name = "METRES", value_parser = over_zero)]
    pub(crate) meters_per_unit: Option<f64>,

    /// Multiply points and widths, after that (over 0) [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = over_zero, allow_hyphen_values = true)]
    pub(crate) scale: Option<f64>,

    /// Move the points, in the mesh's numbers
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) translate: Option<DVec3>,

    /// All of that at once: the matrix from the groom's numbers to the mesh's, row by row, for column vectors (the
    /// fourth number of each row moves; the last row is 0,0,0,1); widths go by the cube root of its determinant
    #[arg(long, value_name = "16 NUMBERS", value_parser = matrix, allow_hyphen_values = true,
        conflicts_with_all = ["up", "meters_per_unit", "scale", "translate"])]
    pub(crate) matrix: Option<DMat4>,

    /// Mend what is odd or broken in the groom, as far as that can be done, and say what was done
    #[arg(long)]
    pub(crate) repair: bool,

    /// Points of every strand in a file that is a bare list of points (.ply; 1 or more)
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) points_per_strand: Option<u32>,
}

impl Aligning {
    pub(crate) fn read_options(&self) -> ReadOptions {
        ReadOptions {
            up_axis: self.up.map(Into::into),
            meters_per_unit: self.meters_per_unit,
            repair: self.repair,
            points_per_strand: self.points_per_strand,
            ..ReadOptions::default()
        }
    }
}
