//! `turntable schema`.

use command_line::Outcome;

/// To be filled.
#[derive(Debug, clap::Args)]
pub struct SchemaArgs {}

/// To be filled.
pub fn run(_args: &SchemaArgs) -> anyhow::Result<Outcome> {
    anyhow::bail!("`turntable schema` is not there yet")
}
