//! Fewer strands.

use crate::gather::{Place, gather};
use crate::{Groom, GroomError};

impl Groom {
    /// Every `stride`-th strand, from the first on, each keeping its identity in the `id` attribute.
    ///
    /// # Errors
    /// [`GroomError::Argument`] when `stride` is 0.
    pub fn subsample_by_stride(&self, stride: usize) -> Result<Groom, GroomError> {
        if stride == 0 {
            let (what, found) = ("stride", "0".to_owned());
            return Err(GroomError::Argument { what, found, expected: "at least 1" });
        }
        Ok(self.select((0..self.strand_count() as u32).step_by(stride).collect()))
    }

    /// At most `max_strands` strands, evenly spread over the groom, each keeping its identity in the
    /// `id` attribute. A groom that has no more comes back as it is.
    #[must_use]
    pub fn subsample_to(&self, max_strands: usize) -> Groom {
        let count = self.strand_count() as u64;
        let kept = (max_strands as u64).min(count);
        if kept == count {
            return self.clone();
        }
        self.select((0..kept).map(|i| (i * count / kept) as u32).collect())
    }

    /// The strands whose indices are given, in that order; `id` says who they were.
    pub(crate) fn select(&self, strands: Vec<u32>) -> Groom {
        let (mut offsets, mut places) = (vec![0], Vec::new());
        for &strand in &strands {
            places.extend(self.strand_range(strand as usize).map(Place::at));
            offsets.push(places.len() as u32);
        }
        gather(self, &strands, offsets, &places, true)
    }
}
