//! `turntable farm`.

use command_line::Outcome;

/// To be filled.
#[derive(Debug, clap::Args)]
pub struct FarmArgs {}

/// To be filled.
pub fn run(_args: &FarmArgs) -> anyhow::Result<Outcome> {
    anyhow::bail!("`turntable farm` is not there yet")
}
