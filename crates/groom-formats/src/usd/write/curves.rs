//! Which strands become curves, and the points they get.

use std::ops::Range;

use groom::Groom;

use crate::drawable::Drawable;
use crate::{Format, FormatError, Warning};

/// The curves of a groom: its strands of two points and more, some with a phantom point at both ends.
#[derive(Debug)]
pub(super) struct Curves<'a> {
    pub groom: &'a Groom,
    /// Points of each curve.
    pub counts: Vec<i32>,
    /// The strand of each curve; `None` when every strand is one.
    strands: Option<Vec<u32>>,
    /// Whether every curve has a point before its first, at 2 P0 - P1, and one behind its last.
    pub phantoms: bool,
    pub points: usize,
}

impl<'a> Curves<'a> {
    pub fn new(
        groom: &'a Groom,
        phantoms: bool,
        format: Format,
        file: &str,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, FormatError> {
        let drawable = Drawable::new(groom, format, file, warnings)?;
        let more = if phantoms { 2 } else { 0 };
        let points = drawable.points + more * drawable.strands;
        if points > i32::MAX as usize {
            let (file, found, limit) = (file.to_owned(), points as u64, i32::MAX as u64);
            return Err(FormatError::TooLarge { file, format, what: "points", found, limit });
        }
        let counts = drawable.strands().map(|(_, range)| (range.len() + more) as i32).collect();
        let some = drawable.strands < groom.strand_count();
        let strands = some.then(|| drawable.strands().map(|(strand, _)| strand as u32).collect());
        Ok(Curves { groom, counts, strands, phantoms, points })
    }

    pub fn len(&self) -> usize {
        self.counts.len()
    }

    /// Whether every strand is a curve, so that values a strand stay as they are.
    pub fn has_all_strands(&self) -> bool {
        self.strands.is_none()
    }

    /// Whether every point of the groom is one of the curves' and no other is.
    pub fn has_same_points(&self) -> bool {
        self.has_all_strands() && !self.phantoms
    }

    /// The strand of curve `curve`.
    pub fn strand(&self, curve: usize) -> usize {
        self.strands.as_ref().map_or(curve, |strands| strands[curve] as usize)
    }

    /// The strands that are curves and have some of the groom's points `points`: index, all its points, those
    /// among `points`.
    pub fn strands_among(
        &self,
        points: Range<usize>,
    ) -> impl Iterator<Item = (usize, Range<usize>, Range<usize>)> + '_ {
        let offsets = self.groom.offsets();
        let first = offsets.partition_point(|&offset| offset as usize <= points.start).saturating_sub(1);
        (first..self.groom.strand_count())
            .map(move |strand| {
                let all = self.groom.strand_range(strand);
                let some = all.start.max(points.start)..all.end.min(points.end);
                (strand, all, some)
            })
            .take_while(|(_, _, some)| !some.is_empty())
            .filter(|(_, all, _)| all.len() >= 2)
    }
}
