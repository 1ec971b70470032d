//! Runs scripted turntables from YAML pipelines.

mod args;
mod check;
mod comp;
mod explain;
mod farm;
mod json;
mod progress;
mod run;
mod schema;

use std::process::ExitCode;

use clap::Parser;

use crate::args::{Args, Command};

fn main() -> ExitCode {
    let Args { command, run } = Args::parse();
    command_line::run(|| match &command {
        Some(Command::Check(args)) => check::run(args),
        Some(Command::Schema(args)) => schema::run(args),
        Some(Command::Comp(args)) => comp::run(args),
        Some(Command::Farm(args)) => farm::run(args),
        None => run::run(&run),
    })
}
