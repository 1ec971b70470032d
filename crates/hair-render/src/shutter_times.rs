//! The time of a sample: drawn as the shutter lets light in.

use std::f64::consts::TAU;

use crate::shutter_shape::ShutterShape;

/// Turns even numbers into times that are as frequent as the shutter is open. What is let in is thereby
/// always the same light in all, whatever the shape.
#[derive(Clone, Debug)]
pub(crate) enum ShutterTimes {
    Even,
    Cosine,
    Corners(Vec<Corner>),
}

/// A corner of a shape made of straight lines.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    time: f64,
    height: f64,
    /// Under the shape until here, as a share of the whole.
    area: f64,
}

impl ShutterTimes {
    /// `shape` is one that [`crate::Shutter::new`] has checked.
    pub fn new(shape: &ShutterShape) -> Self {
        let Some(mut corners) = shape.corners() else {
            return if *shape == ShutterShape::Cosine { ShutterTimes::Cosine } else { ShutterTimes::Even };
        };
        let highest = corners.iter().fold(0.0, |highest: f64, corner| highest.max(corner.1));
        if highest <= 0.0 {
            return ShutterTimes::Even;
        }
        corners.iter_mut().for_each(|corner| corner.1 /= highest);
        let mut sum = 0.0;
        let mut found: Vec<Corner> = Vec::with_capacity(corners.len());
        for (time, height) in corners {
            if let Some(before) = found.last() {
                sum += 0.5 * (time - before.time) * (height + before.height);
            }
            found.push(Corner { time, height, area: sum });
        }
        found.iter_mut().for_each(|corner| corner.area /= sum);
        // Heights are kept in the unit in which the whole area is 1.
        found.iter_mut().for_each(|corner| corner.height /= sum);
        ShutterTimes::Corners(found)
    }

    /// The time, 0 at opening and 1 at closing, before which the share `u` (0..1) of the light is let in.
    #[inline]
    pub fn at(&self, u: f32) -> f32 {
        match self {
            ShutterTimes::Even => u,
            ShutterTimes::Cosine => cosine(f64::from(u)) as f32,
            ShutterTimes::Corners(corners) => between(corners, f64::from(u)) as f32,
        }
    }
}

/// Solves for the time within the line between two corners; in the form of the quadratic's root that has no
/// difference of like numbers in it.
fn between(corners: &[Corner], u: f64) -> f64 {
    let after = corners.partition_point(|corner| corner.area <= u).min(corners.len().saturating_sub(1));
    let (Some(a), Some(b)) = (corners.get(after.saturating_sub(1)), corners.get(after)) else { return u };
    let width = b.time - a.time;
    if width <= 0.0 {
        return b.time;
    }
    let area = ((u - a.area) / width).max(0.0);
    let root = (a.height * a.height + 2.0 * (b.height - a.height) * area).max(0.0).sqrt();
    let below = a.height + root;
    let share = if below > 0.0 { 2.0 * area / below } else { 0.0 };
    a.time + width * share.min(1.0)
}

/// Solves `t - sin(tau t) / tau = u` by Newton's method, from where the cubic at the opening is.
fn cosine(u: f64) -> f64 {
    let (half, mirrored) = if u > 0.5 { (1.0 - u, true) } else { (u, false) };
    let mut t = (half * 6.0 / (TAU * TAU)).cbrt();
    for _ in 0..5 {
        let (sin, cos) = (TAU * t).sin_cos();
        let slope = 1.0 - cos;
        if slope < 1e-12 {
            break;
        }
        t -= (t - sin / TAU - half) / slope;
    }
    let t = t.clamp(0.0, 0.5);
    if mirrored { 1.0 - t } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Height of a shape at a time, by its definition, not normalised.
    fn height(shape: &ShutterShape, t: f64) -> f64 {
        match shape {
            ShutterShape::Box => 1.0,
            ShutterShape::Triangle => 1.0 - (2.0 * t - 1.0).abs(),
            ShutterShape::Trapezoid { opening, closing } => {
                (t / opening.max(1e-300)).min((1.0 - t) / closing.max(1e-300)).min(1.0)
            }
            ShutterShape::Cosine => 0.5 - 0.5 * (TAU * t).cos(),
            ShutterShape::Curve(heights) => {
                let at = t * (heights.len() - 1) as f64;
                let i = (at as usize).min(heights.len() - 2);
                heights[i] + (heights[i + 1] - heights[i]) * (at - i as f64)
            }
        }
    }

    fn shapes() -> Vec<ShutterShape> {
        vec![
            ShutterShape::Box,
            ShutterShape::Triangle,
            ShutterShape::Trapezoid { opening: 0.2, closing: 0.5 },
            ShutterShape::Trapezoid { opening: 0.0, closing: 1.0 },
            ShutterShape::Trapezoid { opening: 0.0, closing: 0.0 },
            ShutterShape::Cosine,
            ShutterShape::Curve(vec![0.0, 0.0, 3.0, 1.0, 0.0, 0.0, 2.0, 0.0]),
            ShutterShape::Curve(vec![1e30, 1e-9]),
        ]
    }

    /// The share of times below t is the share of the shape's area there.
    #[test]
    fn times_are_as_frequent_as_the_shutter_is_open() {
        const COUNT: usize = 20_000;
        for shape in shapes() {
            let times = ShutterTimes::new(&shape);
            let drawn: Vec<f64> =
                (0..COUNT).map(|i| f64::from(times.at((i as f32 + 0.5) / COUNT as f32))).collect();
            assert!(drawn.windows(2).all(|pair| pair[0] <= pair[1]), "{shape}: in order");
            assert!(drawn.iter().all(|t| (0.0..=1.0).contains(t)), "{shape}");
            let step = |i: usize| height(&shape, (i as f64 + 0.5) / COUNT as f64);
            let whole: f64 = (0..COUNT).map(step).sum();
            let mut area = 0.0;
            for slot in 0..50 {
                area += (slot * COUNT / 50..(slot + 1) * COUNT / 50).map(step).sum::<f64>();
                let edge = (slot + 1) as f64 / 50.0;
                let below = drawn.partition_point(|&t| t < edge) as f64 / COUNT as f64;
                assert!(
                    (below - area / whole).abs() < 1e-3,
                    "{shape} until {edge}: {below} {}",
                    area / whole
                );
            }
        }
    }

    #[test]
    fn the_ends_are_met_and_nothing_lies_beyond() {
        for shape in shapes() {
            let times = ShutterTimes::new(&shape);
            for u in [0.0, f32::MIN_POSITIVE, 1e-7, 0.5, 1.0 - f32::EPSILON / 2.0] {
                let t = times.at(u);
                assert!((0.0..=1.0).contains(&t), "{shape} at {u}: {t}");
            }
        }
        assert_eq!(ShutterTimes::new(&ShutterShape::Box).at(0.3), 0.3);
        assert_eq!(ShutterTimes::new(&ShutterShape::Cosine).at(0.5), 0.5);
    }
}
