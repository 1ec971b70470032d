//! `fibre-check`: see `fibre-check --help`. Each subcommand is one file with its `Args` and `run`.

mod colors;
mod compare;
mod eval;
mod material;
mod output;
mod report;
mod stability;
mod sweep;
mod sweep_stage;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Verifies hair and fur scattering: holds a material against the laws it must obey.
///
/// Angles are in degrees, absorption is per fibre radius, colours are linear Rec. 709. Words go to stderr,
/// data to stdout. Exit codes: 0 all checks pass, 1 a check fails, 2 could not, 130 stopped by Ctrl-C (no file
/// is left).
#[derive(Debug, Parser)]
#[command(version)]
struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Report(report::Args),
    Eval(eval::Args),
    Compare(compare::Args),
    Stability(stability::Args),
    Sweep(sweep::Args),
    Colors(colors::Args),
}

fn main() -> ExitCode {
    let args = Args::parse();
    command_line::run(|| match &args.command {
        Command::Report(args) => report::run(args),
        Command::Eval(args) => eval::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Stability(args) => stability::run(args),
        Command::Sweep(args) => sweep::run(args),
        Command::Colors(args) => colors::run(args),
    })
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        super::Args::command().debug_assert();
    }
}
