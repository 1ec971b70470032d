//! Rays, what they can hit, and what is known about a hit.

use glam::Vec3;

/// A half line in world units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: Vec3,
    /// Where it goes; a unit vector (distances are measured in its length).
    pub direction: Vec3,
    /// Only hits with `0 < t <= t_max` count; may be infinite.
    pub t_max: f32,
    /// When in the shutter, 0 at its opening and 1 at its closing. Where anything moves, a ray of another
    /// time (or none: NaN) hits nothing; where nothing does, there is no time and this is not looked at.
    pub time: f32,
}

/// One traced primitive, by the place it had in the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Primitive {
    /// The piece of a strand between two of its points.
    Segment {
        /// Index into the `strands` given to [`Tracer::build`](crate::Tracer::build).
        object: u32,
        /// Index of the strand in that object.
        strand: u32,
        /// Index of the segment in that strand; it runs from point `segment` to point `segment + 1`.
        segment: u32,
    },
    /// A triangle.
    Triangle {
        /// Index into the `triangles` given to [`Tracer::build`](crate::Tracer::build).
        object: u32,
        /// Index of the triangle in that object.
        triangle: u32,
    },
}

/// Where a ray first meets something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// The point hit, found from the primitive and rounded once: exact to an ulp of its coordinates,
    /// however far away the ray started.
    pub position: Vec3,
    /// What was hit.
    pub primitive: Primitive,
    /// What only one kind of primitive has.
    pub kind: HitKind,
}

/// The part of a hit that depends on the kind of primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HitKind {
    /// A strand was entered.
    Segment {
        /// Where along the segment, 0 at its first point and 1 at its second: the centre of the swept
        /// sphere that touches the hit point.
        u: f32,
        /// Unit vector along the segment from root to tip. A segment without length takes the nearest
        /// direction its strand has, or +Y where there is none.
        tangent: Vec3,
        /// Offset across the fibre, -1 to 1: with `x = tangent`, `z` the unit part of `-direction` normal
        /// to `x`, and `y = z x x` (cross product), the distance of the ray's line from the axis along `y`
        /// over [`radius`](HitKind::Segment::radius). 0 for a ray along the axis.
        h: f32,
        /// Radius at `u`.
        radius: f32,
        /// Outward unit normal of the surface.
        normal: Vec3,
    },
    /// A triangle was crossed.
    Triangle {
        /// Weights of the triangle's second and third vertex.
        barycentrics: [f32; 2],
        /// Unit geometric normal, by the right-hand rule on the vertices (not turned to the ray).
        normal: Vec3,
    },
}
