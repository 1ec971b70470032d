//! `turntable check`: what a pipeline says wrong, what it would make and leave out.

use std::path::PathBuf;

use command_line::Outcome;
use turntable::Plan;

use crate::args::Choice;
use crate::explain;

/// Checking a pipeline.
#[derive(Debug, clap::Args)]
pub struct CheckArgs {
    /// The pipeline; paths in it are relative to its folder
    pipeline: PathBuf,

    #[command(flatten)]
    choice: Choice,

    /// Write the result as JSON to standard output
    #[arg(long)]
    json: bool,
}

/// Checks a pipeline; its faults are the error.
pub fn run(args: &CheckArgs) -> anyhow::Result<Outcome> {
    let plan = Plan::new(&args.pipeline, args.choice.options())?;
    explain::print(&plan, args.json)?;
    Ok(Outcome::Good)
}
