//! What can be said on the command line.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Parser, Subcommand};
use command_line::ProgressStyle;
use turntable::{CheckpointEvery, FrameRange, Options, Phase};

use crate::{check, comp, farm, schema};

/// Make a turntable from a YAML pipeline: converted grooms, frames, contact sheet, films, a page, an error report.
///
/// Only what is missing or out of date is made. A run that was stopped or killed goes on where it was: run the same
/// command again, on as many machines as you like.
///
/// Exit codes: 0 done; 1 checked and found wanting (--check); 2 could not (bad pipeline, bad usage, or some of it
/// failed); 75 stopped by a signal or the time limit with its work kept: run it again.
///
/// SIGUSR1 writes the frame being rendered, as far as it is, to the folder `snapshots`.
#[derive(Debug, Parser)]
#[command(
    version,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    override_usage = "turntable [OPTIONS] <PIPELINE>\n       turntable <COMMAND>"
)]
pub struct Args {
    #[command(subcommand)]
    pub command: Option<Command>,

    #[command(flatten)]
    pub run: RunArgs,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Check a pipeline: what it says wrong, what it would make and leave out; makes nothing
    Check(Box<check::CheckArgs>),
    /// Print the pipeline's keys as a JSON schema, for editors
    Schema(Box<schema::SchemaArgs>),
    /// Weigh the passes of finished frames anew
    Comp(Box<comp::CompArgs>),
    /// Hand a pipeline to a render farm
    Farm(Box<farm::FarmArgs>),
}

/// Making a turntable.
#[derive(Debug, clap::Args)]
pub struct RunArgs {
    /// The pipeline; paths in it are relative to its folder
    #[arg(required = true)]
    pipeline: Option<PathBuf>,

    #[command(flatten)]
    pub choice: Choice,

    #[command(flatten)]
    pub keep: Keep,

    #[command(flatten)]
    pub tell: Tell,

    /// Say what would be made, kept and left out, and why; make nothing
    #[arg(long, visible_alias = "dry-run")]
    pub explain: bool,

    /// Exit with 1 when something is left to make; make nothing
    #[arg(long, conflicts_with = "explain")]
    pub check: bool,
}

/// What of a pipeline, and with which settings; other commands take it too.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "What")]
pub struct Choice {
    /// Folder to write to [default: `output` of the pipeline, relative to the current folder]
    #[arg(long, short, value_name = "FOLDER")]
    pub out: Option<PathBuf>,

    /// Frames to look after, counted from 1: `1-5`, `1-10:2`, `1,3,7-9` [default: all]
    #[arg(long, value_name = "RANGE")]
    pub frames: Option<FrameRange>,

    /// Variants to look after, by the settings of the pipeline's `matrix`: `hair=smooth,curly`. May be repeated
    #[arg(long, value_name = "AXIS=NAME[,NAME]")]
    pub only: Vec<String>,

    /// Lay a setting over the pipeline's: `render.spp=4`. May be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,

    /// Give a variable of the pipeline another value. May be repeated
    #[arg(short = 'D', value_name = "NAME=VALUE")]
    pub define: Vec<String>,

    /// Samples a pixel; short for `--set render.spp=N`
    #[arg(long, value_name = "N")]
    pub spp: Option<u32>,

    /// Seed of everything random in rendering; short for `--set render.seed=N`
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,

    /// Kinds of work to do: `prepare` (converted files), `frames`, `outputs` (what is made of frames, and the
    /// report) [default: all]
    #[arg(long, value_name = "KINDS", value_delimiter = ',')]
    pub steps: Vec<Phase>,
}

/// Being stopped, and going on.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Stopping and going on")]
pub struct Keep {
    /// Go on with frames that were stopped half way (this is the default)
    #[arg(long, overrides_with = "no_resume")]
    resume: bool,

    /// Begin frames that were stopped half way anew
    #[arg(long, overrides_with = "resume")]
    no_resume: bool,

    /// How often a frame's work is kept beside it while it is rendered: after so many seconds (`300s`), after so many
    /// samples a pixel (`64spp`), or `never`. Signals and the time limit always keep it
    #[arg(long, value_name = "WHEN", default_value = "300s")]
    checkpoint_every: CheckpointEvery,

    /// Stop after so many seconds, keeping the work (exit code 75)
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<Duration>,

    /// Stop at the first frame that cannot be made, instead of making all others and naming it at the end
    #[arg(long)]
    fail_fast: bool,

    /// Read every output again to see that its bytes are those that were written; otherwise its size and time are
    /// taken for that
    #[arg(long)]
    verify: bool,

    /// Rendering threads; changes no pixel [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// What is told meanwhile and in the end.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Telling")]
pub struct Tell {
    /// How progress is told: a bar on a terminal, or lines on stdout that farms and programs read
    #[arg(long, value_enum, default_value_t, value_name = "STYLE")]
    pub progress: ProgressStyle,

    /// Write the frame being rendered, as far as it is, to the folder `snapshots` every so many seconds
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub snapshot: Option<Duration>,

    /// Draw snapshots and finished frames in the terminal
    #[arg(long)]
    pub preview: bool,

    /// Show the frame being rendered in a running tev (https://github.com/Tom94/tev) as it comes
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, default_missing_value = "127.0.0.1:14158",
        require_equals = true)]
    pub display_server: Option<String>,

    /// Write the result as JSON to standard output
    #[arg(long)]
    pub json: bool,
}

impl RunArgs {
    /// The pipeline file.
    pub fn pipeline(&self) -> PathBuf {
        self.pipeline.clone().unwrap_or_default() // clap saw to it
    }

    /// As the library takes it; a time limit counts from here.
    pub fn options(&self) -> Options {
        Options {
            threads: self.keep.threads.map(usize::from),
            resume: !self.keep.no_resume,
            checkpoint_every: self.keep.checkpoint_every,
            snapshot_every: self.tell.snapshot,
            deadline: self.keep.time_limit.and_then(|limit| Instant::now().checked_add(limit)),
            fail_fast: self.keep.fail_fast,
            verify: self.keep.verify,
            ..self.choice.options()
        }
    }
}

impl Choice {
    /// As the library takes it.
    pub fn options(&self) -> Options {
        let mut settings = self.set.clone();
        settings.extend(self.spp.map(|spp| format!("render.spp={spp}")));
        settings.extend(self.seed.map(|seed| format!("render.seed={seed}")));
        Options {
            settings,
            variables: self.define.clone(),
            only: self.only.clone(),
            output: self.out.clone(),
            frames: self.frames.clone(),
            phases: self.steps.iter().copied().collect(),
            command: command_line::words(),
            ..Options::default()
        }
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let bare = text.strip_suffix('s').unwrap_or(text);
    let seconds = bare.parse::<f64>().map_err(|error| error.to_string())?;
    match Duration::try_from_secs_f64(seconds) {
        Ok(time) if seconds > 0.0 => Ok(time),
        _ => Err("expected seconds above 0".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_definition_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn a_pipeline_or_a_command() {
        let parse = |line: &str| Args::try_parse_from(line.split(' '));
        let run =
            parse("turntable --spp 4 --seed 9 --set a=b -D x=y turn.yaml --steps frames,outputs").unwrap();
        assert!(run.command.is_none());
        let options = run.run.options();
        assert_eq!(options.settings, ["a=b", "render.spp=4", "render.seed=9"]);
        assert_eq!(options.variables, ["x=y"]);
        assert_eq!(options.phases.len(), 2);
        assert!(options.resume && !parse("turntable --no-resume t.yaml").unwrap().run.options().resume);
        assert!(matches!(parse("turntable check turn.yaml").unwrap().command, Some(Command::Check(_))));
        for bad in [
            "turntable",
            "turntable t.yaml --time-limit 0",
            "turntable t.yaml --checkpoint-every 5",
            "turntable t.yaml --steps all",
            "turntable t.yaml --frames 3-1",
        ] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }
}
