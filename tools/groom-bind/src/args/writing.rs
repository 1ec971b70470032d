//! What the output should be like.

use clap::{Args, ValueEnum};
use groom_formats::Dialect;

/// How the output is written.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Writing")]
pub(crate) struct Writing {
    /// Write the strands at rest, bound to the mesh's joints, and the joints' motion, instead of points a frame
    /// (.usda .usdc .usdz: UsdSkel; .gltf .glb: skinned lines)
    #[arg(long, conflicts_with_all = ["avoid_penetration", "mode", "keep_length", "shutter_samples", "accelerations",
        "velocity"])]
    pub(crate) as_skinned: bool,

    /// The program the file is for, where readers differ (USD, Alembic)
    #[arg(long = "for", value_name = "PROGRAM")]
    pub(crate) dialect: Option<Program>,

    /// Let usd-core judge the USD that was written; exit 1 when it finds errors (needs Python with usd-core)
    #[arg(long)]
    pub(crate) check: bool,
}

/// A program on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Program {
    /// Unreal Engine: its groom schema; Alembic in centimetres, z up
    Unreal,
    /// SideFX Karma: cubic curves with phantom end points, as it does not know pinned ones
    Karma,
    /// Blender
    Blender,
    /// SideFX Houdini: its names for hair attributes
    Houdini,
}

impl From<Program> for Dialect {
    fn from(program: Program) -> Self {
        match program {
            Program::Unreal => Dialect::Unreal,
            Program::Karma => Dialect::Karma,
            Program::Blender => Dialect::Blender,
            Program::Houdini => Dialect::Houdini,
        }
    }
}
