//! `fibre-check`: see `fibre-check --help`.

use std::process::ExitCode;

use clap::Parser;
use command_line::Outcome;

/// Verifies hair and fur scattering.
#[derive(Debug, Parser)]
#[command(version)]
struct Args {}

fn main() -> ExitCode {
    let Args {} = Args::parse();
    command_line::run(|| Ok(Outcome::Good))
}
