//! How far a point is from a segment.

use glam::DVec3;

/// The parameter, 0 at `a` to 1 at `b`, of the point of the segment that is closest to `point`; 0 on a
/// segment without length.
pub(crate) fn closest_parameter(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (along, length_squared) = (b - a, (b - a).length_squared());
    if length_squared > 0.0 { ((point - a).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// The square of the distance from `point` to the segment from `a` to `b`; not-a-number when one of them is.
pub(crate) fn distance_squared(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    let t = closest_parameter(point, a, b);
    // The ends are met exactly, whatever a + (b - a) rounds to.
    let closest = if t == 1.0 { b } else { a + (b - a) * t };
    (point - closest).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_beside_before_and_beyond() {
        let (a, b) = (DVec3::ZERO, DVec3::X * 2.0);
        for (point, distance) in [([1.0, 3.0, 4.0], 5.0), ([-3.0, 4.0, 0.0], 5.0), ([5.0, 0.0, 4.0], 5.0)] {
            assert_eq!(distance_squared(point.into(), a, b).sqrt(), distance);
        }
        assert_eq!(distance_squared(DVec3::Y, a, a), 1.0);
        assert!(distance_squared(DVec3::NAN, a, b).is_nan());
    }
}
