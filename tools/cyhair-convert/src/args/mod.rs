//! The command line.

mod look;
mod strands;
mod target;
mod values;

use std::path::PathBuf;

use clap::Parser;
use groom_formats::Format;

use look::Look;
pub(crate) use strands::Strands;
pub(crate) use target::is_stream;
pub(crate) use values::Up;
use values::{format, unit};

const EXIT_AND_EXAMPLES: &str = "Exit status: 0 done, 2 could not (bad input or usage), 130 stopped by Ctrl-C.\n\n\
        Examples:\n  \
        cyhair-convert head.hair head.usda --meters-per-unit 0.00254\n  \
        cyhair-convert head.hair - --to txt --stride 100 | head\n  \
        cyhair-convert head.hair --info --json";

/// Converts hair and fur grooms between formats, or says what is in one.
///
/// Formats go by the ending: .hair and .txt are read; .hair, .txt, .gltf, .glb and .usda are written.
/// The output is written whole or not at all, over what is there (a device or named pipe is written to as
/// it stands). NAME.gltf comes with NAME.bin beside it. What a format cannot hold is told on stderr.
#[derive(Debug, Parser)]
#[command(
    name = "cyhair-convert",
    version,
    after_help = format!("{}\n\n{EXIT_AND_EXAMPLES}", crate::edit::ORDER)
)]
pub(crate) struct Args {
    /// Groom to read; `-` is standard input (with --from)
    pub(crate) input: PathBuf,

    /// File to write; `-` is standard output (with --to)
    #[arg(required_unless_present = "info", conflicts_with = "info")]
    pub(crate) output: Option<PathBuf>,

    /// Say what is in the input instead of converting it
    #[arg(long, conflicts_with_all = ["strands", "look", "to"])]
    pub(crate) info: bool,

    /// Report on standard output as JSON
    #[arg(long)]
    pub(crate) json: bool,

    /// Format of the input [default: by its ending]
    #[arg(long, value_name = "FORMAT", value_parser = format, help_heading = "Formats")]
    from: Option<Format>,

    /// Format of the output [default: by its ending]
    #[arg(long, value_name = "FORMAT", value_parser = format, help_heading = "Formats")]
    to: Option<Format>,

    /// Up axis of the input; HAIR and text do not say [default: z]
    #[arg(long, value_name = "AXIS", help_heading = "Reading")]
    pub(crate) input_up: Option<Up>,

    /// Metres in one unit of the input (over 0; Yuksel's models: 0.00254) [default: 1]
    #[arg(long, value_name = "METRES", value_parser = unit, help_heading = "Reading")]
    pub(crate) meters_per_unit: Option<f64>,

    /// Mend what is odd or broken in the input, as far as that can be done, and say what was done
    #[arg(long, help_heading = "Reading")]
    pub(crate) repair: bool,

    #[command(flatten)]
    pub(crate) strands: Strands,

    #[command(flatten)]
    pub(crate) look: Look,
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
