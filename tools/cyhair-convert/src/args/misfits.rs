//! Options that say nothing for the formats at hand are refused, not passed over in silence.

use anyhow::{Result, bail};
use groom_formats::Format;

use super::Args;

impl Args {
    /// Refuses options about the input that its format has no use for.
    pub(crate) fn refuse_misread(&self) -> Result<()> {
        let (format, reading) = (self.input_format()?, &self.reading);
        let curves = is_usd(format) || format == Format::Alembic;
        let options = [
            ("--points-per-strand", reading.points_per_strand.is_some(), format == Format::Ply, "ply"),
            ("--curve-error", reading.curve_error.is_some(), curves, "USD and Alembic"),
            ("--time", reading.time.is_some(), curves, "USD and Alembic"),
        ];
        refuse(&options, &self.input().display().to_string(), format)
    }

    /// Refuses options about the output that its format has no use for.
    pub(crate) fn refuse_miswritten(&self, output: &str, format: Format) -> Result<()> {
        let writing = &self.writing;
        let moves = is_usd(format) || format == Format::Alembic;
        let gltf = matches!(format, Format::Gltf | Format::Glb);
        let material = is_usd(format) || format == Format::Pbrt;
        let options = [
            ("--for", writing.dialect.is_some(), moves, "USD and Alembic"),
            ("--as-mesh", writing.as_mesh.is_some(), gltf, "glTF"),
            ("--all-attributes", writing.all_attributes, gltf, "glTF"),
            ("--fps", writing.fps.is_some(), moves, "outputs that move, USD and Alembic"),
            (
                "--frames",
                writing.frames.is_some(),
                moves,
                "outputs that move, USD and Alembic (--time picks one frame)",
            ),
            ("--material", self.material.material.is_some(), material, "USD and pbrt"),
        ];
        refuse(&options, output, format)
    }
}

/// Each with its name, whether it was given, whether it fits, and what it is for.
fn refuse(options: &[(&str, bool, bool, &str)], file: &str, format: Format) -> Result<()> {
    match options.iter().find(|(_, given, fits, _)| *given && !fits) {
        Some((option, _, _, purpose)) => bail!("{option} is for {purpose}, and {file} is {format}"),
        None => Ok(()),
    }
}

fn is_usd(format: Format) -> bool {
    matches!(format, Format::Usda | Format::Usdc | Format::Usdz)
}
