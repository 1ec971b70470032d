//! Converts hair and fur grooms between formats.

mod args;
mod convert;
mod counted;
mod edit;
mod formats;
mod info;
mod load;
mod material;
mod motion;
mod reduction;
mod report;
mod sequence;
mod store;
mod streaming;
mod texture;
mod usd;

use std::process::ExitCode;

use clap::Parser;
use command_line::Outcome;

fn main() -> ExitCode {
    let args = args::Args::parse();
    command_line::run(|| {
        if args.formats {
            formats::run(args.json)?;
        } else if args.info {
            info::run(&args)?;
        } else {
            return convert::run(&args);
        }
        Ok(Outcome::Good)
    })
}
