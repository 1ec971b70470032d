//! What the output should be like.

use clap::{Args, ValueEnum};
use groom_formats::{Dialect, Mesh};

/// Sides of a tube when nobody says.
const SIDES: u32 = 6;

/// How the output is written.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Writing")]
pub(crate) struct Writing {
    /// The program the file is for, where readers differ (USD, Alembic)
    #[arg(long = "for", value_name = "PROGRAM")]
    pub(crate) dialect: Option<Program>,

    /// Strands as surfaces instead of lines (glTF): `tubes`, `tubes:SIDES` (3 to 32) or `ribbons`
    #[arg(long, value_name = "KIND", value_parser = mesh)]
    pub(crate) as_mesh: Option<Mesh>,

    /// Every attribute glTF can hold, also those some readers stumble over
    #[arg(long)]
    pub(crate) all_attributes: bool,

    /// Frames a second of an animated output (over 0) [default: the input's, or 24]
    #[arg(long, value_name = "RATE", value_parser = rate)]
    pub(crate) fps: Option<f64>,

    /// Frames of an animated input or of a sequence `name.####.hair` to convert, first-last [default: all]
    #[arg(long, value_name = "A-B", value_parser = frames, conflicts_with = "time")]
    pub(crate) frames: Option<(u64, u64)>,

    /// Let usd-core judge the USD that was written; exit 1 when it finds errors (needs Python with usd-core)
    #[arg(long)]
    pub(crate) check: bool,
}

/// A program on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Program {
    /// Unreal Engine: its groom schema; Alembic in centimetres, z up
    Unreal,
    /// SideFX Karma: cubic curves with phantom end points, as it does not know pinned ones
    Karma,
    /// Blender
    Blender,
    /// SideFX Houdini: its names for hair attributes
    Houdini,
}

impl From<Program> for Dialect {
    fn from(program: Program) -> Self {
        match program {
            Program::Unreal => Dialect::Unreal,
            Program::Karma => Dialect::Karma,
            Program::Blender => Dialect::Blender,
            Program::Houdini => Dialect::Houdini,
        }
    }
}

fn mesh(text: &str) -> Result<Mesh, String> {
    let sides = match text {
        "ribbons" => return Ok(Mesh::Ribbons),
        "tubes" => Some(SIDES),
        other => other.strip_prefix("tubes:").and_then(|sides| sides.parse().ok()),
    };
    sides
        .filter(|sides| (3..=32).contains(sides))
        .map(|sides| Mesh::Tubes { sides })
        .ok_or_else(|| "expected ribbons, tubes or tubes:SIDES with 3 to 32 sides".into())
}

fn rate(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v: &f64| v.is_finite() && *v > 0.0).ok_or("expected a number over 0".into())
}

fn frames(text: &str) -> Result<(u64, u64), String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if first <= last => Ok((first, last)),
        _ => Err("expected first-last, as 1-48".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_or_refused() {
        assert_eq!(mesh("tubes"), Ok(Mesh::Tubes { sides: SIDES }));
        assert_eq!(mesh("tubes:3"), Ok(Mesh::Tubes { sides: 3 }));
        assert_eq!(mesh("ribbons"), Ok(Mesh::Ribbons));
        for text in ["", "tube", "tubes:2", "tubes:33", "tubes:"] {
            assert!(mesh(text).is_err(), "{text}");
        }
        assert_eq!(frames("1-48"), Ok((1, 48)));
        assert_eq!(frames("7"), Ok((7, 7)));
        assert!(frames("9-1").is_err() && frames("a-b").is_err() && frames("-1").is_err());
        assert!(rate("0").is_err() && rate("nan").is_err() && rate("29.97").is_ok());
    }
}
