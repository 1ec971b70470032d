//! Times of samples, in frames.

use ogawa::{Archive, OgawaError, PropertyReader};

use crate::alembic::schema;

/// Frames a second where neither the archive nor its samples say.
const FRAME_RATE: f64 = 24.0;
/// Frames are told apart to a thousandth: seconds in binary do not hit them exactly.
const PARTS: f64 = 1000.0;
/// How near a thousandth of a frame a time must be to be meant.
const NEAR: f64 = 1e-7;

/// From seconds to frames.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    pub(super) frame_rate: f64,
}

/// Between which samples a time lies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moment {
    pub(super) before: u64,
    pub(super) after: u64,
    /// 0 at `before`, 1 at `after`.
    pub(super) blend: f64,
}

impl Clock {
    /// The archive's frame rate, or that of the first of its times that are a step.
    pub(super) fn new(archive: &Archive<'_>) -> Self {
        let good = |rate: &f64| rate.is_finite() && *rate > 0.0;
        let said = schema::FRAME_RATES.iter().find_map(|key| archive.metadata().get(key)?.parse().ok());
        if let Some(frame_rate) = said.filter(good) {
            return Clock { frame_rate };
        }
        // Number 0 is there always and says nothing.
        let step = match archive.times(1) {
            Some(times) if times.times.len() == 1 => times.seconds_per_cycle,
            _ => None,
        };
        let frame_rate = step.map(|step| near(1.0 / step)).filter(good).unwrap_or(FRAME_RATE);
        Clock { frame_rate }
    }

    fn frame(self, seconds: f64) -> f64 {
        near(seconds * self.frame_rate)
    }

    /// When the samples of a property were taken; empty for one that does not change.
    pub(super) fn frames(self, property: &PropertyReader<'_>) -> Result<Vec<f64>, OgawaError> {
        let samples = property.sample_count();
        if property.is_constant() || samples < 2 {
            return Ok(Vec::new());
        }
        let times = property.times()?;
        (0..samples)
            .map(|sample| {
                let time = times.time(sample).filter(|time| time.is_finite());
                time.map(|seconds| self.frame(seconds)).ok_or_else(|| no_time(property, sample))
            })
            .collect()
    }

    /// Where a frame lies among the samples of a property; without one, at the first. Before the first and after
    /// the last sample those stay.
    pub(super) fn moment(
        self,
        property: &PropertyReader<'_>,
        frame: Option<f64>,
    ) -> Result<Moment, OgawaError> {
        let samples = property.sample_count();
        let Some(frame) = frame.filter(|_| samples > 1 && !property.is_constant()) else {
            return Ok(Moment::default());
        };
        let times = property.times()?;
        let at = |sample: u64| {
            let time = times.time(sample).map(|seconds| self.frame(seconds));
            time.ok_or_else(|| no_time(property, sample))
        };
        // The last sample that is not after the frame.
        let (mut low, mut high) = (0, samples);
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            if at(middle)? <= frame { low = middle } else { high = middle }
        }
        let (before, after) = (at(low)?, at(high.min(samples - 1))?);
        let blend = (frame - before) / (after - before);
        if blend > 0.0 && blend < 1.0 {
            return Ok(Moment { before: low, after: high, blend });
        }
        Ok(Moment { before: low, after: low, blend: 0.0 })
    }
}

/// The thousandth of a frame that is meant, if one is.
fn near(frames: f64) -> f64 {
    let meant = (frames * PARTS).round() / PARTS;
    if (meant - frames).abs() <= NEAR * frames.abs().max(1.0) { meant } else { frames }
}

fn no_time(property: &PropertyReader<'_>, sample: u64) -> OgawaError {
    OgawaError::Property {
        name: property.name().to_owned(),
        found: format!("no time for sample {sample}"),
        expected: "one for each".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::near;

    #[test]
    fn frames_that_are_meant_are_hit() {
        for frame in [1.0, 24.0, 1001.25, -3.5, 0.001] {
            assert_eq!(near(frame / 24.0 * 24.0 + 1e-12), frame);
        }
        assert_eq!(near(1.0 / 3.0), 1.0 / 3.0);
        assert_eq!(near(1.0 / (1.0 / 30.0)), 30.0);
    }
}
