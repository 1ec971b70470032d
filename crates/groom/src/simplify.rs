//! Strands with fewer points that look the same.

use glam::DVec3;

use crate::gather::{Place, gather};
use crate::segment::{closest_parameter, distance_squared};
use crate::{FloatView, Groom, GroomError};

impl Groom {
    /// Leaves out points as long as every strand stays within `tolerance` (in the groom's units) of what
    /// it was.
    ///
    /// Kept are roots, tips and a choice of the points between, each with its attributes. Every point left
    /// out lies no farther than `tolerance` from the segment that bridges it, so the old polyline lies
    /// within `tolerance` of the new one and the new one within `tolerance` of the old. Where radii are
    /// per vertex, the radius of the new strand at the closest point is also within `tolerance` of the
    /// old radius; other attributes have no bound. Tolerance 0 leaves out what is straight.
    ///
    /// The points are chosen as Douglas and Peucker do (Algorithms for the reduction of the number of
    /// points required to represent a digitized line, 1973); of their choice those are dropped that the
    /// tolerance does not need. A strand with a point that is not finite stays as it is. Time grows with the
    /// points times the kept points of a strand at worst.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `tolerance` is finite and not negative.
    pub fn simplify(&self, tolerance: f32) -> Result<Groom, GroomError> {
        self.keep_points(&self.simple_points(tolerance)?)
    }

    /// The indices of the points that [`Groom::simplify`] keeps, in order; [`Groom::keep_points`] keeps
    /// them in other frames of the same groom.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `tolerance` is finite and not negative.
    pub fn simple_points(&self, tolerance: f32) -> Result<Vec<u32>, GroomError> {
        if !(tolerance.is_finite() && tolerance >= 0.0) {
            return Err(GroomError::argument("tolerance", tolerance, "a finite number, 0 or more"));
        }
        let radii = match self.radii() {
            FloatView::Vertex(radii) => Some(radii),
            _ => None,
        };
        let (mut points, mut kept, mut all) = (Vec::new(), Vec::new(), Vec::new());
        for index in 0..self.strand_count() {
            let range = self.strand_range(index);
            points.clear();
            points.extend(self.strand(index).iter().map(|p| p.as_dvec3()));
            let strand = Strand {
                points: &points,
                radii: radii.map(|radii| &radii[range.clone()]),
                tolerance: f64::from(tolerance) + rounding(&points),
            };
            if points.iter().all(|p| p.is_finite()) {
                strand.split(&mut kept);
                strand.join(&mut kept);
            } else {
                kept.clear();
                kept.extend(0..points.len());
            }
            all.extend(kept.iter().map(|&point| (range.start + point) as u32));
        }
        Ok(all)
    }

    /// The groom with these of its points only, by their indices in rising order, each with its attributes.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless the indices rise, belong to the groom and leave every strand a point.
    pub fn keep_points(&self, points: &[u32]) -> Result<Groom, GroomError> {
        let (mut offsets, mut next) = (vec![0], 0);
        for strand in 0..self.strand_count() {
            let end = self.offsets()[strand + 1];
            let before = next;
            while points.get(next).is_some_and(|&point| point < end) {
                next += 1;
            }
            if next == before {
                return Err(GroomError::argument("points kept of a strand", 0, "1 or more"));
            }
            offsets.push(next as u32);
        }
        if next != points.len() || points.windows(2).any(|pair| pair[1] <= pair[0]) {
            let expected = "rising indices of the groom's points";
            return Err(GroomError::argument("points kept", "another list", expected));
        }
        let places: Vec<Place> = points.iter().map(|&point| Place::at(point as usize)).collect();
        let strands: Vec<u32> = (0..self.strand_count() as u32).collect();
        Ok(gather(self, &strands, offsets, &places, false))
    }
}

/// What sums over these points may be off by: far below what their own 32 bits can tell.
fn rounding(points: &[DVec3]) -> f64 {
    let most = points.iter().fold(0.0_f64, |most, p| most.max(p.abs().max_element()));
    most * 64.0 * f64::EPSILON
}

/// One strand, and how far it may be missed.
struct Strand<'a> {
    points: &'a [DVec3],
    radii: Option<&'a [f32]>,
    tolerance: f64,
}

impl Strand<'_> {
    /// Fills `kept` with the indices Douglas and Peucker keep, in order.
    fn split(&self, kept: &mut Vec<usize>) {
        kept.clear();
        kept.push(0);
        let last = self.points.len() - 1;
        // The ends of spans still to be looked at, the nearest on top; each starts at the last kept point.
        let mut ends = if last > 0 { vec![last] } else { Vec::new() };
        while let Some(&end) = ends.last() {
            let start = kept[kept.len() - 1];
            let worst = (start + 1..end).map(|i| (i, self.miss(i, start, end)));
            // Not-a-number (a radius) is greater than all numbers here.
            match worst.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|&(_, miss)| !self.allows(miss)) {
                Some((farthest, _)) => ends.push(farthest),
                None => {
                    kept.push(end);
                    ends.pop();
                }
            }
        }
    }

    /// Drops those of the kept points that the tolerance does not need.
    fn join(&self, kept: &mut Vec<usize>) {
        let mut count = kept.len().min(1);
        for i in 1..kept.len() {
            let is_last = i + 1 == kept.len();
            if is_last || !self.bridges(kept[count - 1], kept[i + 1]) {
                kept[count] = kept[i];
                count += 1;
            }
        }
        kept.truncate(count);
    }

    fn bridges(&self, start: usize, end: usize) -> bool {
        (start + 1..end).all(|i| self.allows(self.miss(i, start, end)))
    }

    /// Written so that not-a-number is not allowed.
    fn allows(&self, miss: f64) -> bool {
        miss <= self.tolerance
    }

    /// How far point `i` and its radius are from the segment from `start` to `end`; positive
    /// not-a-number when a radius is not a number.
    fn miss(&self, i: usize, start: usize, end: usize) -> f64 {
        let (point, a, b) = (self.points[i], self.points[start], self.points[end]);
        let away = distance_squared(point, a, b).sqrt();
        let Some(radii) = self.radii else { return away };
        let t = closest_parameter(point, a, b);
        let [here, from, to] = [radii[i], radii[start], radii[end]].map(f64::from);
        let wrong = (from + (to - from) * t - here).abs();
        if wrong.is_nan() { f64::NAN.abs() } else { away.max(wrong) }
    }
}
