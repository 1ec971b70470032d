//! Whether a pose is the mirror image of the rest pose.
//!
//! A mesh that is mirrored (a negative scale above it, say) turns its triangles' normals inwards, and no
//! rotation takes one to the other: strands carried by rotations would grow into the body. Which of the two a
//! pose is cannot be told from one triangle, nor from a flat sheet, whose mirror image is itself turned over. It
//! can be told from how a body is curved: the total mean curvature is positive for whatever is more convex than
//! hollow as its triangles face, stays so however its limbs bend, and changes its sign in a mirror.

use glam::DVec3;

use crate::surface::corners;
use crate::vertex_normals::{PoseNormals, unit};

/// How curved a surface must be before its sense counts: [`curvature`] is 7.1 for a ball, 5 for half of one,
/// 3.5 for a third, and as many radians as it is bent for a sheet.
const CURVED: f64 = 3.0;

/// Triangles that are looked at, about: the sense of a large mesh shows in fewer than all of them.
const LOOKED_AT: usize = 8192;

/// Which way round a pose is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Handedness {
    at_rest: f64,
}

impl Handedness {
    pub(crate) fn of_rest(triangles: &[[u32; 3]], positions: &[DVec3], normals: &PoseNormals<'_>) -> Self {
        Handedness { at_rest: curvature(triangles, positions, normals) }
    }

    /// Whether a pose is mirrored; `None` when that cannot be told.
    pub(crate) fn mirrored(
        self,
        triangles: &[[u32; 3]],
        positions: &[DVec3],
        normals: &PoseNormals<'_>,
    ) -> Option<bool> {
        if self.at_rest.abs() < CURVED {
            return Some(false);
        }
        let now = curvature(triangles, positions, normals);
        (now.abs() >= CURVED).then_some(now * self.at_rest < 0.0)
    }
}

/// Twice the total mean curvature over the root of the area: by how much the area grows when every vertex moves
/// along its normal.
fn curvature(triangles: &[[u32; 3]], positions: &[DVec3], normals: &PoseNormals<'_>) -> f64 {
    let (mut growth, mut twice_area) = (0.0, 0.0);
    let step = triangles.len() / LOOKED_AT + 1;
    for triangle in triangles.iter().step_by(step) {
        let [a, b, c] = corners(positions, *triangle);
        let [na, nb, nc] = normals.at_corners(*triangle);
        let (ab, ac) = (b - a, c - a);
        let area = ab.cross(ac);
        let grown = (nb - na).cross(ac) + ab.cross(nc - na);
        growth += 0.5 * unit(area).dot(grown);
        twice_area += area.length();
    }
    // Each stands for as many.
    let each = step as f64;
    if twice_area > 0.0 { growth * each / (0.5 * twice_area * each).sqrt() } else { 0.0 }
}
