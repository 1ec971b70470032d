//! Long segments across the axes, cut into pieces with boxes of their own.
//!
//! The box round a diagonal needle is nearly empty. A line through the scene crosses it with a chance that
//! goes with its area, a sum of products of two extents, so `n` pieces have an `n`th of it together, and
//! the sum over all segments for a given number of pieces is least where `n` goes with the area's root.
//! Segments are cut where boxes lie in heaps: where many would be crossed in vain by every line.
//!
//! Pieces are for finding candidates only: what is then intersected is the whole segment.

use glam::{DVec3, Vec3, Vec4, Vec4Swizzles};

/// Boxes crossed by a line through the scene that are not worth cutting.
const BEARABLE: f64 = 16.0;
/// Cuts a segment, on average, at most.
const SPARE: f64 = 0.5;
/// Cuts in one segment at most.
const MOST: f64 = 31.0;
/// A piece is short enough when the box round its axis has this many squared radii.
const PLUMP: f64 = 16.0;

/// A stretch of a segment: a cone-sphere that holds it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// The segment.
    pub(crate) number: u32,
    pub(crate) a: Vec4,
    pub(crate) b: Vec4,
}

/// Cuts segments, given as whole pieces.
pub(crate) fn cut(whole: Vec<Piece>) -> Vec<Piece> {
    let cuts = cuts(&whole);
    if cuts.is_empty() {
        return whole;
    }
    let mut pieces = Vec::with_capacity(whole.len() + cuts.iter().sum::<u32>() as usize);
    for (piece, &cuts) in whole.iter().zip(&cuts) {
        match cuts {
            0 => pieces.push(*piece),
            cuts => pieces.extend((0..=cuts).map(|part| part_of(piece, part, cuts + 1))),
        }
    }
    pieces
}

/// How often each segment is cut; empty where none is.
pub(crate) fn cuts(whole: &[Piece]) -> Vec<u32> {
    let (low, high) = whole.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), piece| {
        let (a, b) = (piece.a.xyz(), piece.b.xyz());
        (low.min(a).min(b), high.max(a).max(b))
    });
    let bearable = BEARABLE * area(high.as_dvec3() - low.as_dvec3()) / whole.len() as f64;
    let cuts = |piece: &Piece| {
        let area = area(piece.b.xyz().as_dvec3() - piece.a.xyz().as_dvec3());
        let radius = f64::from(piece.a.w.abs().max(piece.b.w.abs()));
        let plump = PLUMP * radius * radius;
        ((area / bearable).sqrt().min((area / plump).sqrt()) - 1.0).clamp(0.0, MOST)
    };
    let wanted: f64 = whole.iter().map(cuts).sum();
    if wanted < 1.0 || !wanted.is_finite() {
        return Vec::new();
    }
    let share = (SPARE * whole.len() as f64 / wanted).min(1.0);
    whole.iter().map(|piece| (cuts(piece) * share).round() as u32).collect()
}

/// Half the surface of a box.
fn area(size: DVec3) -> f64 {
    let size = size.abs();
    size.x * size.y + size.y * size.z + size.z * size.x
}

/// One of `count` equal parts, wider by the rounding of its ends.
fn part_of(piece: &Piece, part: u32, count: u32) -> Piece {
    let (a, b) = (piece.a.xyz().as_dvec3(), piece.b.xyz().as_dvec3());
    let (ra, rb) = (f64::from(piece.a.w.abs()), f64::from(piece.b.w.abs()));
    let rounding = f64::from(f32::EPSILON) * a.abs().max(b.abs()).max_element();
    let at = |u: f64| {
        let centre: DVec3 = a + (b - a) * u;
        let radius = ra + (rb - ra) * u + rounding;
        centre.as_vec3().extend((radius as f32).next_up())
    };
    let u = |part: u32| f64::from(part) / f64::from(count);
    Piece { number: piece.number, a: at(u(part)), b: at(u(part + 1)) }
}

#[cfg(test)]
mod tests {
    use glam::vec3;

    use super::*;
    use crate::cone_sphere::ConeSphere;

    /// A heap of crossed needles that is worth cutting.
    fn needles(far: f32, scale: f32) -> Vec<Piece> {
        (0..400)
            .map(|number| {
                let turn = number as f32;
                let way = vec3(turn.sin(), turn.cos(), (turn * 1.7).sin()) * scale;
                let centre = vec3((turn * 0.3).cos(), (turn * 0.7).sin(), 0.0) * 0.1 * scale;
                let middle = centre + Vec3::splat(far);
                let radius = 0.01 * scale;
                Piece { number, a: (middle - way).extend(radius), b: (middle + way).extend(-0.5 * radius) }
            })
            .collect()
    }

    #[test]
    fn pieces_hold_their_segments_and_stay_few() {
        for (far, scale) in [(0.0, 1.0), (1e6, 100.0), (1.0, 1e-6), (0.0, 1e6)] {
            let whole = needles(far, scale);
            let pieces = cut(whole.clone());
            assert!(pieces.len() > whole.len() && pieces.len() <= 2 * whole.len(), "{}", pieces.len());
            for segment in &whole {
                let cone = ConeSphere::new(segment.a, segment.b);
                let mine: Vec<_> = pieces
                    .iter()
                    .filter(|piece| piece.number == segment.number)
                    .map(|piece| ConeSphere::new(piece.a, piece.b))
                    .collect();
                for step in 0..=64 {
                    let u = f64::from(step) / 64.0;
                    let centre = cone.a + cone.ab * u;
                    let inside =
                        mine.iter().any(|piece| piece.distance(centre) <= -cone.radius(u) * (1.0 - 1e-9));
                    assert!(inside, "{u} of {segment:?}");
                }
            }
        }
    }

    #[test]
    fn sparse_segments_are_left_whole() {
        let alone =
            vec![Piece { number: 3, a: Vec4::new(0.0, 0.0, 0.0, 0.1), b: Vec4::new(1.0, 1.0, 1.0, -0.1) }];
        assert_eq!(cut(alone).len(), 1);
        assert!(cut(Vec::new()).is_empty());
    }
}
