//! The command line.

mod look;
mod material;
mod measuring;
mod misfits;
mod reading;
mod strands;
mod target;
mod values;
mod writing;

use std::path::PathBuf;

use clap::Parser;
use groom_formats::Format;

use look::Look;
pub(crate) use material::{MaterialOptions, Source};
use measuring::Measuring;
use reading::Reading;
pub(crate) use strands::Strands;
pub(crate) use target::is_stream;
pub(crate) use values::Up;
use values::format;
use writing::Writing;

const EXIT_AND_EXAMPLES: &str = "\
Exit status: 0 done, 1 --check found errors, 2 could not (bad input or usage), 130 stopped by Ctrl-C.

Examples:
  cyhair-convert head.hair head.usda --meters-per-unit 0.00254
  cyhair-convert head.hair head.usdc --for unreal --material melanin:0.6,0.1 --check
  cyhair-convert head.hair head.usda --material preset:human-red
  cyhair-convert walk.####.hair walk.abc --fps 30
  cyhair-convert head.hair - --to txt --stride 100 | head
  cyhair-convert head.hair --info --json";

/// Converts hair and fur grooms between formats, or says what is in one.
///
/// Formats go by the ending; --formats lists them. A moving input (USD, Alembic, a sequence of files) stays
/// moving where the output can hold it (.usda .usdc .usdz .abc). The output is written whole or not at all,
/// over what is there (a device or named pipe is written to as it stands). NAME.gltf comes with NAME.bin beside
/// it. What a format cannot hold is told on stderr.
#[derive(Debug, Parser)]
#[command(
    name = "cyhair-convert",
    version,
    after_help = format!("{}\n\n{EXIT_AND_EXAMPLES}", crate::edit::ORDER)
)]
pub(crate) struct Args {
    /// Groom to read; `-` is standard input (with --from), `name.####.hair` a sequence of frames
    #[arg(required_unless_present = "formats")]
    input: Option<PathBuf>,

    /// File to write; `-` is standard output (with --to)
    #[arg(required_unless_present_any = ["info", "formats"], conflicts_with = "info")]
    pub(crate) output: Option<PathBuf>,

    /// Say what is in the input instead of converting it
    #[arg(long, conflicts_with_all = ["strands", "look", "measuring", "to", "dialect", "as_mesh",
        "all_attributes", "fps", "frames", "check", "material"])]
    pub(crate) info: bool,

    /// List the formats: what is read, what is written, what each holds
    #[arg(long)]
    pub(crate) formats: bool,

    /// Report on standard output as JSON
    #[arg(long)]
    pub(crate) json: bool,

    /// Format of the input [default: by its ending]
    #[arg(long, value_name = "FORMAT", value_parser = format, help_heading = "Formats")]
    from: Option<Format>,

    /// Format of the output [default: by its ending]
    #[arg(long, value_name = "FORMAT", value_parser = format, help_heading = "Formats")]
    to: Option<Format>,

    #[command(flatten)]
    pub(crate) reading: Reading,

    #[command(flatten)]
    pub(crate) strands: Strands,

    #[command(flatten)]
    pub(crate) look: Look,

    #[command(flatten)]
    pub(crate) writing: Writing,

    #[command(flatten)]
    pub(crate) measuring: Measuring,

    #[command(flatten)]
    pub(crate) material: MaterialOptions,
}

impl Args {
    /// Whether any option changes the groom between reading and writing.
    pub(crate) fn edits(&self) -> bool {
        self.strands != Strands::default() || self.look != Look::default()
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        Args::command().debug_assert();
    }
}
