//! When samples were taken.

/// The time between cycles that stands for "no cycles" in the file.
const ACYCLIC: f64 = f64::MAX / 32.0;

/// Times of samples: a pattern that repeats, or a list.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeSampling {
    /// Seconds from one repetition of the pattern to the next; `None` when the times are a list.
    pub seconds_per_cycle: Option<f64>,
    /// The pattern of one cycle, or the list, in seconds.
    pub times: Vec<f64>,
}

impl Default for TimeSampling {
    /// A sample a second from 0, the first of every archive.
    fn default() -> Self {
        TimeSampling::uniform(1.0, 0.0)
    }
}

impl TimeSampling {
    /// A sample every `step` seconds from `start`.
    #[must_use]
    pub fn uniform(step: f64, start: f64) -> Self {
        TimeSampling { seconds_per_cycle: Some(step), times: vec![start] }
    }

    /// A sample at each of `times`.
    #[must_use]
    pub fn acyclic(times: Vec<f64>) -> Self {
        TimeSampling { seconds_per_cycle: None, times }
    }

    /// The time of a sample in seconds; `None` past the end of a list.
    #[must_use]
    pub fn time(&self, sample: u64) -> Option<f64> {
        let Some(step) = self.seconds_per_cycle else {
            return self.times.get(usize::try_from(sample).ok()?).copied();
        };
        let per_cycle = self.times.len() as u64;
        if per_cycle == 0 {
            return None;
        }
        let within = self.times.get((sample % per_cycle) as usize)?;
        Some(within + step * (sample / per_cycle) as f64)
    }

    /// Appends it as it stands in the file, with the number of samples that use it.
    pub(crate) fn write(&self, samples: u32, out: &mut Vec<u8>) {
        out.extend(samples.to_le_bytes());
        out.extend(self.seconds_per_cycle.unwrap_or(ACYCLIC).to_le_bytes());
        out.extend((self.times.len() as u32).to_le_bytes());
        self.times.iter().for_each(|time| out.extend(time.to_le_bytes()));
    }

    pub(crate) fn from_file(seconds_per_cycle: f64, times: Vec<f64>) -> Self {
        let cycles = seconds_per_cycle != ACYCLIC;
        TimeSampling { seconds_per_cycle: cycles.then_some(seconds_per_cycle), times }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_their_times() {
        let uniform = TimeSampling::uniform(0.5, 10.0);
        assert_eq!((uniform.time(0), uniform.time(3)), (Some(10.0), Some(11.5)));
        let shutter = TimeSampling { seconds_per_cycle: Some(1.0), times: vec![0.75, 1.25] };
        assert_eq!((shutter.time(1), shutter.time(2)), (Some(1.25), Some(1.75)));
        let list = TimeSampling::acyclic(vec![1.0, 2.0, 4.0]);
        assert_eq!((list.time(2), list.time(3)), (Some(4.0), None));
        assert_eq!(TimeSampling { seconds_per_cycle: Some(1.0), times: vec![] }.time(0), None);
    }
}
