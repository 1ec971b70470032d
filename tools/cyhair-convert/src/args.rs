//! The command line.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::{ArgGroup, Parser, ValueEnum};
use glam::Vec3;
use groom::UpAxis;
use groom_formats::Format;

/// Converts hair and fur grooms between formats, or says what is in one.
///
/// Formats go by the ending: .hair and .txt are read; .hair, .txt, .gltf, .glb and .usda are written.
/// The output is written whole or not at all, over what is there (a device or named pipe is written to as
/// it stands). NAME.gltf comes with NAME.bin beside it. What a format cannot hold is told on stderr.
#[derive(Debug, Parser)]
#[command(
    name = "cyhair-convert",
    version,
    after_help = "Exit status: 0 done, 2 could not (bad input or usage), 130 stopped by Ctrl-C.\n\n\
        Examples:\n  \
        cyhair-convert head.hair head.usda --meters-per-unit 0.00254\n  \
        cyhair-convert head.hair - --to txt --stride 100 | head\n  \
        cyhair-convert head.hair --info --json",
    group = ArgGroup::new("edits").multiple(true)
)]
pub(crate) struct Args {
    /// Groom to read; `-` is standard input (with --from)
    pub(crate) input: PathBuf,

    /// File to write; `-` is standard output (with --to)
    #[arg(required_unless_present = "info", conflicts_with = "info")]
    pub(crate) output: Option<PathBuf>,

    /// Say what is in the input instead of converting it
    #[arg(long, conflicts_with_all = ["edits", "to"])]
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

    /// Keep every Nth strand (1 or more) [default: 1, all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), group = "edits",
        help_heading = "Strands")]
    pub(crate) stride: Option<u32>,

    /// Keep at most N strands, evenly spread (1 or more; after --stride) [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), group = "edits",
        help_heading = "Strands")]
    pub(crate) max_strands: Option<u32>,

    /// Give every strand N points, evenly spaced (2 or more) [default: as they are]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..), group = "edits",
        help_heading = "Strands")]
    pub(crate) resample: Option<u32>,

    /// Multiply points and widths (over 0) [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = factor, group = "edits", help_heading = "Strands")]
    pub(crate) scale: Option<f32>,

    /// Turn the groom so that this axis is up in the output [default: as the input; glTF: y]
    #[arg(long, value_name = "AXIS", group = "edits", help_heading = "Strands")]
    pub(crate) up: Option<Up>,

    /// One colour for all: linear r,g,b, each from 0 to 1
    #[arg(long, value_name = "R,G,B", value_parser = color, group = "edits", help_heading = "Look",
        conflicts_with_all = ["root_color", "tip_color"])]
    pub(crate) color: Option<Vec3>,

    /// Colour at the roots, running to --tip-color
    #[arg(long, value_name = "R,G,B", value_parser = color, group = "edits", help_heading = "Look",
        requires = "tip_color")]
    pub(crate) root_color: Option<Vec3>,

    /// Colour at the tips
    #[arg(long, value_name = "R,G,B", value_parser = color, group = "edits", help_heading = "Look",
        requires = "root_color")]
    pub(crate) tip_color: Option<Vec3>,

    /// One width (a diameter, in the output's numbers) for all: 0 or more
    #[arg(long, value_name = "WIDTH", value_parser = width, group = "edits", help_heading = "Look",
        conflicts_with_all = ["root_width", "tip_width"])]
    pub(crate) width: Option<f32>,

    /// Width at the roots, running to --tip-width
    #[arg(long, value_name = "WIDTH", value_parser = width, group = "edits", help_heading = "Look",
        requires = "tip_width")]
    pub(crate) root_width: Option<f32>,

    /// Width at the tips
    #[arg(long, value_name = "WIDTH", value_parser = width, group = "edits", help_heading = "Look",
        requires = "root_width")]
    pub(crate) tip_width: Option<f32>,
}

/// An axis on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Up {
    Y,
    Z,
}

impl From<Up> for UpAxis {
    fn from(up: Up) -> Self {
        match up {
            Up::Y => UpAxis::Y,
            Up::Z => UpAxis::Z,
        }
    }
}

impl Args {
    /// The input's format, by option or ending.
    pub(crate) fn input_format(&self) -> Result<Format> {
        let readable = |format: Format| format.can_read();
        choose(self.from, &self.input, "--from", "standard input", &endings(readable))
    }

    /// Where to write, and in which format; refuses what cannot go together.
    pub(crate) fn target(&self) -> Result<(&Path, Format)> {
        let Some(output) = self.output.as_deref() else { bail!("no output was given") };
        let format = choose(self.to, output, "--to", "standard output", &endings(Format::can_write))?;
        if let Some(other) = Format::from_path(output).filter(|&other| other != format) {
            bail!("--to {format} and the ending .{other} of {} contradict each other", output.display());
        }
        if is_stream(output) {
            if !format.streams() {
                bail!("--to {format} is two files and cannot go to standard output; use --to glb");
            }
            if self.json {
                bail!("--json and the output `-` both need standard output");
            }
        }
        if format == Format::Gltf {
            self.refuse_odd_pair(output)?;
        }
        if matches!(format, Format::Gltf | Format::Glb) && self.up == Some(Up::Z) {
            bail!("--up z cannot be used with .{format}: glTF is always y-up");
        }
        Ok((output, format))
    }

    /// `.gltf` names its second file itself, which must be possible and must not be the input.
    fn refuse_odd_pair(&self, output: &Path) -> Result<()> {
        if Format::from_path(output).is_none() {
            bail!("{}: --to gltf needs an output that ends with .gltf", output.display());
        }
        let bytes = output.with_extension("bin");
        let same = |input: &Path| Some(input.canonicalize().ok()? == bytes.canonicalize().ok()?);
        if same(&self.input) == Some(true) {
            bail!("{} would be written over the input; use --to glb or another name", bytes.display());
        }
        Ok(())
    }
}

/// Whether a path is the `-` that stands for a standard stream.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn choose(asked: Option<Format>, path: &Path, option: &str, stream: &str, expected: &str) -> Result<Format> {
    match asked.or_else(|| Format::from_path(path)) {
        Some(format) => Ok(format),
        None if is_stream(path) => bail!("{stream} needs {option} FORMAT; expected one of {expected}"),
        None => bail!(
            "{}: no groom format has this ending; expected one of {expected}, or {option} FORMAT",
            path.display()
        ),
    }
}

fn endings(which: fn(Format) -> bool) -> String {
    let names: Vec<_> = Format::ALL.into_iter().filter(|&f| which(f)).map(Format::name).collect();
    names.join(", ")
}

fn format(name: &str) -> Result<Format, String> {
    let known = || Format::ALL.map(Format::name).join(", ");
    Format::from_name(name).ok_or_else(|| format!("expected one of {}", known()))
}

fn unit(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v: &f64| v.is_finite() && *v > 0.0).ok_or("expected a number over 0".into())
}

fn factor(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|v: &f32| v.is_finite() && *v > 0.0).ok_or("expected a number over 0".into())
}

fn width(text: &str) -> Result<f32, String> {
    text.parse()
        .ok()
        .filter(|v: &f32| v.is_finite() && *v >= 0.0)
        .ok_or("expected a number, 0 or more".into())
}

fn color(text: &str) -> Result<Vec3, String> {
    let channels: Vec<f32> = text.split(',').map_while(|word| word.trim().parse().ok()).collect();
    match channels[..] {
        [r, g, b] if text.split(',').count() == 3 && channels.iter().all(|c| (0.0..=1.0).contains(c)) => {
            Ok(Vec3::new(r, g, b))
        }
        _ => Err("expected three numbers from 0 to 1, as 0.8,0.5,0.2".into()),
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

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(color("1,0.5,0"), Ok(Vec3::new(1.0, 0.5, 0.0)));
        for text in ["", "1,1", "1,1,1,1", "1,1,2", "1,1,x", "1,x,1,1", "nan,0,0"] {
            assert!(color(text).is_err(), "{text}");
        }
        assert!(unit("0").is_err() && unit("inf").is_err() && factor("-1").is_err() && width("nan").is_err());
        assert_eq!(width("0"), Ok(0.0));
    }
}
