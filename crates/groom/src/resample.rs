//! Strands with other numbers of points.

use crate::gather::{Place, gather};
use crate::length::arc_lengths;
use crate::{Groom, GroomError};

impl Groom {
    /// Every strand with `points` points, evenly spread along its length.
    ///
    /// Roots and tips stay exactly where they are; per-vertex attributes are interpolated with the
    /// points, integers taken from the nearer old vertex. A strand without length gets `points` equal
    /// points; so does a strand with a single point.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `points` is at least 2 and the result has fewer than 2^32.
    pub fn resample_by_count(&self, points: usize) -> Result<Groom, GroomError> {
        if points < 2 {
            return Err(GroomError::argument("points per strand", points, "at least 2"));
        }
        self.resample(|_, _| points as f64 - 1.0)
    }

    /// Every strand with points no farther than `step` apart along it, evenly spread.
    ///
    /// Otherwise as [`Groom::resample_by_count`]; a strand shorter than `step` keeps root and tip only.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `step` is positive and finite and the result has fewer than 2^32
    /// points.
    pub fn resample_by_length(&self, step: f32) -> Result<Groom, GroomError> {
        if !(step.is_finite() && step > 0.0) {
            return Err(GroomError::argument("step along the strand", step, "a positive finite number"));
        }
        self.resample(|_, length| (length / f64::from(step)).ceil().max(1.0))
    }

    /// Every strand with as many points as `like`, the offsets of another groom, gives the strand of that
    /// index, evenly spread along its length; otherwise as [`Groom::resample_by_count`]. Frames of one
    /// groom come out alike by this.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless both have as many strands, and the others two points or more.
    pub fn resample_like(&self, like: &[u32]) -> Result<Groom, GroomError> {
        if like.len() != self.offsets().len() {
            let found = like.len().saturating_sub(1);
            return Err(GroomError::argument("strands to be like", found, "as many as the groom has"));
        }
        if like.windows(2).any(|ends| ends[1].saturating_sub(ends[0]) < 2) {
            return Err(GroomError::argument("points per strand", "less", "at least 2"));
        }
        self.resample(|strand, _| f64::from(like[strand + 1] - like[strand] - 1))
    }

    /// Every strand with `segments(index, length)` segments.
    fn resample(&self, segments: impl Fn(usize, f64) -> f64) -> Result<Groom, GroomError> {
        let (mut offsets, mut places, mut along) = (vec![0], Vec::new(), Vec::new());
        for strand in 0..self.strand_count() {
            let start = self.strand_range(strand).start;
            let length = arc_lengths(self.strand(strand), &mut along);
            let count = segments(strand, length);
            // Not-a-number, from points that are not finite, keeps the strand to its ends.
            let count = if count.is_nan() { 1.0 } else { count };
            let end = places.len() as f64 + count + 1.0;
            if end > f64::from(u32::MAX) {
                return Err(GroomError::argument("points of the resampled groom", end, "fewer than 2^32"));
            }
            spread(start, &along, count as usize, &mut places);
            offsets.push(places.len() as u32);
        }
        let strands: Vec<u32> = (0..self.strand_count() as u32).collect();
        Ok(gather(self, &strands, offsets, &places, false))
    }
}

/// Appends `segments + 1` places evenly spread along the strand that starts at vertex `start`.
fn spread(start: usize, along: &[f64], segments: usize, places: &mut Vec<Place>) {
    let last = along.len() - 1;
    let length = along[last];
    let mut from = 0;
    places.push(Place::at(start));
    for i in 1..segments {
        let target = length * i as f64 / segments as f64;
        while from + 1 < last && along[from + 1] < target {
            from += 1;
        }
        let (low, high) = (along[from], along[last.min(from + 1)]);
        let t = if high > low { ((target - low) / (high - low)).clamp(0.0, 1.0) as f32 } else { 0.0 };
        places.push(Place { from: (start + from) as u32, t });
    }
    places.push(Place::at(start + last));
}
