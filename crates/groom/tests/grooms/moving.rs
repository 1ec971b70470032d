//! Laws of moving a groom as a whole.

use crate::support::{floats, grooms, ints, vec3s, wavy};
use glam::{DMat4, DQuat, DVec3, Vec3};
use groom::{Groom, UpAxis};
use proptest::prelude::*;

fn matrices() -> impl Strategy<Value = DMat4> {
    let vector = |range: std::ops::Range<f64>| prop::array::uniform3(range).prop_map(DVec3::from);
    (vector(0.2..5.0), vector(-3.0..3.0), 0.0..6.3, vector(-20.0..20.0), any::<bool>()).prop_map(
        |(scale, axis, angle, offset, mirrored)| {
            let turn = DQuat::from_axis_angle(axis.try_normalize().unwrap_or(DVec3::X), angle);
            let scale = if mirrored { -scale } else { scale };
            DMat4::from_scale_rotation_translation(scale, turn, offset)
        },
    )
}

fn close(a: &[Vec3], b: &[Vec3], within: f32) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.distance(*b) <= within)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_matrix_and_its_inverse_undo_each_other(groom in grooms(), matrix in matrices()) {
        let mut moved = groom.clone();
        moved.transform(&matrix).unwrap();
        let radius = floats(&moved, "radius")[0] / floats(&groom, "radius")[0];
        prop_assert!((f64::from(radius) - matrix.determinant().abs().cbrt()).abs() < 1e-5);
        moved.transform(&matrix.inverse()).unwrap();
        prop_assert!(close(moved.positions(), groom.positions(), 1e-3));
        prop_assert!(close(vec3s(&moved, "velocity"), vec3s(&groom, "velocity"), 1e-3));
        let radii = floats(&moved, "radius").iter().zip(floats(&groom, "radius"));
        prop_assert!(radii.into_iter().all(|(a, b)| (a - b).abs() <= 1e-4));
    }

    #[test]
    fn steps_and_the_matrix_of_them_agree(groom in grooms(), angle in -7.0_f64..7.0, factor in 0.1_f32..9.0) {
        let (axis, offset) = (DVec3::new(1.0, -2.0, 0.5), DVec3::new(3.0, 0.0, -40.0));
        let mut steps = groom.clone();
        steps.scale(factor).unwrap();
        steps.rotate(axis, angle).unwrap();
        steps.translate(offset).unwrap();
        let turn = DQuat::from_axis_angle(axis.normalize(), angle);
        let matrix = DMat4::from_scale_rotation_translation(DVec3::splat(factor.into()), turn, offset);
        let mut at_once = groom;
        at_once.transform(&matrix).unwrap();
        prop_assert!(close(steps.positions(), at_once.positions(), 1e-3));
        prop_assert!(close(vec3s(&steps, "velocity"), vec3s(&at_once, "velocity"), 1e-3));
        let radii = floats(&steps, "radius").iter().zip(floats(&at_once, "radius"));
        prop_assert!(radii.into_iter().all(|(a, b)| (a / b - 1.0).abs() <= 1e-5));
    }

    #[test]
    fn reversing_swaps_root_and_tip_and_undoes_itself(groom in grooms()) {
        let mut reversed = groom.clone();
        reversed.reverse();
        for (new, old) in reversed.strands().zip(groom.strands()) {
            prop_assert!(new.iter().eq(old.iter().rev()));
        }
        for (vertex, &old) in ints(&reversed, "index").iter().enumerate() {
            prop_assert_eq!(reversed.positions()[vertex], groom.positions()[old as usize]);
            prop_assert_eq!(floats(&reversed, "radius")[vertex], floats(&groom, "radius")[old as usize]);
        }
        reversed.reverse();
        prop_assert_eq!(reversed, groom);
    }

    #[test]
    fn up_turns_velocities_with_the_points_and_back_to_the_bit(groom in grooms()) {
        let mut turned = groom.clone();
        turned.turn_to(UpAxis::Z);
        let same = |(p, v): (&Vec3, &Vec3)| UpAxis::Y.rotate(*p, UpAxis::Z) == *v;
        prop_assert!(vec3s(&groom, "velocity").iter().zip(vec3s(&turned, "velocity")).all(same));
        turned.turn_to(UpAxis::Y);
        prop_assert_eq!(turned, groom);
    }
}

#[test]
fn a_quarter_turn_goes_the_right_way() {
    let mut groom = Groom::new(vec![0, 1], vec![Vec3::X]).unwrap();
    groom.rotate(DVec3::Z * 7.0, std::f64::consts::FRAC_PI_2).unwrap();
    assert!(groom.positions()[0].distance(Vec3::Y) < 1e-7);
    assert!(groom.attribute("radius").is_none(), "a turn leaves the radius alone");
}

#[test]
fn what_cannot_be_undone_is_refused() {
    let groom = wavy(2, 3);
    let flat = DMat4::from_cols_array(&[1., 2., 3., 0., 4., 5., 6., 0., 7., 8., 9., 0., 0., 0., 0., 1.]);
    let with_row = DMat4::from_translation(DVec3::X).transpose();
    for (matrix, told) in [
        (DMat4::ZERO, "last row"),
        (DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), "inverted"),
        (flat, "inverted"),
        (with_row, "transpose"),
        (DMat4::from_scale(DVec3::splat(f64::NAN)), "finite"),
        (DMat4::from_scale(DVec3::splat(1e200)), "inverted"),
    ] {
        let mut moved = groom.clone();
        let error = moved.transform(&matrix).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
        assert_eq!(moved, groom);
    }
    let mut moved = groom.clone();
    assert!(moved.rotate(DVec3::ZERO, 1.0).is_err() && moved.rotate(DVec3::X, f64::NAN).is_err());
    assert!(moved.translate(DVec3::NAN).is_err() && moved.rotate(DVec3::INFINITY, 1.0).is_err());
    assert_eq!(moved, groom);
}
