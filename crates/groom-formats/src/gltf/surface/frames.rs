//! Frames along a strand.

use glam::{DVec3, Vec3};

/// The plane across a strand at one of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) point: Vec3,
    /// Unit length, perpendicular to the strand and to `out`; `across`, `out` and the way to the tip are
    /// right-handed.
    pub(super) across: Vec3,
    pub(super) out: Vec3,
    /// Length from the root to here, metres.
    pub(super) along: f32,
}

/// Above this cosine two directions are opposite.
const OPPOSITE: f64 = -1.0 + 1e-9;

/// The frames at `points`, y-up, into `frames`.
///
/// The first `across` is level. Each frame is the one before it turned by the smallest turn that takes one
/// tangent to the next (parallel transport; Bishop 1975, doi:10.1080/00029890.1975.11993807), so a
/// straight strand never twists. A tangent is the mean of the directions of the segments on both sides; a segment
/// without length takes the direction of the one before it, and where a strand turns right back, `across`
/// stays.
pub(super) fn frames(points: &[Vec3], frames: &mut Vec<Frame>) {
    frames.clear();
    let mut before = first_direction(points);
    let mut along = 0.0_f64;
    let mut turning: Option<(DVec3, DVec3)> = None;
    for (i, &point) in points.iter().enumerate() {
        let step = points.get(i + 1).map_or(DVec3::ZERO, |&next| DVec3::from(next) - DVec3::from(point));
        let length = step.length();
        let after = if length > 0.0 { step / length } else { before };
        let mean = before + after;
        let tangent = if mean.length_squared() > 1e-12 { mean.normalize() } else { before };
        let across = match turning {
            None => level(tangent),
            Some((last, across)) => transported(across, last, tangent),
        };
        let out = tangent.cross(across);
        frames.push(Frame { point, across: across.as_vec3(), out: out.as_vec3(), along: along as f32 });
        turning = Some((tangent, across));
        before = after;
        along += length;
    }
}

/// The way of the first segment that has a length; up when none has.
fn first_direction(points: &[Vec3]) -> DVec3 {
    let steps = points.windows(2).map(|pair| DVec3::from(pair[1]) - DVec3::from(pair[0]));
    steps.map(DVec3::normalize_or_zero).find(|step| *step != DVec3::ZERO).unwrap_or(DVec3::Y)
}

/// A level direction perpendicular to `tangent`; along x for upright strands.
fn level(tangent: DVec3) -> DVec3 {
    let level = tangent.cross(DVec3::Y);
    if level.length_squared() > 1e-6 { level.normalize() } else { perpendicular(DVec3::X, tangent) }
}

fn transported(across: DVec3, last: DVec3, tangent: DVec3) -> DVec3 {
    let cosine = last.dot(tangent);
    let turned = if cosine > OPPOSITE {
        across - (last + tangent) * (across.dot(tangent) / (1.0 + cosine))
    } else {
        across
    };
    perpendicular(turned, tangent)
}

/// `direction` without its part along `tangent`, of unit length.
fn perpendicular(direction: DVec3, tangent: DVec3) -> DVec3 {
    let flat = direction - tangent * direction.dot(tangent);
    if flat.length_squared() > 1e-12 { flat.normalize() } else { tangent.any_orthonormal_vector() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: &[Vec3]) -> Vec<Frame> {
        let mut found = Vec::new();
        frames(points, &mut found);
        for frame in &found {
            assert!((frame.across.length() - 1.0).abs() < 1e-6 && (frame.out.length() - 1.0).abs() < 1e-6);
            assert!(frame.across.dot(frame.out).abs() < 1e-6, "{frame:?}");
        }
        found
    }

    #[test]
    fn straight_strands_do_not_twist() {
        for direction in [Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, Vec3::new(0.3, -0.9, 1.0)] {
            let points: Vec<Vec3> = (0..9).map(|i| direction * (i as f32 * 0.1)).collect();
            let found = of(&points);
            assert!(found.iter().all(|f| (f.across - found[0].across).length() < 1e-5), "{direction}");
            assert!((found[8].along - 0.8 * direction.length()).abs() < 1e-5);
        }
    }

    #[test]
    fn a_flat_curve_keeps_its_out_of_plane_direction() {
        // A circle in the xz plane from a tangent along z: `across` is level, `out` is up all the way.
        let points: Vec<Vec3> =
            (0..40).map(|i| Vec3::new((i as f32 * 0.1).cos(), 0.0, (i as f32 * 0.1).sin())).collect();
        let found = of(&points);
        assert!(found.iter().all(|f| (f.out.y.abs() - 1.0).abs() < 1e-5 && f.out.y == found[0].out.y));
    }

    #[test]
    fn odd_strands_have_frames() {
        let back = [Vec3::ZERO, Vec3::X, Vec3::ZERO, Vec3::X];
        let found = of(&back);
        assert!(found.iter().all(|f| f.across == found[0].across), "no flip where a strand turns back");
        of(&[Vec3::ONE; 4]);
        of(&[Vec3::ZERO, Vec3::ZERO, Vec3::Y, Vec3::Y, Vec3::new(1e-20, 1.0, 0.0), Vec3::X]);
        of(&[Vec3::splat(1e30), Vec3::splat(-1e30)]);
    }
}
