//! Only some of the strands.

use crate::length::length;
use crate::{Groom, GroomError};

impl Groom {
    /// The strands whose length lies in `min..=max` (in the groom's units), each keeping its identity in
    /// the `id` attribute. A groom of which all strands stay comes back as it is; a strand whose length is
    /// not a number goes.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `min` is at most `max`.
    pub fn filter_by_length(&self, min: f32, max: f32) -> Result<Groom, GroomError> {
        // Written so that not-a-number is refused too.
        if min.partial_cmp(&max).is_none_or(std::cmp::Ordering::is_gt) {
            let found = format!("{min} to {max}");
            return Err(GroomError::argument("range of lengths", found, "a least one not over the most"));
        }
        let range = f64::from(min)..=f64::from(max);
        let strands: Vec<u32> = (0..self.strand_count())
            .filter(|&strand| range.contains(&length(self.strand(strand))))
            .map(|strand| strand as u32)
            .collect();
        Ok(if strands.len() == self.strand_count() { self.clone() } else { self.select(strands) })
    }
}
