//! How thick a body is under its skin.

use glam::DVec3;

use crate::FurSurface;
use crate::scatter::Root;

/// Most places that are looked into; more share what was seen at the nearest of these.
pub(crate) const PROBES: usize = 2048;

/// How far it is from each place straight inwards to the other side; infinite where nothing is behind.
///
/// Fur is short where a body is thin, on ears, legs and noses: this tells where that is, without a tree, for places
/// that are few.
pub(crate) fn thickness(surface: &FurSurface<'_>, places: &[Root]) -> Vec<f64> {
    let inward = |root: &Root| {
        let crossing = |t: &[u32; 3]| crossing(root, t.map(|v| surface.positions[v as usize]));
        surface.triangles.iter().filter_map(crossing).fold(f64::INFINITY, f64::min)
    };
    places.iter().map(inward).collect()
}

/// Where the line from a place inwards comes out through a triangle that faces away from it (Moeller, Trumbore: Fast,
/// Minimum Storage Ray/Triangle Intersection, 1997).
fn crossing(root: &Root, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let direction = -root.normal;
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    // Under 0 where the line leaves the body.
    let determinant = ab.dot(p);
    if determinant >= 0.0 {
        return None;
    }
    let from = root.place - a;
    let u = from.dot(p) / determinant;
    let q = from.cross(ab);
    let v = direction.dot(q) / determinant;
    let t = ac.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}
