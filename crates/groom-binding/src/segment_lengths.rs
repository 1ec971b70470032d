//! Segments that keep their lengths.

use glam::{DVec3, Vec3};

/// Gives the segments of a strand their lengths at `rest` back, from the root, which stays, to the tip: each point
/// moves along the line to the one before it (follow the leader).
///
/// A segment that has shrunk to nothing points where the one before it points, or where it pointed at rest.
pub(crate) fn restore(strand: &mut [DVec3], rest: &[Vec3]) {
    let mut last = DVec3::ZERO;
    for i in 1..strand.len().min(rest.len()) {
        let at_rest = rest[i].as_dvec3() - rest[i - 1].as_dvec3();
        let length = at_rest.length();
        let direction = (strand[i] - strand[i - 1]).try_normalize();
        last = direction.unwrap_or_else(|| last.try_normalize().unwrap_or(at_rest.normalize_or_zero()));
        strand[i] = strand[i - 1] + last * length;
    }
}

/// The greatest change of a segment's length against `rest`, as a part of the strand's length at rest.
#[cfg(test)]
pub(crate) fn worst_change(strand: &[DVec3], rest: &[Vec3]) -> f64 {
    let lengths = |points: &[DVec3]| points.windows(2).map(|p| p[1].distance(p[0])).collect::<Vec<_>>();
    let rest = lengths(&rest.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>());
    let total: f64 = rest.iter().sum();
    lengths(strand)
        .iter()
        .zip(&rest)
        .fold(0.0, |worst: f64, (now, then)| worst.max((now - then).abs() / total))
}

#[cfg(test)]
mod tests {
    use glam::{dvec3, vec3};

    use super::*;

    #[test]
    fn lengths_come_back_and_the_root_stays() {
        let rest = [vec3(0.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 1.5, 0.5), vec3(1.0, 2.0, 0.5)];
        let mut strand: Vec<DVec3> =
            rest.iter().map(|p| p.as_dvec3() * dvec3(1.7, 0.4, 3.0) + dvec3(5.0, 6.0, 7.0)).collect();
        let root = strand[0];
        restore(&mut strand, &rest);
        assert_eq!(strand[0], root);
        assert!(worst_change(&strand, &rest) < 1e-14);
        // What has its lengths is left where it is.
        let before = strand.clone();
        restore(&mut strand, &rest);
        assert!(strand.iter().zip(&before).all(|(a, b)| a.distance(*b) < 1e-14));
    }

    #[test]
    fn a_strand_shrunk_to_a_point_gets_up_again() {
        let rest = [vec3(0.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(1.0, 1.0, 0.0)];
        let mut strand = vec![dvec3(3.0, 0.0, 0.0); 4];
        restore(&mut strand, &rest);
        assert!(strand.iter().all(|p| p.is_finite()));
        assert!(worst_change(&strand, &rest) < 1e-14);
        restore(&mut [], &rest);
        restore(&mut [DVec3::ONE], &rest[..1]);
    }
}
