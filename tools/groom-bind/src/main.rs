//! Binds the strands of a groom to a mesh that moves, and writes them moving with it.

mod accuracy;
mod align;
mod args;
mod attributes;
mod bind;
mod carried;
mod character;
mod done;
mod events;
mod far;
mod list;
mod load;
mod numbered;
mod overwrite;
mod plausible;
mod report;
mod root_error;
mod skinned;
mod stability;
mod store;
mod target;
mod timeline;
mod usd;

use std::process::ExitCode;

use clap::Parser;
use command_line::Outcome;

fn main() -> ExitCode {
    let args = args::Args::parse();
    command_line::run(|| {
        if args.stability {
            return stability::run(args.json);
        }
        if args.mesh.list_animations {
            list::run(&args)?;
            return Ok(Outcome::Good);
        }
        bind::run(&args)
    })
}
