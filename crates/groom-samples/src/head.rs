//! The head: an ellipsoid with a scalp.

use glam::Vec3;

use crate::trigonometry::{cos, sin};

/// Half the width, height and depth of the head, in metres.
pub const HEAD_RADII: Vec3 = Vec3::new(0.076, 0.108, 0.094);

/// How far out `point` is: 1 on the head's surface, 0 at its centre.
pub(crate) fn level(point: Vec3) -> f32 {
    (point / HEAD_RADII).length()
}

/// The outward normal of the level surface through `point`.
pub(crate) fn normal(point: Vec3) -> Vec3 {
    (point / (HEAD_RADII * HEAD_RADII)).normalize_or(Vec3::Y)
}

/// `point`, or the place above it that is `lift` metres off the head, whichever is farther out.
pub(crate) fn keep_off(point: Vec3, lift: f32) -> Vec3 {
    let least = 1.0 + lift / HEAD_RADII.min_element();
    let level = level(point);
    if level >= least || level == 0.0 { point } else { point * (least / level) }
}

/// The first `count` roots of a sequence that covers the scalp evenly, however long it is taken.
pub(crate) fn roots(count: u32) -> impl Iterator<Item = Vec3> {
    // A Kronecker sequence on the sphere's height and turn (Roberts' R2 constants).
    let candidates = (0_u64..).map(|i| {
        let fraction = |step: f64| (0.5 + step * i as f64).fract();
        let y = 1.0 - 2.0 * fraction(0.754_877_666_246_692_8);
        let turn = std::f64::consts::TAU * fraction(0.569_840_290_998_053_3);
        let ring = (1.0 - y * y).max(0.0).sqrt() as f32;
        Vec3::new(ring * cos(turn), y as f32, ring * sin(turn))
    });
    candidates
        .filter(|&direction| is_scalp(direction))
        .take(count as usize)
        .map(|direction| direction * HEAD_RADII)
}

/// Whether hair grows in that direction: above a hairline high over the face and low in the neck.
pub(crate) fn is_scalp(direction: Vec3) -> bool {
    let front = direction.z;
    let hairline = if front > 0.0 { 0.02 + 0.62 * front } else { 0.02 + 0.42 * front };
    direction.y > hairline
}
