//! What can be said about being stopped, going on, and telling how far it is.

use std::time::Duration;

use command_line::ProgressStyle;
use hair_render::CheckpointEvery;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Long renders and farms")]
pub struct FarmArgs {
    /// How often the samples so far are kept in .NAME.part.exr beside the output: after so many seconds (300s),
    /// after so many samples a pixel (64spp), both after the pass of 16 samples that it falls into; or never
    #[arg(long, value_name = "WHEN", default_value = "300s")]
    pub checkpoint_every: CheckpointEvery,
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
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, default_missing_value = "127.0.0.1:14158",
        require_equals = true)]
    pub display_server: Option<String>,
    /// Draw the snapshots and the finished picture in the terminal
    #[arg(long)]
    pub preview: bool,
    /// How progress is told: a bar on stderr, or lines on stdout as farms read them
    #[arg(long, value_enum, value_name = "STYLE", default_value_t = ProgressStyle::Bar)]
    pub progress: ProgressStyle,
}

fn seconds(words: &str) -> Result<Duration, String> {
    let seconds: f64 = words.parse().map_err(|_| format!("`{words}` is no number of seconds"))?;
    match Duration::try_from_secs_f64(seconds) {
        Ok(duration) if !duration.is_zero() => Ok(duration),
        _ => Err(format!("{words} seconds, expected a time above 0")),
    }
}
