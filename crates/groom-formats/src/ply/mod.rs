//! Strands in Stanford's PLY, `.ply`, as hairutil stores them.
//!
//! Read: `ascii`, `binary_little_endian` and `binary_big_endian`. What is a strand is told by, first come first
//! served: `element strand` with `property ushort nsegs` (points - 1), hairutil's own; the option
//! `points_per_strand`, for the bare vertices of GaussianHaircut, HAAR and Neural Haircut (100 points a strand);
//! `element edge` with `vertex1` and `vertex2`, where an edge goes on with the strand that ended where it starts.
//!
//! | property | becomes |
//! |---|---|
//! | `x y z`, float or double | positions |
//! | `red green blue` (or `r g b`, `diffuse_red ...`), uchar over 255, ushort over 65535 or float | `color` |
//! | `thickness` or `width`, a diameter; `radius` | `radius` |
//! | `alpha` | `transparency`, as 1 - alpha; as alpha where there is `nsegs`, for so hairutil writes it |
//! | `nx ny nz`, `vx vy vz` | `normal`, `velocity` |
//! | `NAME_x NAME_y [NAME_z]`, floats | the vec2 or vec3 `NAME` |
//! | any other | a float or int of that name |
//!
//! Properties of the vertex belong to vertices, those of the strand to strands, those of an `element groom`
//! (our own, one row) to the whole. Integers over 2^31 keep their bits. List properties and other elements are
//! skipped.
//!
//! Written: little endian, vertices first, then strands. `thickness` and `red green blue` (8 bits) are written at
//! the vertices, where hairutil, Blender and MeshLab look for them; what that rounds or spreads is written
//! again as it is, as `radius` and `color_x color_y color_z` in its own element, and wins on reading. Every
//! other attribute is written in its own element. hairutil reads such a file: it takes properties it does
//! not know as they come (`ply.cpp`, and `happly.h` below it).
//!
//! The format has no axis and no unit: y is taken for up and a unit for a metre, unless a comment says
//! otherwise (`comment up_axis z`, `comment meters_per_unit 0.01`), as this writer's do.

mod attributes;
mod columns;
mod header;
mod names;
mod numbers;
mod read;
pub(crate) mod stream;
mod write;

pub(crate) use names::colors_are_bytes;
pub(crate) use read::read;
pub(crate) use write::{PlySink, write};
