//! What strands learn from the mesh.

use clap::Args;

/// Attributes that the mesh gives the strands.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Attributes from the mesh")]
pub(crate) struct Attributes {
    /// Give strands the texture coordinate at their root: root_uv
    #[arg(long)]
    pub(crate) root_uv: bool,

    /// Give strands the normal of the rest pose at their root: root_normal
    #[arg(long)]
    pub(crate) root_normal: bool,

    /// Give strands the base colour of the mesh at their root: color
    #[arg(long)]
    pub(crate) color_from_mesh: bool,

    /// Number strands by the material they grow on: group
    #[arg(long)]
    pub(crate) group_by_material: bool,
}
