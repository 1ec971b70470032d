//! What can be wrong with geometry to trace.

/// Geometry that no tracer can be built from.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TracingError {
    /// The offsets do not run from 0 up to the number of points without falling.
    #[error("strands {object}: offset {index} is {found}, expected {expected}")]
    Offsets {
        /// Which of the strands objects.
        object: usize,
        /// Index into its offsets.
        index: usize,
        /// The value there.
        found: u64,
        /// What would be right, in words.
        expected: String,
    },
    /// There are not as many radii as points.
    #[error("strands {object}: {found} radii, expected one for each of the {expected} points")]
    RadiusCount {
        /// Which of the strands objects.
        object: usize,
        /// How many radii there are.
        found: usize,
        /// How many points there are.
        expected: usize,
    },
    /// A strand's point is not finite.
    #[error("strands {object}: point {point} is {found}, expected finite numbers")]
    Position {
        /// Which of the strands objects.
        object: usize,
        /// Index into its positions.
        point: usize,
        /// The value there.
        found: glam::Vec3,
    },
    /// A radius is negative or not finite.
    #[error("strands {object}: radius {point} is {found}, expected 0 or more")]
    Radius {
        /// Which of the strands objects.
        object: usize,
        /// Index into its radii (0 for a constant radius).
        point: usize,
        /// The value there.
        found: f32,
    },
    /// A triangle's vertex is not finite.
    #[error("triangles {object}: vertex {vertex} is {found}, expected finite numbers")]
    Vertex {
        /// Which of the triangles objects.
        object: usize,
        /// Index into its positions.
        vertex: usize,
        /// The value there.
        found: glam::Vec3,
    },
    /// A triangle names a vertex that is not there.
    #[error("triangles {object}: triangle {triangle} names vertex {found}, but there are {vertices}")]
    Index {
        /// Which of the triangles objects.
        object: usize,
        /// Which triangle.
        triangle: usize,
        /// The index found.
        found: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A key has not as many points as the strands.
    #[error("strands {object}: {found} points at key {key}, expected {expected} as at key 0")]
    MovedPoints {
        /// Which of the strands objects.
        object: usize,
        /// Which key; `moved` starts with key 1.
        key: usize,
        /// How many points the key has.
        found: usize,
        /// How many there are at key 0.
        expected: usize,
    },
    /// A strand's point is not finite at a further key.
    #[error("strands {object}: point {point} is {found} at key {key}, expected finite numbers")]
    MovedPosition {
        /// Which of the strands objects.
        object: usize,
        /// Which key; `moved` starts with key 1.
        key: usize,
        /// Index into the positions.
        point: usize,
        /// The value there.
        found: glam::Vec3,
    },
    /// A key has not as many vertices as the triangles.
    #[error("triangles {object}: {found} vertices at key {key}, expected {expected} as at key 0")]
    MovedVertices {
        /// Which of the triangles objects.
        object: usize,
        /// Which key; `moved` starts with key 1.
        key: usize,
        /// How many vertices the key has.
        found: usize,
        /// How many there are at key 0.
        expected: usize,
    },
    /// A triangle's vertex is not finite at a further key.
    #[error("triangles {object}: vertex {vertex} is {found} at key {key}, expected finite numbers")]
    MovedVertex {
        /// Which of the triangles objects.
        object: usize,
        /// Which key; `moved` starts with key 1.
        key: usize,
        /// Index into the positions.
        vertex: usize,
        /// The value there.
        found: glam::Vec3,
    },
    /// More points or triangles than a tree can number.
    #[error("{found} {what}, but one tracer holds at most {most}")]
    TooMany {
        /// Points, triangles or objects.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many are possible.
        most: u64,
    },
}
