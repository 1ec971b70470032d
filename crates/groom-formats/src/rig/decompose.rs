//! Matrices as translation, rotation and scale.

use glam::{DMat3, DMat4, DQuat, DVec3};

/// A step of Newton's iteration that changes nothing any more.
const CONVERGED: f64 = 1e-15;
const STEPS: usize = 32;
/// Volumes of unit columns below this are as good as flat.
const FLAT: f64 = 1e-9;

/// What first scales, then turns, then moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parts {
    pub(super) translation: DVec3,
    pub(super) rotation: DQuat,
    pub(super) scale: DVec3,
}

impl Parts {
    pub(super) fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

impl std::fmt::Display for Parts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a translation of {} and a scale of {}", self.translation, self.scale)
    }
}

/// The parts of a matrix, exact where it has no shear; a mirror becomes three scales below 0. `last` is the
/// rotation where the matrix does not say (everything scaled to nothing) and the side of quaternions that the
/// answer is on.
pub(super) fn parts(matrix: &DMat4, last: DQuat) -> Parts {
    let linear = DMat3::from_mat4(*matrix);
    let mut turn = nearest_orthogonal(linear, last);
    if turn.determinant() < 0.0 {
        turn *= -1.0;
    }
    let rotation = DQuat::from_mat3(&turn).normalize();
    let rotation = if rotation.dot(last) < 0.0 { -rotation } else { rotation };
    let scale = DVec3::new(
        turn.x_axis.dot(linear.x_axis),
        turn.y_axis.dot(linear.y_axis),
        turn.z_axis.dot(linear.z_axis),
    );
    Parts { translation: matrix.w_axis.truncate(), rotation, scale }
}

/// The orthogonal matrix nearest to the columns of `linear`, each made a unit long (polar decomposition, Higham
/// 1986). Columns of no length get a direction that suits the others.
fn nearest_orthogonal(linear: DMat3, last: DQuat) -> DMat3 {
    let units = [linear.x_axis, linear.y_axis, linear.z_axis].map(DVec3::try_normalize);
    let mut near = match units {
        [Some(x), Some(y), Some(z)] => DMat3::from_cols(x, y, z),
        [None, Some(y), Some(z)] => {
            DMat3::from_cols(y.cross(z).normalize_or(y.any_orthonormal_vector()), y, z)
        }
        [Some(x), None, Some(z)] => {
            DMat3::from_cols(x, z.cross(x).normalize_or(x.any_orthonormal_vector()), z)
        }
        [Some(x), Some(y), None] => {
            DMat3::from_cols(x, y, x.cross(y).normalize_or(x.any_orthonormal_vector()))
        }
        [Some(x), None, None] => {
            let (y, z) = x.any_orthonormal_pair();
            DMat3::from_cols(x, y, z)
        }
        [None, Some(y), None] => {
            let (z, x) = y.any_orthonormal_pair();
            DMat3::from_cols(x, y, z)
        }
        [None, None, Some(z)] => {
            let (x, y) = z.any_orthonormal_pair();
            DMat3::from_cols(x, y, z)
        }
        [None, None, None] => return DMat3::from_quat(last),
    };
    if near.determinant().abs() < FLAT {
        let x = near.x_axis;
        let y = near.y_axis.reject_from(x).normalize_or(x.any_orthonormal_vector());
        return DMat3::from_cols(x, y, x.cross(y));
    }
    for _ in 0..STEPS {
        let next = (near + near.inverse().transpose()) * 0.5;
        let change = (next - near).to_cols_array().into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        near = next;
        if change <= CONVERGED {
            break;
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(scale: DVec3) -> DMat4 {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.2, 2.5);
        DMat4::from_scale_rotation_translation(scale, turn, DVec3::new(1.0, -2.0, 3e5))
    }

    #[test]
    fn what_has_no_shear_comes_back_mirrored_or_flat() {
        for scale in [
            DVec3::ONE,
            DVec3::new(2.0, 0.5, 1e-6),
            DVec3::new(-1.0, 1.0, 1.0),
            DVec3::new(3.0, -2.0, -0.1),
            DVec3::splat(-7.0),
            DVec3::new(1.0, 0.0, 2.0),
            DVec3::new(0.0, 0.0, 5.0),
            DVec3::ZERO,
        ] {
            let matrix = matrix(scale);
            let found = parts(&matrix, DQuat::IDENTITY);
            assert!(found.matrix().abs_diff_eq(matrix, 1e-12), "{scale}: {found:?}");
            assert!((found.rotation.length() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_shear_becomes_the_rotation_between_and_quaternions_stay_on_their_side() {
        let shear = DMat4::from_cols_array(&[
            1.0, 0.0, 0.0, 0.0, 0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
        ]);
        let found = parts(&shear, DQuat::IDENTITY);
        assert!(found.rotation.is_near_identity() || found.rotation.to_axis_angle().1 < 0.11);
        assert!(found.matrix().abs_diff_eq(shear, 0.15) && !found.matrix().abs_diff_eq(shear, 0.01));
        let mut last = DQuat::IDENTITY;
        for step in 0..100 {
            let turn = DMat4::from_rotation_y(f64::from(step) * 0.2);
            let found = parts(&turn, last).rotation;
            assert!(found.dot(last) > 0.9, "{step}");
            last = found;
        }
    }
}
