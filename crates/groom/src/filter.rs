//! Only some of the strands.

use crate::length::length;
use crate::{Groom, GroomError};

impl Groom {
    /// The indices of the strands whose length lies in `min..=max` (in the groom's units); a length that is
    /// not a number lies nowhere. [`Groom::keep_strands`] keeps them.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `min` is at most `max`.
    pub fn strands_by_length(&self, min: f32, max: f32) -> Result<Vec<u32>, GroomError> {
        // Written so that not-a-number is refused too.
        if min.partial_cmp(&max).is_none_or(std::cmp::Ordering::is_gt) {
            let found = format!("{min} to {max}");
            return Err(GroomError::argument("range of lengths", found, "a least one not over the most"));
        }
        let range = f64::from(min)..=f64::from(max);
        let strands = 0..self.strand_count() as u32;
        Ok(strands.filter(|&strand| range.contains(&length(self.strand(strand as usize)))).collect())
    }

    /// The strands of these indices, in their order, each keeping its identity in the `id` attribute.
    ///
    /// # Errors
    /// [`GroomError::Argument`] when one is not there.
    pub fn keep_strands(&self, strands: &[u32]) -> Result<Groom, GroomError> {
        match strands.iter().find(|&&strand| strand as usize >= self.strand_count()) {
            Some(strand) => Err(GroomError::argument("strand", strand, "one of the groom's")),
            None => Ok(self.select(strands.to_vec())),
        }
    }
}
