//! When a checkpoint is written, and where it lies.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

/// How often a checkpoint is written while a picture is rendered: after the pass that the time or the sample falls
/// into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointEvery {
    /// After so long.
    Time(Duration),
    /// After so many samples a pixel.
    Samples(u32),
    /// Only when it is stopped.
    Never,
}

impl Default for CheckpointEvery {
    /// Five minutes: what a power cut may cost.
    fn default() -> Self {
        CheckpointEvery::Time(Duration::from_secs(300))
    }
}

impl FromStr for CheckpointEvery {
    type Err = String;

    /// `300s`, `64spp` or `never`.
    fn from_str(words: &str) -> Result<Self, String> {
        let expected = || {
            format!(
                "`{words}`: expected seconds or samples a pixel above 0, as `300s` or `64spp`, or `never`"
            )
        };
        if words == "never" {
            return Ok(CheckpointEvery::Never);
        }
        if let Some(samples) = words.strip_suffix("spp") {
            let samples = samples.parse().ok().filter(|&samples| samples > 0);
            return samples.map(CheckpointEvery::Samples).ok_or_else(expected);
        }
        let seconds = words.strip_suffix('s').and_then(|seconds| seconds.parse().ok());
        let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        time.filter(|time| !time.is_zero()).map(CheckpointEvery::Time).ok_or_else(expected)
    }
}

/// Knows when the checkpoint of a picture was written last.
#[derive(Clone, Copy, Debug)]
pub struct CheckpointTimer {
    every: CheckpointEvery,
    at: Instant,
    spp: u32,
}

impl CheckpointTimer {
    /// For a picture that has `spp` samples a pixel now.
    #[must_use]
    pub fn new(every: CheckpointEvery, spp: u32) -> Self {
        CheckpointTimer { every, at: Instant::now(), spp }
    }

    /// Whether a checkpoint is to be written at `spp` samples a pixel; it is then taken for written.
    pub fn is_due(&mut self, spp: u32) -> bool {
        let is_due = match self.every {
            CheckpointEvery::Time(time) => self.at.elapsed() >= time,
            CheckpointEvery::Samples(samples) => spp.saturating_sub(self.spp) >= samples,
            CheckpointEvery::Never => false,
        };
        if is_due {
            (self.at, self.spp) = (Instant::now(), spp);
        }
        is_due
    }
}

/// Where the checkpoint of a picture lies: beside it, hidden, as `.NAME.part.exr`.
#[must_use]
pub fn checkpoint_path(picture: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(picture.file_stem().unwrap_or_default());
    name.push(".part.exr");
    picture.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_samples_are_read_or_refused() {
        assert_eq!("300s".parse(), Ok(CheckpointEvery::default()));
        assert_eq!("0.5s".parse(), Ok(CheckpointEvery::Time(Duration::from_millis(500))));
        assert_eq!("64spp".parse(), Ok(CheckpointEvery::Samples(64)));
        assert_eq!("never".parse(), Ok(CheckpointEvery::Never));
        for odd in
            ["", "300", "0s", "1e-30s", "-1s", "0spp", "1.5spp", "s", "spp", "nans", "infs", "1e400s", "5m"]
        {
            let refused = odd.parse::<CheckpointEvery>().unwrap_err();
            assert!(refused.contains(&format!("`{odd}`")), "{refused}");
        }
    }

    #[test]
    fn samples_count_from_the_last_checkpoint() {
        let mut timer = CheckpointTimer::new(CheckpointEvery::Samples(32), 16);
        let due: Vec<u32> = (2..=9).map(|pass| 16 * pass).filter(|&spp| timer.is_due(spp)).collect();
        assert_eq!(due, [48, 80, 112, 144]);
        assert!(!CheckpointTimer::new(CheckpointEvery::Never, 0).is_due(u32::MAX));
        assert!(!CheckpointTimer::new(CheckpointEvery::default(), 0).is_due(u32::MAX), "before its time");
        assert!(CheckpointTimer::new(CheckpointEvery::Time(Duration::ZERO), 0).is_due(0));
    }

    #[test]
    fn it_lies_hidden_beside_the_picture() {
        assert_eq!(checkpoint_path(Path::new("out/frame.0001.exr")), Path::new("out/.frame.0001.part.exr"));
        assert_eq!(checkpoint_path(Path::new("a.exr")), Path::new(".a.part.exr"));
    }
}
