//! Cubic curves as polylines.
//!
//! Every span is brought into Bezier form, and cut into as many equal parts as keep the polyline within the error
//! asked for: the distance of a curve from the chord of a part is at most an eighth of its second derivative
//! times the square of the part, and that derivative is at most six times the larger second difference of the
//! four Bezier points. A span has 256 parts at most. Where no error is asked for it is a thousandth of the
//! curve's length, or as much more as keeps the polylines within four times the control points.

use glam::DVec3;

use crate::polylines::{Shape, Wrap};

/// Parts of a span, at most.
const MOST_PARTS: u16 = 256;

/// The error where none is asked for, in lengths of the curve.
pub(crate) const RELATIVE_ERROR: f64 = 1e-3;

/// How four points make a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Basis {
    Bezier,
    Bspline,
    CatmullRom,
}

impl Basis {
    /// Points from one span to the next.
    fn step(self) -> usize {
        if self == Basis::Bezier { 3 } else { 1 }
    }

    /// Bezier points times six from the four points of a span.
    fn bezier_weights(self) -> [[f64; 4]; 4] {
        match self {
            Basis::Bezier => {
                [[6.0, 0.0, 0.0, 0.0], [0.0, 6.0, 0.0, 0.0], [0.0, 0.0, 6.0, 0.0], [0.0, 0.0, 0.0, 6.0]]
            }
            Basis::Bspline => {
                [[1.0, 4.0, 1.0, 0.0], [0.0, 4.0, 2.0, 0.0], [0.0, 2.0, 4.0, 0.0], [0.0, 1.0, 4.0, 1.0]]
            }
            Basis::CatmullRom => {
                [[0.0, 6.0, 0.0, 0.0], [-1.0, 6.0, 1.0, 0.0], [0.0, 1.0, 6.0, -1.0], [0.0, 0.0, 6.0, 0.0]]
            }
        }
    }
}

/// A number or vector that curves are made of.
pub(crate) trait Point: Copy {
    fn wide(self) -> DVec3;
    fn narrow(wide: DVec3) -> Self;
}

impl Point for f32 {
    fn wide(self) -> DVec3 {
        DVec3::new(self.into(), 0.0, 0.0)
    }
    fn narrow(wide: DVec3) -> Self {
        wide.x as f32
    }
}

impl Point for glam::Vec2 {
    fn wide(self) -> DVec3 {
        self.as_dvec2().extend(0.0)
    }
    fn narrow(wide: DVec3) -> Self {
        wide.truncate().as_vec2()
    }
}

impl Point for glam::Vec3 {
    fn wide(self) -> DVec3 {
        self.as_dvec3()
    }
    fn narrow(wide: DVec3) -> Self {
        wide.as_vec3()
    }
}

/// The Bezier points of a span of a curve.
fn span<P: Point>(points: &[P], basis: Basis, wrap: Wrap, index: usize) -> [DVec3; 4] {
    let count = points.len();
    let at = |place: isize| -> DVec3 {
        let wide = |place: usize| points.get(place).map_or(DVec3::ZERO, |point| point.wide());
        match wrap {
            Wrap::Periodic => wide(place.rem_euclid(count.max(1) as isize) as usize),
            // Points beyond the ends lie as far outside as the next ones inside: the curve starts at the end.
            _ if place < 0 => 2.0 * wide(0) - wide(1),
            _ if place as usize >= count => 2.0 * wide(count - 1) - wide(count.saturating_sub(2)),
            _ => wide(place as usize),
        }
    };
    let lead = isize::from(wrap == Wrap::Pinned && basis != Basis::Bezier);
    let first = (index * basis.step()) as isize - lead;
    let four = [at(first), at(first + 1), at(first + 2), at(first + 3)];
    if basis == Basis::Bezier {
        return four;
    }
    basis.bezier_weights().map(|weights| {
        let sum = weights.iter().zip(four).fold(DVec3::ZERO, |sum, (&weight, point)| sum + weight * point);
        sum / 6.0
    })
}

fn evaluate(bezier: &[DVec3; 4], t: f64) -> DVec3 {
    let s = 1.0 - t;
    bezier[0] * (s * s * s)
        + bezier[1] * (3.0 * s * s * t)
        + bezier[2] * (3.0 * s * t * t)
        + bezier[3] * (t * t * t)
}

/// How far a polyline may be from its curve.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Tolerance {
    /// In units of the file.
    Absolute(f64),
    /// In lengths of the curve.
    Relative(f64),
}

/// Adds to `parts` how many every span of a curve is cut into.
pub(crate) fn cut<P: Point>(
    points: &[P],
    basis: Basis,
    shape: Shape,
    tolerance: Tolerance,
    parts: &mut Vec<u16>,
) {
    let spans = shape.spans(points.len() as u32).unwrap_or_default() as usize;
    let spans = (0..spans).map(|index| span(points, basis, shape.wrap, index));
    let error = match tolerance {
        Tolerance::Absolute(error) => error,
        Tolerance::Relative(lengths) => {
            // Halves of spans, so that a loop has a length too.
            let length: f64 = spans
                .clone()
                .map(|bezier| {
                    let middle = evaluate(&bezier, 0.5);
                    bezier[0].distance(middle) + middle.distance(bezier[3])
                })
                .sum();
            lengths * length
        }
    };
    parts.extend(spans.map(|b| {
        let bend = (b[0] - 2.0 * b[1] + b[2]).length().max((b[1] - 2.0 * b[2] + b[3]).length());
        let wanted = (0.75 * bend / error).sqrt().ceil();
        // Not a number where nothing bends and no error is allowed, or where points are infinitely far away.
        if wanted.is_nan() { 1 } else { wanted.clamp(1.0, MOST_PARTS.into()) as u16 }
    }));
}

/// Adds to `out` the values at the points of the polyline of a curve with a value a control point.
pub(crate) fn sample<P: Point>(values: &[P], basis: Basis, wrap: Wrap, parts: &[u16], out: &mut Vec<P>) {
    let mut end = None;
    for (index, &count) in parts.iter().enumerate() {
        let bezier = span(values, basis, wrap, index);
        let places = (0..count).map(|place| evaluate(&bezier, f64::from(place) / f64::from(count)));
        out.extend(places.map(P::narrow));
        end = Some(P::narrow(bezier[3]));
    }
    out.extend(end);
}

/// As [`sample`] for values at the ends of spans, linear between.
pub(crate) fn sample_varying<P: Point>(ends: &[P], wrap: Wrap, parts: &[u16], out: &mut Vec<P>) {
    let at = |place: usize| {
        let place = if wrap == Wrap::Periodic {
            place % ends.len().max(1)
        } else {
            place.min(ends.len().saturating_sub(1))
        };
        ends.get(place).map_or(DVec3::ZERO, |end| end.wide())
    };
    for (index, &count) in parts.iter().enumerate() {
        let (a, b) = (at(index), at(index + 1));
        out.extend((0..count).map(|place| P::narrow(a.lerp(b, f64::from(place) / f64::from(count)))));
    }
    if !parts.is_empty() {
        out.push(P::narrow(at(parts.len())));
    }
}
