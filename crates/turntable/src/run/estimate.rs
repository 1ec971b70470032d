//! How long it will still take.

use std::collections::HashMap;

/// Seconds a frame takes, by variant; variants may differ a hundredfold.
#[derive(Debug, Default)]
pub(super) struct Estimate {
    /// Frames rendered and the seconds they took.
    seen: HashMap<usize, (u32, f64)>,
}

impl Estimate {
    /// Takes note of a frame of a variant.
    pub fn add(&mut self, variant: usize, seconds: f64) {
        let (count, sum) = self.seen.entry(variant).or_default();
        *count += 1;
        *sum += seconds;
    }

    /// Seconds for what is left of each variant, as (variant, frames); those of which none was rendered yet are taken
    /// for as slow as the others on average. None before the first frame.
    pub fn left(&self, frames: impl Iterator<Item = (usize, usize)>) -> Option<f64> {
        let means: HashMap<usize, f64> =
            self.seen.iter().map(|(&variant, &(count, sum))| (variant, sum / f64::from(count))).collect();
        let mean = means.values().sum::<f64>() / means.len() as f64;
        let seconds = |(variant, count): (usize, usize)| means.get(&variant).unwrap_or(&mean) * count as f64;
        (!means.is_empty()).then(|| frames.map(seconds).sum())
    }

    /// The same while a frame of `variant` is rendered that will have taken `seconds`; it is among `frames`.
    pub fn left_while(
        &self,
        variant: usize,
        seconds: f64,
        frames: impl Iterator<Item = (usize, usize)>,
    ) -> f64 {
        let mut with = Estimate { seen: self.seen.clone() };
        with.add(variant, seconds);
        with.left(frames).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_count_by_their_own_frames() {
        let mut estimate = Estimate::default();
        assert_eq!(estimate.left([(0, 5)].into_iter()), None);
        estimate.add(0, 1.0);
        estimate.add(0, 3.0);
        assert_eq!(estimate.left([(0, 5)].into_iter()), Some(10.0));
        assert_eq!(estimate.left([(0, 5), (1, 1)].into_iter()), Some(12.0));
        estimate.add(1, 100.0);
        assert_eq!(estimate.left([(0, 5), (1, 1)].into_iter()), Some(110.0));
        assert_eq!(estimate.left([].into_iter()), Some(0.0));
        assert_eq!(Estimate::default().left_while(3, 2.0, [(3, 4), (4, 1)].into_iter()), 10.0);
    }
}
