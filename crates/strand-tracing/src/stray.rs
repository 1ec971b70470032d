//! How far things that move are from where a tree has them.

use glam::DVec3;

use crate::tracks::Between;

/// More than the rounding of a point that is as far away as it strays.
const MARGIN: f64 = 1.0 + 1e-6;

/// The greatest distance of any of the points from where a tree has it, which keeps them in single precision
/// at its own keys and takes them to go straight in between. `exact` gives them at a time, not rounded.
///
/// The difference of two paths of straight stretches is greatest where one of them has a corner.
pub(crate) fn greatest<const N: usize>(
    of_object: usize,
    of_tree: usize,
    exact: impl Fn(f64) -> [DVec3; N],
) -> f64 {
    let time = |key: usize, intervals: usize| key as f64 / intervals as f64;
    let corners = |intervals: usize| (0..=intervals).map(move |key| time(key, intervals));
    let kept = |key: usize| exact(time(key, of_tree)).map(|point| point.as_vec3().as_dvec3());
    let strayed = corners(of_object).chain(corners(of_tree)).map(|time| {
        let Between { before, share } = Between::of(time, of_tree);
        let (low, high, exact) = (kept(before), kept(before + 1), exact(time));
        let apart = |i: usize| low[i].lerp(high[i], share).distance(exact[i]);
        (0..N).map(apart).fold(0.0, f64::max)
    });
    strayed.fold(0.0, f64::max) * MARGIN
}
