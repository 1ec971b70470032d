//! What is asked of the positions at further keys.

use glam::Vec3;

use crate::{Strands, TracingError, Triangles};

/// Refuses keys of strands that do not fit their points.
pub(crate) fn check_points(object: usize, strands: &Strands) -> Result<(), TracingError> {
    let expected = strands.positions.len();
    for (key, positions) in (1..).zip(strands.moved) {
        if positions.len() != expected {
            return Err(TracingError::MovedPoints { object, key, found: positions.len(), expected });
        }
        if let Some(point) = positions.iter().position(|p| !p.is_finite()) {
            return Err(TracingError::MovedPosition { object, key, point, found: positions[point] });
        }
    }
    Ok(())
}

/// Refuses keys of triangles that do not fit their vertices. Whether a vertex is finite is asked where a
/// triangle names it.
pub(crate) fn check_vertices(object: usize, triangles: &Triangles) -> Result<(), TracingError> {
    let expected = triangles.positions.len();
    match (1..).zip(triangles.moved).find(|(_, positions)| positions.len() != expected) {
        Some((key, positions)) => {
            Err(TracingError::MovedVertices { object, key, found: positions.len(), expected })
        }
        None => Ok(()),
    }
}

/// Whether any key differs from the first: keys that are all the same are none.
pub(crate) fn any_moves(positions: &[Vec3], moved: &[&[Vec3]]) -> bool {
    moved.iter().any(|key| *key != positions)
}
