//! glTF 2.0, read and written.
//!
//! # Lines
//!
//! glTF has no ratified curves, and a LINE_STRIP a strand would be tens of thousands of draw calls: every
//! strand is written as line segments of one indexed LINES primitive. The attributes are POSITION, COLOR_0
//! (linear, 8 bits a channel, alpha = 1 - transparency; left out when the groom has neither; blended where any
//! is below 1) and `_WIDTH`, the diameter: a single custom attribute, because Blender 5.0.1 mixes up several
//! of different size. Y is up and the unit is the metre, so points and widths are turned and scaled.
//!
//! # Motion
//!
//! Joints ([`write_rigged`](crate::write_rigged)) become a skin: JOINTS_0 and WEIGHTS_0, the same for all vertices of a
//! strand, and keys for what changes of every joint. Frames of positions ([`write_animation`](crate::write_animation))
//! become morph targets, 12 bytes a point and frame, the first frame being the mesh. An origin is the translation of a
//! node, which readers keep in 32 bits: the strands keep their shape, the place is rounded. Blender 5.0's bones hold no
//! scale where they are at rest: strands of a joint that is scaled or mirrored in its bind pose come out wrong there.
//!
//! # Options
//!
//! [`mesh`](crate::WriteOptions::mesh) makes triangles of the strands: [`surface`]. POSITION, NORMAL, TEXCOORD_0 and
//! COLOR_0 of a vertex lie side by side.
//!
//! [`all_attributes`](crate::WriteOptions::all_attributes) adds `_STRAND` (the `id`), `_ROOT_UV`, `_GROUP`, `_GUIDE`,
//! `_VELOCITY` (turned, in metres per second) and every other attribute as `_NAME`, one value a vertex, as 32-bit
//! floats; integers that floats cannot hold and values that are not finite are left out with a warning.
//! `extras.groomkit` of the mesh keeps the name, the domain and the type of each, so that [`read`] gives
//! back what was written.
//!
//! [`quantize`](crate::WriteOptions::quantize) rounds positions to a grid of cubes, 2^bits - 1 of them along the
//! longest side. Up to 16 bits they are stored as integers with KHR_mesh_quantization, and the node places
//! them; `_WIDTH` and `_VELOCITY` are then in the mesh's own units, as the positions are. The error comes back as
//! [`Warning::PositionsRounded`](crate::Warning::PositionsRounded).

mod blocks;
mod bytes;
mod colors;
mod document;
mod extra;
mod files;
mod glb;
mod grid;
mod morphs;
mod moving;
mod nodes;
mod plan;
mod read;
mod runs;
mod skin;
mod space;
mod surface;
mod tail;
mod views;

pub(crate) use files::write as write_files;
pub(crate) use glb::write_glb;
pub(crate) use morphs::write_animation;
pub(crate) use plan::Plan;
pub(crate) use read::read;
pub(crate) use skin::write_rigged;
