//! Work on all strands, shared out.

use std::ops::Range;

use groom::Groom;
use rayon::prelude::*;

/// Points that one piece of work holds, about.
const BLOCK: usize = 16_384;

/// Calls `work` for every strand with its part of each of `out`, which are all as long as the groom has points. Strands
/// are shared out in blocks of about equal size, whatever the number of threads.
pub(crate) fn each_strand<T: Send, const N: usize>(
    groom: &Groom,
    mut out: [&mut [T]; N],
    work: impl Fn(usize, [&mut [T]; N]) + Sync,
) {
    let offsets = groom.offsets();
    let points = |strands: &Range<usize>| (offsets[strands.end] - offsets[strands.start]) as usize;
    let ranges = ranges(offsets);
    let blocks: Vec<_> =
        ranges.into_iter().map(|strands| (take(&mut out, points(&strands)), strands)).collect();
    blocks.into_par_iter().for_each(|(mut own, strands)| {
        for strand in strands {
            let count = points(&(strand..strand + 1));
            work(strand, take(&mut own, count));
        }
    });
}

/// Cuts the first `count` values off every slice.
#[inline]
fn take<'a, T, const N: usize>(slices: &mut [&'a mut [T]; N], count: usize) -> [&'a mut [T]; N] {
    std::array::from_fn(|k| {
        let (own, rest) = std::mem::take(&mut slices[k]).split_at_mut(count);
        slices[k] = rest;
        own
    })
}

/// Runs of strands with about [`BLOCK`] points each.
fn ranges(offsets: &[u32]) -> Vec<Range<usize>> {
    let (strands, mut first) = (offsets.len().saturating_sub(1), 0);
    let mut ranges = Vec::new();
    while first < strands {
        let full = offsets[first] as usize + BLOCK;
        let count = offsets[first..].partition_point(|&offset| (offset as usize) < full);
        let end = (first + count.max(1)).min(strands);
        ranges.push(first..end);
        first = end;
    }
    ranges
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn every_strand_is_visited_once_with_its_own_part() {
        let counts = [1, 40_000, 3, 1, 16_384, 2, 2].into_iter().chain(std::iter::repeat_n(7, 9000));
        let mut offsets = vec![0_u32];
        offsets.extend(counts.scan(0, |sum, count| {
            *sum += count;
            Some(*sum)
        }));
        let points = offsets[offsets.len() - 1] as usize;
        let groom = Groom::new(offsets, vec![Vec3::ZERO; points]).unwrap();
        let (mut strands, mut places) = (vec![usize::MAX; points], vec![usize::MAX; points]);
        each_strand(&groom, [&mut strands, &mut places], |strand, [strands, places]| {
            assert_eq!(strands.len(), groom.strand_range(strand).len());
            strands.fill(strand);
            places.iter_mut().enumerate().for_each(|(i, place)| *place = i);
        });
        for strand in 0..groom.strand_count() {
            let range = groom.strand_range(strand);
            assert!(strands[range.clone()].iter().all(|&s| s == strand));
            assert!(places[range].iter().enumerate().all(|(i, &p)| i == p));
        }
        let none = Groom::new(vec![0], vec![]).unwrap();
        each_strand(&none, [&mut [0_u8][..0]], |_, _| panic!("there is none"));
    }
}
