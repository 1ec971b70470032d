//! Strands bound to a surface and carried by it as it moves.
//!
//! A strand is bound by its root: triangle, place in it, height over it, and the frame of the surface there, all
//! of the pose the strand was made for. At another pose the same place gives another frame, and the strand goes
//! with it. Knows meshes by their triangles and poses, not by their files, and no light.

mod accuracy;
mod alignment;
mod anchors;
mod bind_options;
mod bind_report;
mod binding;
mod carrier;
mod carry_options;
mod closest_point;
mod deformation_field;
mod error;
mod handedness;
mod jumps;
mod keep_out;
mod linear_system;
mod moved;
mod pseudo_normals;
mod rigid_carry;
mod root;
mod root_attributes;
mod root_frame;
mod root_frames;
mod root_places;
mod segment_lengths;
mod shutter;
mod space_curve;
pub mod stability;
mod stencil;
mod strand_blocks;
mod strand_carry;
mod surface;
mod surface_tree;
mod topology;
mod vertex_normals;

pub use accuracy::{AccuracyRow, blending_accuracy, velocity_accuracy};
pub use alignment::{Alignment, Space};
pub use bind_options::{Beyond, BindBy, BindOptions};
pub use bind_report::BindReport;
pub use binding::Binding;
pub use carrier::Carrier;
pub use carry_options::{Blend, CarryMode, CarryOptions};
pub use error::BindingError;
pub use moved::{CarryReport, Moved};
pub use rigid_carry::carry_rigid;
pub use root::Root;
pub use root_attributes::{
    GroupBy, ROOT_NORMAL, ROOT_TRIANGLE, set_groups, set_root_colors, set_root_normals, set_root_triangles,
    set_root_uvs,
};
pub use root_frame::{RigidMotion, RootFrame};
pub use root_frames::RootFrames;
pub use shutter::Shutter;
pub use stencil::Stencil;
pub use surface::Surface;
pub use topology::TopologyHash;
