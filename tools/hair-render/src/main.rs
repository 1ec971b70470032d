//! `hair-render`: path-traces a groom to a multi-layer EXR with an honest error figure.

mod args;
mod asked;
mod color_match;
mod digest;
mod farm_args;
mod keeping;
mod motion_args;
mod picture;
mod presets;
mod report;
mod scene;
mod watch;

use std::process::ExitCode;

use clap::Parser;

use crate::args::Args;

fn main() -> ExitCode {
    let args = Args::parse();
    command_line::run(|| match &args.write_studio {
        _ if args.list_presets => presets::list(),
        Some(path) => picture::write_studio(path),
        None => picture::render(&args),
    })
}
