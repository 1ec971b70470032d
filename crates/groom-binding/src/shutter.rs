//! When the shutter is open.

use crate::BindingError;

/// The time a frame is exposed, in frames relative to the frame, and how often to look while it is.
///
/// The default is open from a quarter frame before to a quarter frame after (180 degrees, centred), seen at both ends.
/// Two samples blur along straight lines; what turns needs three or more, or velocities with accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shutter {
    /// When it opens, in frames: 0 is the frame itself.
    pub open: f64,
    /// When it closes, in frames; after `open`.
    pub close: f64,
    /// At how many times to look, 2 to 64, evenly spaced, the first at `open` and the last at `close`.
    pub samples: usize,
}

impl Default for Shutter {
    fn default() -> Self {
        Shutter { open: -0.25, close: 0.25, samples: 2 }
    }
}

impl Shutter {
    /// The times of the samples of `frame`, in seconds: frame 0 is time 0.
    ///
    /// # Errors
    /// [`BindingError::OutOfRange`] for a shutter that closes before it opens, a number of samples out of range, or a
    /// frame rate that is not over zero.
    pub fn times(&self, frame: f64, frame_rate: f64) -> Result<Vec<f64>, BindingError> {
        let refuse = |name, found: String, expected| Err(BindingError::OutOfRange { name, found, expected });
        if !(self.open.is_finite() && self.close.is_finite() && self.open < self.close) {
            let found = format!("{} to {}", self.open, self.close);
            return refuse("shutter", found, "two numbers of frames, open before close");
        }
        if !(2..=64).contains(&self.samples) {
            return refuse("shutter samples", self.samples.to_string(), "2 to 64");
        }
        if !(frame_rate.is_finite() && frame_rate > 0.0) {
            return refuse("frame rate", frame_rate.to_string(), "frames per second, over 0");
        }
        let last = (self.samples - 1) as f64;
        let at = |i: usize| (frame + self.open + (self.close - self.open) * i as f64 / last) / frame_rate;
        Ok((0..self.samples).map(at).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_run_from_open_to_close() {
        assert_eq!(Shutter::default().times(12.0, 24.0).unwrap(), [11.75 / 24.0, 12.25 / 24.0]);
        let five = Shutter { open: 0.0, close: 1.0, samples: 5 };
        assert_eq!(five.times(0.0, 1.0).unwrap(), [0.0, 0.25, 0.5, 0.75, 1.0]);
    }

    #[test]
    fn odd_shutters_are_refused() {
        let good = Shutter::default();
        for bad in [
            Shutter { open: 0.25, ..good },
            Shutter { close: f64::NAN, ..good },
            Shutter { samples: 1, ..good },
            Shutter { samples: 65, ..good },
        ] {
            assert!(bad.times(0.0, 24.0).is_err(), "{bad:?}");
        }
        assert!(good.times(0.0, 0.0).is_err() && good.times(0.0, f64::NAN).is_err());
    }
}
