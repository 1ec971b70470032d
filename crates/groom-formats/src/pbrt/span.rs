//! A Catmull-Rom curve through the points of a strand, as Bezier spans.

use glam::{DVec3, Vec3};

/// The four control points of the span from point `index` to the next.
///
/// The first and the last are the strand's points to the bit. `index + 1` is a point of the strand.
pub(crate) fn bezier(points: &[Vec3], index: usize) -> [Vec3; 4] {
    let point = |index: usize| points[index].as_dvec3();
    let (from, to) = (point(index), point(index + 1));
    // Beyond an end the strand goes on as it came.
    let before = if index == 0 { 2.0 * from - to } else { point(index - 1) };
    let after = if index + 2 == points.len() { 2.0 * to - from } else { point(index + 2) };
    // Near the largest floats a control point would lie beyond them.
    let most = DVec3::splat(f32::MAX.into());
    let inner = |at: DVec3, along: DVec3| (at + along / 6.0).clamp(-most, most).as_vec3();
    [points[index], inner(from, to - before), inner(to, from - after), points[index + 1]]
}

/// Whether widths go evenly from the first to the last, to a thousandth of the larger of the two.
pub(crate) fn is_even(widths: impl ExactSizeIterator<Item = f32> + Clone) -> bool {
    let last_index = widths.len().saturating_sub(1);
    let (Some(first), Some(last)) = (widths.clone().next(), widths.clone().last()) else { return true };
    let (first, last) = (f64::from(first), f64::from(last));
    let allowed = 1e-3 * first.max(last);
    widths.enumerate().all(|(index, width)| {
        let t = index as f64 / last_index.max(1) as f64;
        (f64::from(width) - (first + (last - first) * t)).abs() <= allowed
    })
}
