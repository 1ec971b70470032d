//! How far one groom is from another.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::segment::distance_squared;
use crate::{Domain, Groom, names};

/// Segments that share a box.
const BLOCK: usize = 8;

/// How far points lie from polylines, in the groom's units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The farthest a point lies from the other strand.
    pub max: f64,
    /// The root of the mean of the squared distances.
    pub rms: f64,
    /// How many points were measured.
    pub points: usize,
}

/// How far two grooms are from each other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distance {
    /// From the points of the first groom to the strands of the second.
    pub there: Deviation,
    /// From the points of the second groom to the strands of the first.
    pub back: Deviation,
    /// Strands that were compared.
    pub strands: usize,
    /// Index, in the first groom, of the strand with the greatest distance either way.
    pub worst_strand: Option<usize>,
    /// Strands of the first groom that the second does not have.
    pub only_in_first: usize,
    /// Strands of the second groom that the first does not have.
    pub only_in_second: usize,
}

impl Distance {
    /// The greatest distance, either way.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.there.max.max(self.back.max)
    }

    /// The root of the mean squared distance of all points, both ways.
    #[must_use]
    pub fn rms(&self) -> f64 {
        let both = [self.there, self.back];
        let sum: f64 = both.iter().map(|d| d.rms * d.rms * d.points as f64).sum();
        let points: usize = both.iter().map(|d| d.points).sum();
        if points == 0 { 0.0 } else { (sum / points as f64).sqrt() }
    }

    /// Measures from every point of a strand to the polyline of the same strand in the other groom, both
    /// ways.
    ///
    /// The same strand is the one with the same id; where neither groom has ids per strand, the one with
    /// the same index. Of strands that share an id the last counts. Units and axes are taken to be the same.
    /// Every distance is exact; segments whose box is farther than the best so far are skipped, so that
    /// the time grows little faster than the points. Points that are not finite are passed over.
    #[must_use]
    pub fn between(first: &Groom, second: &Groom) -> Distance {
        let has_ids = |groom: &Groom| groom.attribute(names::ID).is_some_and(|a| a.domain == Domain::Strand);
        let by_id: Option<HashMap<u32, usize>> = (has_ids(first) || has_ids(second))
            .then(|| (0..second.strand_count()).map(|strand| (second.strand_id(strand), strand)).collect());
        let twin = |strand: usize| match &by_id {
            Some(by_id) => by_id.get(&first.strand_id(strand)).copied(),
            None => Some(strand).filter(|&strand| strand < second.strand_count()),
        };
        let (mut there, mut back) = (Sum::default(), Sum::default());
        let mut distance = Distance::default();
        let mut farthest = -1.0;
        let mut met = vec![false; second.strand_count()];
        for strand in 0..first.strand_count() {
            let Some(other) = twin(strand) else {
                distance.only_in_first += 1;
                continue;
            };
            met[other] = true;
            distance.strands += 1;
            let (a, b) = (first.strand(strand), second.strand(other));
            let most = there.measure(a, &Polyline::of(b)).max(back.measure(b, &Polyline::of(a)));
            if most > farthest {
                farthest = most;
                distance.worst_strand = Some(strand);
            }
        }
        distance.only_in_second = met.iter().filter(|&&met| !met).count();
        (distance.there, distance.back) = (there.deviation(), back.deviation());
        distance
    }
}

/// Squared distances on their way into a [`Deviation`].
#[derive(Default)]
struct Sum {
    max: f64,
    sum: f64,
    points: usize,
}

impl Sum {
    /// Adds the points of a strand; gives the greatest squared distance among them.
    fn measure(&mut self, points: &[Vec3], line: &Polyline) -> f64 {
        let (mut most, mut near) = (0.0_f64, 0);
        for point in points.iter().filter(|p| p.is_finite()) {
            let Some(squared) = line.distance_squared(point.as_dvec3(), &mut near) else { continue };
            most = most.max(squared);
            self.sum += squared;
            self.points += 1;
        }
        self.max = self.max.max(most);
        most
    }

    fn deviation(&self) -> Deviation {
        let mean = if self.points == 0 { 0.0 } else { self.sum / self.points as f64 };
        Deviation { max: self.max.sqrt(), rms: mean.sqrt(), points: self.points }
    }
}

/// The finite points of a strand, and boxes around runs of its segments.
struct Polyline {
    points: Vec<DVec3>,
    boxes: Vec<(DVec3, DVec3)>,
}

impl Polyline {
    fn of(strand: &[Vec3]) -> Polyline {
        let points: Vec<DVec3> = strand.iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3()).collect();
        let segments = points.len().saturating_sub(1).max(1);
        let around = |block: usize| {
            let end = points.len().min((block + 1) * BLOCK + 1);
            let run = points.get(block * BLOCK..end).unwrap_or_default();
            let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            run.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)))
        };
        let boxes = (0..segments.div_ceil(BLOCK)).map(around).collect();
        Polyline { points, boxes }
    }

    /// The squared distance of `point`, or `None` from a strand without points. `near` is the block to look
    /// into first, and afterwards the one with the closest segment.
    fn distance_squared(&self, point: DVec3, near: &mut usize) -> Option<f64> {
        if let [only] = self.points[..] {
            return Some(point.distance_squared(only));
        }
        let mut best = self.in_block(*near, point);
        let first = *near;
        for (block, (low, high)) in self.boxes.iter().enumerate().filter(|&(block, _)| block != first) {
            let to_box = point.distance_squared(point.clamp(*low, *high));
            if to_box < best {
                let here = self.in_block(block, point);
                if here < best {
                    (best, *near) = (here, block);
                }
            }
        }
        best.is_finite().then_some(best)
    }

    fn in_block(&self, block: usize, point: DVec3) -> f64 {
        let end = self.points.len().min((block + 1) * BLOCK + 1);
        let run = self.points.get(block * BLOCK..end).unwrap_or_default();
        let to = |pair: &[DVec3]| distance_squared(point, pair[0], pair[1]);
        run.windows(2).map(to).fold(f64::INFINITY, f64::min)
    }
}
