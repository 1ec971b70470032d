//! When light is let in: from when to when, and how much at each time between.

use crate::RenderError;
use crate::shutter_shape::ShutterShape;

/// The time a frame is exposed, in frames relative to the frame, and how the shutter opens and closes.
///
/// A still scene gives the same picture, bit for bit, whatever the shutter: the shape says when light is let
/// in, not how much of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shutter {
    open: f64,
    close: f64,
    shape: ShutterShape,
}

/// Where the shutter sits about its frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShutterOffset {
    /// It opens at the frame.
    Start,
    /// The frame is the middle of it.
    #[default]
    Centre,
    /// It closes at the frame.
    End,
}

impl Default for Shutter {
    /// Half a frame about the frame (a film camera's 180 degrees), open all the while.
    fn default() -> Self {
        Shutter { open: -0.25, close: 0.25, shape: ShutterShape::Box }
    }
}

impl Shutter {
    /// A shutter that is open from `open` to `close`, in frames relative to the frame. One that closes as it
    /// opens sees the instant.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for a time that is not within 1000 frames, a shutter that closes before it
    /// opens, or a shape out of its range.
    pub fn new(open: f64, close: f64, shape: ShutterShape) -> Result<Self, RenderError> {
        for (what, time) in [("shutter opening", open), ("shutter closing", close)] {
            if !(-FARTHEST..=FARTHEST).contains(&time) {
                return Err(RenderError::argument(what, time, "-1000..1000 frames from the frame"));
            }
        }
        if close < open {
            return Err(RenderError::argument("shutter closing", close, "the opening or later"));
        }
        shape.check()?;
        Ok(Shutter { open, close, shape })
    }

    /// A shutter that is open for `length` frames (1 is 360 degrees) and sits about the frame as `offset` says.
    ///
    /// # Errors
    /// As [`Shutter::new`].
    pub fn placed(length: f64, offset: ShutterOffset, shape: ShutterShape) -> Result<Self, RenderError> {
        if !(0.0..=FARTHEST).contains(&length) {
            return Err(RenderError::argument("shutter length", length, "0..1000 frames"));
        }
        match offset {
            ShutterOffset::Start => Shutter::new(0.0, length, shape),
            ShutterOffset::Centre => Shutter::new(-0.5 * length, 0.5 * length, shape),
            ShutterOffset::End => Shutter::new(-length, 0.0, shape),
        }
    }

    /// When it opens, in frames relative to the frame.
    #[must_use]
    pub fn open(&self) -> f64 {
        self.open
    }

    /// When it closes, in frames relative to the frame.
    #[must_use]
    pub fn close(&self) -> f64 {
        self.close
    }

    /// How much light it lets in from opening to closing.
    #[must_use]
    pub fn shape(&self) -> &ShutterShape {
        &self.shape
    }

    /// Whether it closes as it opens: nothing can move then.
    #[must_use]
    pub fn is_instant(&self) -> bool {
        self.open == self.close
    }

    /// Refuses a shutter that leaves no time for what `moves`.
    pub(crate) fn check_lasts(&self, moves: bool) -> Result<(), RenderError> {
        if moves && self.is_instant() {
            let found = format!("{}:{}", self.open, self.close);
            return Err(RenderError::argument(
                "shutter",
                found,
                "a closing after the opening, for what moves",
            ));
        }
        Ok(())
    }

    /// When it opens and closes, in seconds relative to the frame, at `frame_rate` frames a second.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for a frame rate that is not above 0.
    pub fn seconds(&self, frame_rate: f64) -> Result<[f64; 2], RenderError> {
        if !(frame_rate > 0.0 && frame_rate.is_finite()) {
            return Err(RenderError::argument("frame rate", frame_rate, "above 0 frames a second"));
        }
        Ok([self.open / frame_rate, self.close / frame_rate])
    }

    /// The times, in frames, at which something that moves is looked at for the picture of `frame`: `keys` of
    /// them, evenly from opening to closing. One key, or a shutter that only sees an instant, is the middle.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for a frame that is not finite, and for 0 or more than 1025 keys.
    pub fn key_times(&self, frame: f64, keys: usize) -> Result<Vec<f64>, RenderError> {
        if !frame.is_finite() {
            return Err(RenderError::argument("frame", frame, "a finite number"));
        }
        check_keys(keys)?;
        if keys == 1 || self.is_instant() {
            return Ok(vec![frame + 0.5 * (self.open + self.close)]);
        }
        let step = (self.close - self.open) / (keys - 1) as f64;
        let between = |key: usize| self.open + step * key as f64;
        // The last is the closing itself, not where rounded steps lead.
        Ok((0..keys).map(|key| frame + if key + 1 == keys { self.close } else { between(key) }).collect())
    }
}

/// Most frames a shutter may lie from its frame.
const FARTHEST: f64 = 1000.0;
/// Most keys: what more would add lies far below what single precision can hold.
pub(crate) const MOST_KEYS: usize = 1025;

/// Refuses numbers of keys that cannot be meant.
pub(crate) fn check_keys(keys: usize) -> Result<(), RenderError> {
    if (1..=MOST_KEYS).contains(&keys) {
        return Ok(());
    }
    Err(RenderError::argument("motion keys", keys, "1..=1025"))
}

impl std::fmt::Display for Shutter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{} {}", self.open, self.close, self.shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_sits_where_it_is_put() {
        let ends = |offset| {
            let shutter = Shutter::placed(0.5, offset, ShutterShape::Box).unwrap();
            (shutter.open(), shutter.close())
        };
        assert_eq!(ends(ShutterOffset::Start), (0.0, 0.5));
        assert_eq!(ends(ShutterOffset::Centre), (-0.25, 0.25));
        assert_eq!(ends(ShutterOffset::End), (-0.5, 0.0));
        assert_eq!(
            Shutter::placed(0.5, ShutterOffset::default(), ShutterShape::Box).unwrap(),
            Shutter::default()
        );
        assert_eq!(Shutter::default().seconds(25.0).unwrap(), [-0.01, 0.01]);
    }

    #[test]
    fn keys_run_from_opening_to_closing() {
        let shutter = Shutter::new(-0.25, 0.5, ShutterShape::Box).unwrap();
        assert_eq!(shutter.key_times(10.0, 2).unwrap(), [9.75, 10.5]);
        assert_eq!(shutter.key_times(10.0, 4).unwrap(), [9.75, 10.0, 10.25, 10.5]);
        assert_eq!(shutter.key_times(10.0, 1).unwrap(), [10.125]);
        let instant = Shutter::new(0.125, 0.125, ShutterShape::Box).unwrap();
        assert!(instant.is_instant() && instant.key_times(3.0, 9).unwrap() == [3.125]);
    }

    #[test]
    fn impossible_shutters_are_refused() {
        for (open, close) in [(0.1, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-2000.0, 0.0)] {
            assert!(Shutter::new(open, close, ShutterShape::Box).is_err(), "{open} {close}");
        }
        assert!(Shutter::placed(-0.5, ShutterOffset::Start, ShutterShape::Box).is_err());
        let told = Shutter::new(0.5, 0.25, ShutterShape::Box).unwrap_err().to_string();
        assert_eq!(told, "shutter closing is 0.25, expected the opening or later");
        let shutter = Shutter::default();
        assert!(shutter.seconds(0.0).is_err() && shutter.key_times(f64::NAN, 2).is_err());
        assert!(shutter.key_times(0.0, 0).is_err() && shutter.key_times(0.0, 1026).is_err());
        assert_eq!(shutter.to_string(), "-0.25:0.25 box");
    }
}
