//! Strands a renderer or a solver cannot use.

use std::fmt;

use crate::Groom;
use crate::gather::{Place, gather};

/// Something about a groom that was mended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Repair {
    /// Points that are not finite were dropped; their neighbours are joined.
    DroppedPoints {
        /// How many.
        count: usize,
    },
    /// Segments without length were merged into the one before.
    MergedSegments {
        /// How many.
        count: usize,
    },
    /// Strands with fewer than two points (left) were dropped.
    DroppedStrands {
        /// How many.
        count: usize,
    },
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Repair::DroppedPoints { count } => write!(f, "dropped {count} points that were not finite"),
            Repair::MergedSegments { count } => write!(f, "merged {count} segments without length"),
            Repair::DroppedStrands { count } => {
                write!(f, "dropped {count} strands with fewer than two points")
            }
        }
    }
}

impl Groom {
    /// Drops points that are not finite or repeat the one before, then strands with fewer than two
    /// points, and says what was done; a clean groom is left alone. When strands go, the others keep
    /// their identity in the `id` attribute.
    pub fn repair(&mut self) -> Vec<Repair> {
        let (mut points, mut segments, mut strands) = (0, 0, Vec::new());
        let (mut offsets, mut places) = (vec![0], Vec::new());
        for strand in 0..self.strand_count() {
            let start = places.len();
            let mut last = None;
            for vertex in self.strand_range(strand) {
                let point = self.positions()[vertex];
                if !point.is_finite() {
                    points += 1;
                } else if last == Some(point) {
                    segments += 1;
                } else {
                    last = Some(point);
                    places.push(Place::at(vertex));
                }
            }
            if places.len() - start < 2 {
                places.truncate(start);
            } else {
                strands.push(strand as u32);
                offsets.push(places.len() as u32);
            }
        }
        let dropped = self.strand_count() - strands.len();
        let found = [
            (points, Repair::DroppedPoints { count: points }),
            (segments, Repair::MergedSegments { count: segments }),
            (dropped, Repair::DroppedStrands { count: dropped }),
        ];
        let repairs: Vec<Repair> =
            found.into_iter().filter(|(count, _)| *count > 0).map(|(_, r)| r).collect();
        if !repairs.is_empty() {
            *self = gather(self, &strands, offsets, &places, dropped > 0);
        }
        repairs
    }
}
