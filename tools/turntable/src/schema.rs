//! `turntable schema`: the keys of a pipeline for editors.

use std::io::Write;

use command_line::Outcome;

/// Printing the JSON Schema of pipelines: `turntable schema > turntable.schema.json`, and
/// `# yaml-language-server: $schema=turntable.schema.json` as the first line of a pipeline beside it.
#[derive(Debug, clap::Args)]
pub struct SchemaArgs {}

/// Prints the schema (draft 2020-12).
pub fn run(_: &SchemaArgs) -> anyhow::Result<Outcome> {
    std::io::stdout().lock().write_all(turntable::schema::json_schema_text().as_bytes())?;
    Ok(Outcome::Good)
}
