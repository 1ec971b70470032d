//! What can be asked for.

use std::fmt;
use std::str::FromStr;

use groom::GroomError;

/// How the hair lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Long and straight.
    #[default]
    Straight,
    /// Shoulder-long, in waves that neighbours share.
    Wavy,
    /// Shorter, in locks that wind around themselves.
    Curly,
}

impl Style {
    /// Every style.
    pub const ALL: [Style; 3] = [Style::Straight, Style::Wavy, Style::Curly];
}

impl fmt::Display for Style {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Style::Straight => "straight",
            Style::Wavy => "wavy",
            Style::Curly => "curly",
        })
    }
}

impl FromStr for Style {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let style = Style::ALL.into_iter().find(|style| style.to_string() == name);
        style.ok_or_else(|| format!("`{name}` is no style; expected straight, wavy or curly"))
    }
}

/// A head of hair to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How the hair lies.
    pub style: Style,
    /// How many strands, 1 to 2^24.
    pub strands: u32,
    /// How many points each strand has, 3 to 1000.
    pub points: u32,
    /// Gives shorter strands fewer points, at least 3, instead of the same number to all.
    pub vary_points: bool,
    /// Everything random hangs on it.
    pub seed: u64,
    /// Adds a colour at each point: brown, lighter towards the tip, no two strands alike.
    pub color: bool,
    /// Adds a transparency at each point: opaque, clearer towards the tip.
    pub transparency: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            style: Style::Straight,
            strands: 10_000,
            points: 16,
            vary_points: false,
            seed: 1,
            color: false,
            transparency: false,
        }
    }
}

/// Hair that cannot be made as asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SampleError {
    /// An option is out of its range.
    #[error("{what} is {found}, expected {expected}")]
    Option {
        /// The option.
        what: &'static str,
        /// Its value.
        found: u64,
        /// The range it must lie in.
        expected: &'static str,
    },
    /// An option that is no whole number is out of its range.
    #[error("{what} is {found}, expected {expected}")]
    Number {
        /// The option.
        what: &'static str,
        /// Its value.
        found: String,
        /// The range it must lie in.
        expected: &'static str,
    },
    /// Nothing can grow on the surface.
    #[error("surface, {place}: {found}, expected {expected}")]
    Surface {
        /// Where: vertex, triangle, or all of it.
        place: String,
        /// What was found there.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// The groom could not be put together.
    #[error(transparent)]
    Groom(#[from] GroomError),
}

impl Options {
    /// Refuses options out of their range.
    pub(crate) fn check(&self) -> Result<(), SampleError> {
        let option = |what, found: u64, expected| Err(SampleError::Option { what, found, expected });
        if !(1..=1 << 24).contains(&self.strands) {
            return option("strands", self.strands.into(), "1 to 16777216");
        }
        if !(3..=1000).contains(&self.points) {
            return option("points per strand", self.points.into(), "3 to 1000");
        }
        let total = u64::from(self.strands) * u64::from(self.points);
        if total > u64::from(u32::MAX) {
            return option("strands x points", total, "fewer than 2^32");
        }
        Ok(())
    }
}
