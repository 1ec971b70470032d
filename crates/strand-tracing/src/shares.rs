//! A time between two keys of a tree, in single precision.

use glam::Vec4;

use crate::tracks::Between;

/// What a ray takes of the key before its time and of the one after.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shares {
    pub(crate) before: usize,
    shares: [Vec4; 2],
}

impl Shares {
    pub(crate) fn of(time: f64, intervals: usize) -> Self {
        let Between { before, share } = Between::of(time, intervals);
        Self { before, shares: [1.0 - share, share].map(|share| Vec4::splat(share as f32)) }
    }

    /// With `e = 2^-24` at most `3e` of the larger magnitude off the exact mix: `e` for the two shares, which
    /// are off by at most `e / 2` each, `e` for the products, `e` for the sum (and terms of `e^2`).
    #[inline(always)]
    pub(crate) fn mix(&self, before: Vec4, after: Vec4) -> Vec4 {
        before * self.shares[0] + after * self.shares[1]
    }
}
