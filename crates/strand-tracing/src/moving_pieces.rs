//! Stretches of moving segments, at the keys of the tree over them.
//!
//! The tree has keys of its own, evenly spaced like those of the objects but perhaps fewer. Between two of
//! them a piece is taken to move in a straight line; where its object turns a corner in between, the piece is
//! as much thicker as the object strays from that line.

use glam::{DVec3, Vec3, Vec4, Vec4Swizzles};

use crate::fibres::Fibres;
use crate::pieces::{self, Piece};
use crate::pose::{Moment, Pose};
use crate::stray;
use crate::tracks::{Between, Track};

/// A stretch of a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingPiece {
    /// The segment.
    pub(crate) number: u32,
    /// Where it starts and ends along the segment, in parts of `count`.
    part: u16,
    count: u16,
    /// How far the ends ever are from where the tree has them.
    stray: f64,
}

/// All pieces of all segments that move.
pub(crate) struct MovingPieces<'a> {
    fibres: &'a Fibres,
    intervals: usize,
    pub(crate) all: Vec<MovingPiece>,
}

impl<'a> MovingPieces<'a> {
    /// For a tree of so many intervals. Segments are cut as they would be in the middle of the shutter.
    pub(crate) fn cut(pose: &Moment<'a>, intervals: usize) -> Self {
        let fibres = pose.fibres;
        let middle = Moment { time: 0.5, ..*pose };
        let moving = fibres.solid().filter(|&number| fibres.tracks().of(number).is_some());
        let whole: Vec<_> =
            moving.filter_map(|number| middle.ends(number).map(|(a, b)| Piece { number, a, b })).collect();
        let cuts = pieces::cuts(&whole);
        let mut pieces = Self { fibres, intervals, all: Vec::with_capacity(whole.len()) };
        for (place, piece) in whole.iter().enumerate() {
            let cuts = cuts.get(place).copied().unwrap_or(0) as u16;
            for part in 0..=cuts {
                let whole = MovingPiece { number: piece.number, part, count: cuts + 1, stray: 0.0 };
                let stray = pieces.stray(&whole);
                pieces.all.push(MovingPiece { stray, ..whole });
            }
        }
        pieces
    }

    /// How far some of the segments stray and how thick they are, for a tree of so many intervals.
    pub(crate) fn strays(
        fibres: &'a Fibres,
        intervals: usize,
        samples: usize,
    ) -> impl Iterator<Item = (f64, f64)> {
        let pieces = Self { fibres, intervals, all: Vec::new() };
        let moving = move |&number: &u32| fibres.tracks().of(number).is_some();
        let step = fibres.solid().filter(moving).count() / samples + 1;
        fibres.solid().filter(moving).step_by(step).filter_map(move |number| {
            let (a, b) = fibres.ends(number)?;
            let stray = pieces.stray(&MovingPiece { number, part: 0, count: 1, stray: 0.0 });
            Some((stray, f64::from(a.w.abs().max(b.w.abs()))))
        })
    }

    /// The ends of a piece at a key of the tree, with radii.
    pub(crate) fn ends(&self, piece: &MovingPiece, key: usize) -> (Vec4, Vec4) {
        let [a, b] = self.exact(piece, key as f64 / self.intervals as f64).map(|end| end.as_vec3());
        let Some((first, last)) = self.fibres.ends(piece.number) else { return (Vec4::ZERO, Vec4::ZERO) };
        let (ra, rb) = (f64::from(first.w.abs()), f64::from(last.w.abs()));
        let radius = |part: u16| match part {
            0 if piece.stray == 0.0 => first.w.abs(),
            part if part == piece.count && piece.stray == 0.0 => last.w.abs(),
            part => {
                let u = f64::from(part) / f64::from(piece.count);
                ((ra + (rb - ra) * u + piece.stray) as f32).next_up()
            }
        };
        (a.extend(radius(piece.part)), b.extend(radius(piece.part + 1)))
    }

    /// The ends, not rounded.
    fn exact(&self, piece: &MovingPiece, time: f64) -> [DVec3; 2] {
        let Some((a, b)) = self.fibres.ends(piece.number) else { return [DVec3::ZERO; 2] };
        let Some(track) = self.fibres.tracks().of(piece.number) else { return [DVec3::ZERO; 2] };
        let (a, b) = (at(track, piece.number, a.xyz(), time), at(track, piece.number + 1, b.xyz(), time));
        [piece.part, piece.part + 1].map(|part| {
            let u = f64::from(part) / f64::from(piece.count);
            a * (1.0 - u) + b * u
        })
    }

    fn stray(&self, piece: &MovingPiece) -> f64 {
        match self.fibres.tracks().of(piece.number) {
            Some(track) if track.intervals() != self.intervals || piece.count > 1 => {
                stray::greatest(track.intervals(), self.intervals, |time| self.exact(piece, time))
            }
            _ => 0.0,
        }
    }
}

/// Where a point is, not rounded.
fn at(track: &Track<Vec3>, number: u32, first: Vec3, time: f64) -> DVec3 {
    let Between { before, share } = Between::of(time, track.intervals());
    let (low, high) = (track.at(number, before, first), track.at(number, before + 1, first));
    low.as_dvec3() * (1.0 - share) + high.as_dvec3() * share
}
