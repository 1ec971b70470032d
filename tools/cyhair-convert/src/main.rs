//! Converts hair and fur grooms between formats.

mod args;
mod convert;
mod counted;
mod edit;
mod info;
mod load;
mod report;
mod texture;

use std::process::ExitCode;

use clap::Parser;
use command_line::Outcome;

fn main() -> ExitCode {
    let args = args::Args::parse();
    command_line::run(|| {
        if args.info {
            info::run(&args)?
        } else {
            convert::run(&args)?
        }
        Ok(Outcome::Good)
    })
}
