//! What can be said about being stopped, going on, and telling how far it is.

use std::str::FromStr;
use std::time::Duration;

use command_line::ProgressStyle;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Long renders and farms")]
pub struct FarmArgs {
    /// How often the samples so far are kept in .NAME.part.exr beside the output: after so many seconds (300s),
    /// after so many samples a pixel (64spp), both after the pass of 16 samples that it falls into; or never
    #[arg(long, value_name = "WHEN", default_value = "300s")]
    pub checkpoint_every: Every,
    /// Stop after so many seconds, keep the samples so far and end with exit code 75
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time_limit: Option<Duration>,
    /// Begin anew, also where .NAME.part.exr holds samples of the same picture
    #[arg(long)]
    pub no_resume: bool,
    /// Do nothing where the output is there, whole, and made from the same input by the same program
    #[arg(long)]
    pub skip_existing: bool,
    /// Write the picture so far to NAME.snapshot.exr every so many seconds, after the pass that it falls into; SIGUSR1
    /// asks for one too
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub snapshot: Option<Duration>,
    /// Show the picture so far in a running tev (https://github.com/Tom94/tev) as it comes
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, default_missing_value = "127.0.0.1:14158")]
    pub display_server: Option<String>,
    /// Draw the snapshots and the finished picture in the terminal
    #[arg(long)]
    pub preview: bool,
    /// How progress is told: a bar on stderr, or lines on stdout as farms read them
    #[arg(long, value_enum, value_name = "STYLE", default_value_t = ProgressStyle::Bar)]
    pub progress: ProgressStyle,
}

/// How often a checkpoint is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Every {
    /// After so long.
    Time(Duration),
    /// After so many samples a pixel.
    Spp(u32),
    /// Only when it is stopped.
    Never,
}

impl FromStr for Every {
    type Err = String;

    fn from_str(words: &str) -> Result<Self, String> {
        let expected = || format!("`{words}`: expected seconds (300s), samples a pixel (64spp) or never");
        if words == "never" {
            return Ok(Every::Never);
        }
        if let Some(spp) = words.strip_suffix("spp") {
            return spp.parse().ok().filter(|&spp| spp > 0).map(Every::Spp).ok_or_else(expected);
        }
        words.strip_suffix('s').and_then(|time| seconds(time).ok()).map(Every::Time).ok_or_else(expected)
    }
}

fn seconds(words: &str) -> Result<Duration, String> {
    let seconds: f64 = words.parse().map_err(|_| format!("`{words}` is no number of seconds"))?;
    match Duration::try_from_secs_f64(seconds) {
        Ok(duration) if !duration.is_zero() => Ok(duration),
        _ => Err(format!("{words} seconds, expected a time above 0")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_samples_are_read_or_refused() {
        assert_eq!("300s".parse(), Ok(Every::Time(Duration::from_secs(300))));
        assert_eq!("0.5s".parse(), Ok(Every::Time(Duration::from_millis(500))));
        assert_eq!("64spp".parse(), Ok(Every::Spp(64)));
        assert_eq!("never".parse(), Ok(Every::Never));
        for odd in ["", "300", "0s", "-1s", "0spp", "1.5spp", "s", "nans", "1e400s"] {
            assert!(odd.parse::<Every>().unwrap_err().contains(odd), "{odd}");
        }
    }
}
