//! Which way is up.

use glam::Vec3;

/// The axis that points up in a groom's coordinates.
///
/// Readers keep a file's numbers and say here what they mean, so that nothing is lost on the way
/// through; a writer whose format fixes the axis (glTF) and the renderer turn the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum UpAxis {
    /// Y points up (glTF, USD's fallback, groomkit's renderer).
    #[default]
    Y,
    /// Z points up (Yuksel's HAIR models, Blender, Unreal).
    Z,
}

impl UpAxis {
    /// Turns `v` from axes where `self` is up into axes where `to` is up, by a quarter turn about x.
    ///
    /// Only swaps and negates components, so turning there and back gives the same bits.
    #[must_use]
    pub fn rotate(self, v: Vec3, to: UpAxis) -> Vec3 {
        match (self, to) {
            (UpAxis::Z, UpAxis::Y) => Vec3::new(v.x, v.z, -v.y),
            (UpAxis::Y, UpAxis::Z) => Vec3::new(v.x, -v.z, v.y),
            _ => v,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_becomes_up_and_handedness_stays() {
        for (from, to) in [(UpAxis::Z, UpAxis::Y), (UpAxis::Y, UpAxis::Z)] {
            let turn = |v| from.rotate(v, to);
            let up = |axis| if axis == UpAxis::Y { Vec3::Y } else { Vec3::Z };
            assert_eq!(turn(up(from)), up(to));
            assert_eq!(turn(Vec3::X).cross(turn(Vec3::Y)), turn(Vec3::Z));
        }
    }

    #[test]
    fn there_and_back_is_bit_equal() {
        let v = Vec3::new(1.0e-30, -0.0, 3.3);
        let back = UpAxis::Y.rotate(UpAxis::Z.rotate(v, UpAxis::Y), UpAxis::Z);
        assert_eq!(v.to_array().map(f32::to_bits), back.to_array().map(f32::to_bits));
    }
}
