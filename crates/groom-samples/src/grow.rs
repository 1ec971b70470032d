//! One strand before it is curled: from its root along the comb, down by its weight.

use glam::Vec3;
use groom::random;

use crate::head;

/// Steps a strand is grown in, whatever the number of points asked for.
pub(crate) const STEPS: usize = 48;

/// The path of a strand of `length` from `root`, as `STEPS + 1` points.
pub(crate) fn path(root: Vec3, id: u32, seed: u64, length: f32) -> Vec<Vec3> {
    let chance = |purpose| random(seed, id, purpose);
    // Hair lies in layers: what grows higher up lies farther out.
    let height = (root.y / head::HEAD_RADII.y).max(0.0);
    let lift = 0.0015 + 0.010 * chance("lift") * (0.35 + height) + 0.004 * height;
    let sway = Vec3::new(chance("sway x") - 0.5, 0.0, chance("sway z") - 0.5) * 0.22;
    let side = side(root, id, seed);

    let step = length / STEPS as f32;
    let (mut point, mut direction) = (root, (head::normal(root) + comb(root, side) * 0.9).normalize());
    let mut points = vec![root];
    for i in 1..=STEPS {
        let t = i as f32 / STEPS as f32;
        // The root stands up; over a few centimetres weight and comb take over.
        let wanted = comb(point, side) + Vec3::NEG_Y * (0.5 + 1.2 * t) + sway;
        direction = (direction + wanted * (14.0 * step / (0.05 + 0.1 * step))).normalize();
        let grown = (t * length / 0.02).min(1.0);
        let next = head::keep_off(point + direction * step, lift * grown);
        direction = (next - point).normalize_or(direction);
        point += direction * step;
        points.push(point);
    }
    points
}

/// The side of the parting a strand falls to: -1 or 1. Close to the parting it is a matter of chance.
pub(crate) fn side(root: Vec3, id: u32, seed: u64) -> f32 {
    if root.x + 0.006 * (random(seed, id, "part") - 0.5) < 0.0 { -1.0 } else { 1.0 }
}

/// Where the comb pulls at `point`: along the head, away from the parting and the face, fading out
/// below the ears.
fn comb(point: Vec3, side: f32) -> Vec3 {
    let unit = point / head::HEAD_RADII;
    let high = (unit.y + 0.2).clamp(0.0, 1.0);
    let front = unit.z.max(0.0);
    let pull = Vec3::new(side * 1.3, -0.4, -0.35 - 0.9 * front) * high;
    // Over the face's edge hair keeps falling back a little, so that the face stays free.
    let aside = Vec3::new(side * 0.15, 0.0, -0.5) * front * (1.0 - high);
    let normal = head::normal(point);
    let along = pull - normal * pull.dot(normal);
    along + aside
}
