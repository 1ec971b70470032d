//! How strands are bound.

use crate::BindingError;

/// What says where a strand's root is on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BindBy {
    /// The point of the rest pose nearest to the root.
    #[default]
    Nearest,
    /// The strand's `root_uv`, looked up in the mesh's texture coordinates. Where several triangles hold it, or
    /// lie equally near to it, the one whose place is nearest to the root in space counts.
    RootUv,
    /// The strand's [`ROOT_TRIANGLE`](crate::ROOT_TRIANGLE) attribute: the nearest point of that triangle.
    RootTriangle,
}

/// What becomes of strands whose root is farther from the surface than the limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Beyond {
    /// They are bound as the others are, at their distance.
    #[default]
    Keep,
    /// They are carried with their root on the surface.
    Snap,
    /// They are left out of the binding, which then fits the groom of [`BindReport::kept`](crate::BindReport::kept).
    Drop,
}

/// How strands are bound: by nearest point, without a limit, unless one says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BindOptions {
    /// What says where a root is.
    pub by: BindBy,
    /// The farthest that a root should be from its place on the surface, in the mesh's units, 0 or more. `None`:
    /// any distance will do.
    pub limit: Option<f64>,
    /// What becomes of strands beyond the limit. The report lists them whatever it is.
    pub beyond: Beyond,
}

impl BindOptions {
    pub(crate) fn check(&self) -> Result<(), BindingError> {
        match self.limit {
            Some(limit) if !(limit.is_finite() && limit >= 0.0) => Err(BindingError::OutOfRange {
                name: "limit",
                found: limit.to_string(),
                expected: "a finite distance, 0 or more",
            }),
            _ => Ok(()),
        }
    }
}
