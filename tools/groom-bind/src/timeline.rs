//! Which frames there are and when they are.

use anyhow::{Result, bail};

use crate::args::FrameRange;

/// Frames a second when neither the mesh nor the options say.
pub(crate) const FRAME_RATE: f64 = 24.0;

/// A time that misses a frame by this part of one is at it.
const ROUNDING: f64 = 1e-4;

/// The frames that are carried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Timeline {
    pub(crate) range: FrameRange,
    pub(crate) rate: f64,
}

impl Timeline {
    /// The frames that were asked for, or the whole ones of `seconds`; a mesh that stands still has frame 0.
    pub(crate) fn new(asked: Option<FrameRange>, seconds: Option<(f64, f64)>, rate: f64) -> Result<Timeline> {
        let range = match (asked, seconds) {
            (Some(asked), _) => asked,
            (None, None) => FrameRange { first: 0, last: 0, step: 1.0 },
            (None, Some((start, end))) => {
                let first = (start * rate - ROUNDING).ceil();
                let last = (end * rate + ROUNDING).floor();
                let count = last - first;
                if count.is_nan() || count >= 1e6 {
                    bail!("the mesh moves from frame {first} to {last}; choose some with --frames A-B");
                }
                // An animation shorter than a frame has one that is close.
                FrameRange { first: first as i64, last: last.max(first) as i64, step: 1.0 }
            }
        };
        Ok(Timeline { range, rate })
    }

    pub(crate) fn frames(&self) -> impl ExactSizeIterator<Item = f64> + use<> {
        self.range.frames()
    }

    /// The time of a frame in seconds.
    pub(crate) fn seconds(&self, frame: f64) -> f64 {
        frame / self.rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_frames_of_the_animation() {
        let range = |seconds, rate| {
            let range = Timeline::new(None, Some(seconds), rate).unwrap().range;
            (range.first, range.last)
        };
        assert_eq!(range((0.0, 1.0), 24.0), (0, 24));
        assert_eq!(range((1.0 / 30.0, 41.0_f32.into()), 30.0), (1, 1230));
        assert_eq!(range((0.0, 1.366_666_7), 30.0), (0, 41));
        assert_eq!(range((0.01, 0.02), 24.0), (1, 1));
        assert_eq!(Timeline::new(None, None, 24.0).unwrap().frames().collect::<Vec<_>>(), [0.0]);
        assert!(Timeline::new(None, Some((0.0, 1e9)), 24.0).is_err());
    }
}
