//! Alembic: one Curves object of linear curves at `/groom`, with Unreal's groom schema (version 1.5).
//!
//! | groom | Alembic |
//! |---|---|
//! | points | `P`, `nVertices`, linear, not periodic; `.selfBnds`, and `.childBnds` of the archive |
//! | radius | `width`: diameters |
//! | velocity per vertex | `.velocities`, per second |
//! | root_uv | `uv` and `groom_root_uv`; stored once |
//! | color, id, group, guide | `groom_color`, `groom_id`, `groom_group_id`, `groom_guide` |
//! | closest_guide | `groom_closest_guides` (three times), `groom_guide_weights` (1, 0, 0), and `groom_id` |
//! | transparency and any other | a parameter of its name among `.arbGeomParams` |
//! | constant, per strand, per vertex | scope `con`, `uni`, `vtx` |
//! | unit, up axis | `groomkit_meters_per_unit`, `groomkit_up_axis` among `.userProperties` |
//!
//! **Unit and axis.** Alembic has neither. Numbers are written as the groom has them, and what they mean stands
//! in two properties that only groomkit reads; without them y up and a metre a unit are assumed, as for
//! most programs that write Alembic ([`ReadOptions`](crate::ReadOptions) can say otherwise). Blender, Maya and Houdini take y up.
//! [`Dialect::Unreal`](crate::Dialect) turns and scales: centimetres, z up. Unreal's axes are left-handed, so strands appear
//! mirrored unless its import dialogue is told to scale y by -1.
//!
//! **Widths.** Blender 5.0 ignores a constant width and reads past the end of widths per strand (its radii are
//! then garbage), so widths are written per point, and `groomkit_domains` says what they were. Unreal
//! takes all scopes and gets the groom's own; there `groom_width` stands beside them (stored once), which
//! wins in Unreal and is not scaled on import, so it is left out elsewhere.
//!
//! **Motion.** Times are seconds at the frame rate that the archive's metadata says (`_ai_DCC_FPS`). Velocities are
//! units per second; accelerations have no place and are left out with a warning. An origin is an Xform above the
//! curves, `/origin/groom`, in 64 bits. Blender 5.0 reads no velocities of curves, and takes seconds for frames of its
//! scene's rate, whatever the archive says.
//!
//! **Reading** takes every Curves object (`AbcGeom_Curve_v2`) below its Xforms; cubic ones become polylines
//! (`ReadOptions::curve_error`). Hermite, power and variable order curves are refused.

mod read;
mod schema;
mod write;

pub(crate) use read::{read, read_moving};
pub(crate) use write::{write, write_animation};
