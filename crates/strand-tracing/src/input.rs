//! What a tracer is built from: borrowed strands and triangles, and how hard to try.

use glam::Vec3;

/// Strands to trace. Strands of one point, and segments whose radii are both 0, are never hit.
#[derive(Clone, Copy, Debug)]
pub struct Strands<'a> {
    /// Strand `i` has points `offsets[i]..offsets[i + 1]`; starts with 0, ends with the point count. May
    /// be empty where there are no strands.
    pub offsets: &'a [u32],
    /// All points, strand by strand, root first.
    pub positions: &'a [Vec3],
    /// How thick the strands are, at all times.
    pub radii: Radii<'a>,
    /// The points at further keys, evenly spaced over the shutter: with `n` of them, `positions` are those
    /// at time 0 and `moved[i]` those at time `(i + 1) / n`. Linear in between. Empty where nothing moves.
    pub moved: &'a [&'a [Vec3]],
}

/// Radii (not diameters), in world units, 0 or more.
#[derive(Clone, Copy, Debug)]
pub enum Radii<'a> {
    /// The same everywhere.
    Constant(f32),
    /// One for each point; linear in between.
    PerVertex(&'a [f32]),
}

/// Triangles to trace, seen from both sides.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// Vertices.
    pub positions: &'a [Vec3],
    /// Three vertices each.
    pub indices: &'a [[u32; 3]],
    /// The vertices at further keys; see [`Strands::moved`].
    pub moved: &'a [&'a [Vec3]],
}

/// How a tracer is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct BuildOptions {
    /// Build time against traversal time. Never changes what is hit.
    pub quality: BuildQuality,
}

/// How long to work on the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum BuildQuality {
    /// For a look: the quickest build.
    Draft,
    /// For a picture.
    #[default]
    Standard,
    /// For many pictures of one pose.
    Best,
}
