//! How distances are spread.

/// Bins of equal width.
const BINS: usize = 16;

/// A bin: distances up to here, from where the one before ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bin {
    pub(super) to: f64,
    pub(super) strands: usize,
}

/// Distances, least first, in bins from 0 to the greatest.
pub(super) fn histogram(sorted: &[f64]) -> Vec<Bin> {
    let Some(&greatest) = sorted.last() else { return Vec::new() };
    if greatest == 0.0 {
        return vec![Bin { to: 0.0, strands: sorted.len() }];
    }
    let mut before = 0;
    let ends = (1..=BINS).map(|i| if i == BINS { greatest } else { greatest * (i as f64 / BINS as f64) });
    ends.map(|to| {
        let until = sorted.partition_point(|&distance| distance <= to);
        let strands = until - before;
        before = until;
        Bin { to, strands }
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_distance_is_in_one_bin() {
        let distances: Vec<f64> = (0..=160).map(f64::from).collect();
        let bins = histogram(&distances);
        assert_eq!(bins.len(), BINS);
        assert_eq!(bins.iter().map(|bin| bin.strands).sum::<usize>(), distances.len());
        assert_eq!((bins[0], bins[BINS - 1].to), (Bin { to: 10.0, strands: 11 }, 160.0));
        assert_eq!(histogram(&[0.0; 3]), [Bin { to: 0.0, strands: 3 }]);
        assert!(histogram(&[]).is_empty());
    }
}
