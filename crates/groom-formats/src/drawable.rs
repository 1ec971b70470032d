//! The strands that formats made of lines can hold: those of two points or more.

use std::ops::Range;

use groom::Groom;

use crate::{Format, FormatError, Warning};

/// A groom without its one-point strands.
#[derive(Clone, Copy)]
pub(crate) struct Drawable<'a> {
    pub(crate) groom: &'a Groom,
    pub(crate) strands: usize,
    pub(crate) points: usize,
}

impl<'a> Drawable<'a> {
    pub(crate) fn new(
        groom: &'a Groom,
        format: Format,
        file: &str,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, FormatError> {
        let one_point = groom.strands().filter(|points| points.len() < 2).count();
        let (strands, points) = (groom.strand_count() - one_point, groom.point_count() - one_point);
        if strands == 0 {
            return Err(FormatError::Empty { file: file.to_owned(), format, points: 2 });
        }
        if one_point > 0 {
            warnings.push(Warning::OnePointStrandsLeftOut { format, strands: one_point });
        }
        Ok(Drawable { groom, strands, points })
    }

    /// The strands kept: index in the groom and range of points there.
    pub(crate) fn strands(self) -> impl Iterator<Item = (usize, Range<usize>)> + 'a {
        let ranges = (0..self.groom.strand_count()).map(move |i| (i, self.groom.strand_range(i)));
        ranges.filter(|(_, range)| range.len() >= 2)
    }
}
