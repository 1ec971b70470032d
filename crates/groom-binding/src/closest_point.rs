//! The point of a triangle nearest to a place.
//!
//! Ericson, Real-Time Collision Detection (2005), 5.1.5, taken in another order so that triangles without an
//! area need no case of their own: the foot of the perpendicular where it lies inside, else the nearest point
//! of the edges that it lies beyond, each found by itself. (The nearest point of a convex figure is on a side that one
//! stands outside of.)

use glam::DVec3;

/// A point of a triangle: the weights of its vertices, and how far it is from where one asked, squared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnTriangle {
    pub(crate) barycentrics: DVec3,
    pub(crate) distance_squared: f64,
}

/// The point of the triangle nearest to the origin: one moves the triangle, which loses fewer digits than
/// moving the answer. Of edges equally near the first counts.
#[inline]
pub(crate) fn to_origin([a, b, c]: [DVec3; 3]) -> OnTriangle {
    let (ab, ac) = (b - a, c - a);
    let area = ab.cross(ac);
    // The weights of the foot, each times the same positive number.
    let v = ac.cross(a).dot(area);
    let w = a.cross(ab).dot(area);
    let whole = area.length_squared();
    let u = whole - v - w;
    if whole > 0.0 && u >= 0.0 && v >= 0.0 && w >= 0.0 {
        let (v, w) = (v / whole, w / whole);
        // Rounding may take what is left of 1 below nothing.
        let barycentrics = DVec3::new((1.0 - v - w).max(0.0), v, w);
        return OnTriangle { barycentrics, distance_squared: (a + v * ab + w * ac).length_squared() };
    }
    let mut nearest = OnTriangle { barycentrics: DVec3::X, distance_squared: f64::INFINITY };
    let mut consider = |barycentrics, distance_squared| {
        if distance_squared < nearest.distance_squared {
            nearest = OnTriangle { barycentrics, distance_squared };
        }
    };
    // A triangle without an area is beyond all its edges.
    let flat = whole.is_nan() || whole <= 0.0;
    if flat || w < 0.0 {
        let (t, distance) = along(a, b);
        consider(DVec3::new(1.0 - t, t, 0.0), distance);
    }
    if flat || u < 0.0 {
        let (t, distance) = along(b, c);
        consider(DVec3::new(0.0, 1.0 - t, t), distance);
    }
    if flat || v < 0.0 {
        let (t, distance) = along(c, a);
        consider(DVec3::new(t, 0.0, 1.0 - t), distance);
    }
    nearest
}

/// How far along the edge from `a` to `b` its point nearest to the origin lies, 0..=1, and its distance squared.
fn along(a: DVec3, b: DVec3) -> (f64, f64) {
    let edge = b - a;
    let t = -a.dot(edge) / edge.length_squared();
    // An edge without a length is its first end: not-a-number is not more than 0.
    let t = if t > 0.0 { t.min(1.0) } else { 0.0 };
    (t, (a + t * edge).length_squared())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        // Whole numbers make coincidences, degenerate triangles and right angles likely.
        prop_oneof![(-3..=3i32).prop_map(f64::from), -3.0..3.0f64]
    }

    fn point() -> impl Strategy<Value = DVec3> {
        [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from)
    }

    proptest! {
        /// No point of a fine lattice over the triangle is nearer, and the point is the one its weights name.
        #[test]
        fn no_other_point_is_nearer(triangle in [point(), point(), point()], from in point()) {
            let triangle = triangle.map(|p| p - from);
            let found = to_origin(triangle);
            let at = |w: DVec3| w.x * triangle[0] + w.y * triangle[1] + w.z * triangle[2];
            prop_assert!(found.barycentrics.min_element() >= 0.0);
            prop_assert!((found.barycentrics.element_sum() - 1.0).abs() < 1e-12);
            prop_assert!((at(found.barycentrics).length_squared() - found.distance_squared).abs() < 1e-10);
            let n = 24;
            for i in 0..=n {
                for j in 0..=n - i {
                    let (v, w) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                    let other = at(DVec3::new(1.0 - v - w, v, w)).length_squared();
                    prop_assert!(found.distance_squared <= other + 1e-10, "{found:?}, {other} at {v} {w}");
                }
            }
        }
    }

    #[test]
    fn triangles_without_an_area() {
        let (a, b, c) = (DVec3::new(1.0, 1.0, 0.0), DVec3::new(-1.0, 1.0, 0.0), DVec3::new(-3.0, 1.0, 0.0));
        let check = |triangle: [DVec3; 3], barycentrics: [f64; 3], squared: f64| {
            let found = to_origin(triangle);
            assert_eq!(found.barycentrics, DVec3::from(barycentrics));
            assert_eq!(found.distance_squared, squared);
        };
        check([a, b, c], [0.5, 0.5, 0.0], 1.0);
        check([b, a, a], [0.5, 0.5, 0.0], 1.0);
        check([a, a, b], [0.0, 0.5, 0.5], 1.0);
        check([a, a, a], [1.0, 0.0, 0.0], 2.0);
    }
}
