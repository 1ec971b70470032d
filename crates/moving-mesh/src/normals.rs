//! Normals, brought along by a transform.

use glam::{DMat3, Vec3};

/// The inverse transpose but for a factor above 0, also of a matrix that flattens or mirrors.
pub(crate) fn cofactors(matrix: &DMat3) -> DMat3 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *matrix;
    let yz = y.cross(z);
    let sign = if x.dot(yz) < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(yz * sign, z.cross(x) * sign, x.cross(y) * sign)
}

/// Turns a normal by what [`cofactors`] gives; of length 1, or zero.
pub(crate) fn turn(cofactors: &DMat3, normal: &mut Vec3) {
    *normal = (*cofactors * normal.as_dvec3()).normalize_or_zero().as_vec3();
}

/// Of length 1, or zero.
pub(crate) fn to_unit(normal: &mut Vec3) {
    *normal = normal.normalize_or_zero();
}
