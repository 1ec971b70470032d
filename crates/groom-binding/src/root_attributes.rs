//! What a groom learns from the surface under its roots.

/// The number of the triangle that a strand is bound to: int per strand.
pub const ROOT_TRIANGLE: &str = "root_triangle";
