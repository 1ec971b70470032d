//! Refuses frames that make no motion, for every format in the same words.

use glam::Vec3;

use crate::{FormatError, Frame, MotionOptions};

/// Refuses a frame rate and an origin that mean nothing.
pub(crate) fn options(motion: &MotionOptions, file: &str) -> Result<(), FormatError> {
    let MotionOptions { frame_rate, origin } = *motion;
    if !(frame_rate.is_finite() && frame_rate > 0.0) {
        let expected = "a finite number over 0";
        return Err(FormatError::invalid(file, "frame rate", frame_rate.to_string(), expected));
    }
    if !origin.is_finite() {
        return Err(FormatError::invalid(file, "origin", origin.to_string(), "finite numbers"));
    }
    Ok(())
}

/// What the frames so far were like.
pub(crate) struct FrameCheck<'a> {
    file: &'a str,
    points: usize,
    frames: usize,
    last: f64,
    velocities: bool,
    accelerations: bool,
}

impl<'a> FrameCheck<'a> {
    /// Before the first frame of a groom of so many points.
    pub(crate) fn new(points: usize, file: &'a str) -> Self {
        FrameCheck { file, points, frames: 0, last: 0.0, velocities: false, accelerations: false }
    }

    /// Takes the next frame.
    ///
    /// # Errors
    /// Times that do not rise, arrays that are not there in every frame or not one value a point, numbers that are
    /// not finite.
    pub(crate) fn take(&mut self, frame: &Frame) -> Result<(), FormatError> {
        self.time(frame.time)?;
        let is_first = self.frames == 0;
        for (what, found, before) in [
            ("velocities", frame.velocities.is_some(), &mut self.velocities),
            ("accelerations", frame.accelerations.is_some(), &mut self.accelerations),
        ] {
            if is_first {
                *before = found;
            } else if found != *before {
                let words = |some| if some { "some" } else { "none" };
                let place = format!("{what} of frame {}", self.frames);
                let expected = format!("{}, as before", words(*before));
                return Err(FormatError::invalid(self.file, place, words(found), expected));
            }
        }
        if self.accelerations && !self.velocities {
            return self.fault("accelerations", "some".into(), "none, or velocities with them".into());
        }
        self.values("position", &frame.positions)?;
        self.values("velocity", frame.velocities.as_deref().unwrap_or_default())?;
        self.values("acceleration", frame.accelerations.as_deref().unwrap_or_default())?;
        (self.frames, self.last) = (self.frames + 1, frame.time);
        Ok(())
    }

    /// After the last frame.
    ///
    /// # Errors
    /// That there was none.
    pub(crate) fn finish(&self) -> Result<(), FormatError> {
        match self.frames {
            0 => Err(FormatError::invalid(self.file, "frames", "none", "at least one")),
            _ => Ok(()),
        }
    }

    fn time(&self, time: f64) -> Result<(), FormatError> {
        if !time.is_finite() {
            return self.fault("time", time.to_string(), "a finite number".into());
        }
        if self.frames > 0 && time <= self.last {
            let expected = format!("more than {}, that of the frame before", self.last);
            return self.fault("time", time.to_string(), expected);
        }
        Ok(())
    }

    fn values(&self, what: &str, values: &[Vec3]) -> Result<(), FormatError> {
        let there = match what {
            "velocity" => self.velocities,
            "acceleration" => self.accelerations,
            _ => true,
        };
        if there && values.len() != self.points {
            let found = format!("{} values", values.len());
            return self.fault(what, found, format!("{}, one a point of the groom", self.points));
        }
        match values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            Some((point, value)) => {
                self.fault(what, format!("{value} at point {point}"), "finite numbers".into())
            }
            None => Ok(()),
        }
    }

    fn fault(&self, what: &str, found: String, expected: String) -> Result<(), FormatError> {
        Err(FormatError::invalid(self.file, format!("{what} of frame {}", self.frames), found, expected))
    }
}
