//! Strands as Wavefront OBJ lines, `.obj`.
//!
//! Read: `v x y z`, with a colour behind it (`v x y z r g b`, as MeshLab and Blender write) or a weight, which is
//! ignored; `l a b c ...`, one strand each, from 1 or, negative, back from the last vertex; texture indices
//! (`a/t`) are ignored. Lines of two vertices, as mesh exporters write them, are joined while each starts where
//! the one before ended. Strands may share vertices; vertices in no line are left out. A `\` at the end of a
//! line joins it with the next. `vt`, `vn`, groups and materials mean nothing here; faces and what else is not
//! read is told.
//!
//! Written: the points of a strand, `v x y z [r g b]`, then its line. Numbers are the shortest that read back to the
//! same bits. There is no place for a radius. y is taken for up, as is usual, and a unit for a metre, unless a
//! comment says otherwise (`# up_axis z`, `# meters_per_unit 0.01`), as this writer's do.
//!
//! Layout: Wavefront's Advanced Visualizer manual, appendix B1.

mod lines;
mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::write;
