//! `turntable comp`.

use command_line::Outcome;

/// To be filled.
#[derive(Debug, clap::Args)]
pub struct CompArgs {}

/// To be filled.
pub fn run(_args: &CompArgs) -> anyhow::Result<Outcome> {
    anyhow::bail!("`turntable comp` is not there yet")
}
