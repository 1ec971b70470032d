//! How a shutter opens and closes.

use std::fmt;
use std::str::FromStr;

use crate::RenderError;

/// How much light a shutter lets in from its opening to its closing; only the shape counts, not the height.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum ShutterShape {
    /// Open all the while: the sharp-edged blur of an electronic shutter.
    #[default]
    Box,
    /// Opens steadily until the middle, then closes.
    Triangle,
    /// Opens, stays open, closes: a mechanical shutter.
    Trapezoid {
        /// Share of the time that it takes to open, 0..1.
        opening: f64,
        /// Share of the time that it takes to close, 0..1; with `opening` at most 1.
        closing: f64,
    },
    /// One whole wave of a cosine, raised to lie above 0: the blur without any edge.
    Cosine,
    /// Heights at even times from opening to closing, straight lines between them; at least two, none below
    /// 0, not all 0.
    Curve(Vec<f64>),
}

/// Most heights of a curve.
const MOST_HEIGHTS: usize = 4096;

impl ShutterShape {
    /// Whether every value is in its range.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        match self {
            ShutterShape::Box | ShutterShape::Triangle | ShutterShape::Cosine => Ok(()),
            ShutterShape::Trapezoid { opening, closing } => {
                let sound = *opening >= 0.0 && *closing >= 0.0 && opening + closing <= 1.0;
                let found = || format!("{opening},{closing}");
                let expected = "two shares of the time, at least 0 and together at most 1";
                if sound { Ok(()) } else { Err(RenderError::argument("shutter ramps", found(), expected)) }
            }
            ShutterShape::Curve(heights) => check_heights(heights),
        }
    }

    /// The corners of the shape, (time, height), where it is made of straight lines.
    pub(crate) fn corners(&self) -> Option<Vec<(f64, f64)>> {
        match self {
            ShutterShape::Box | ShutterShape::Cosine => None,
            ShutterShape::Triangle => Some(vec![(0.0, 0.0), (0.5, 1.0), (1.0, 0.0)]),
            ShutterShape::Trapezoid { opening, closing } => {
                Some(vec![(0.0, 0.0), (*opening, 1.0), (1.0 - closing, 1.0), (1.0, 0.0)])
            }
            ShutterShape::Curve(heights) => {
                let last = heights.len().saturating_sub(1).max(1) as f64;
                Some(heights.iter().enumerate().map(|(i, &height)| (i as f64 / last, height)).collect())
            }
        }
    }
}

fn check_heights(heights: &[f64]) -> Result<(), RenderError> {
    let wrong = |found: String| Err(RenderError::argument("shutter curve", found, CURVE));
    if !(2..=MOST_HEIGHTS).contains(&heights.len()) {
        return wrong(format!("{} heights", heights.len()));
    }
    // A bound from above keeps sums of areas finite.
    if let Some(odd) = heights.iter().find(|height| !(0.0..=1e30).contains(*height)) {
        return wrong(format!("a height of {odd}"));
    }
    if heights.iter().all(|&height| height == 0.0) {
        return wrong("closed all the while".into());
    }
    Ok(())
}

const CURVE: &str = "2 to 4096 heights, at least 0 (at most 1e30) and not all 0";
const SHAPES: &str = "box, triangle, cosine, trapezoid:OPENING,CLOSING or curve:HEIGHT,HEIGHT,...";

impl FromStr for ShutterShape {
    type Err = RenderError;

    /// Reads what [`ShutterShape`]'s `Display` writes.
    fn from_str(words: &str) -> Result<Self, RenderError> {
        let unknown = || RenderError::argument("shutter shape", words, SHAPES);
        let numbers = |list: &str| -> Result<Vec<f64>, RenderError> {
            list.split(',').map(|word| word.trim().parse().map_err(|_| unknown())).collect()
        };
        let shape = match words.split_once(':') {
            None => match words {
                "box" => ShutterShape::Box,
                "triangle" => ShutterShape::Triangle,
                "cosine" => ShutterShape::Cosine,
                _ => return Err(unknown()),
            },
            Some(("trapezoid", ramps)) => match numbers(ramps)?.as_slice() {
                &[opening, closing] => ShutterShape::Trapezoid { opening, closing },
                _ => return Err(unknown()),
            },
            Some(("curve", heights)) => ShutterShape::Curve(numbers(heights)?),
            Some(_) => return Err(unknown()),
        };
        shape.check()?;
        Ok(shape)
    }
}

impl fmt::Display for ShutterShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ShutterShape::Box => f.write_str("box"),
            ShutterShape::Triangle => f.write_str("triangle"),
            ShutterShape::Cosine => f.write_str("cosine"),
            ShutterShape::Trapezoid { opening, closing } => write!(f, "trapezoid:{opening},{closing}"),
            ShutterShape::Curve(heights) => {
                f.write_str("curve:")?;
                for (i, height) in heights.iter().enumerate() {
                    write!(f, "{}{height}", if i > 0 { "," } else { "" })?;
                }
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_back_as_they_were() {
        for words in ["box", "triangle", "cosine", "trapezoid:0.25,0.5", "curve:0,1,0.5"] {
            assert_eq!(words.parse::<ShutterShape>().unwrap().to_string(), words);
        }
    }

    #[test]
    fn what_is_no_shape_is_refused_with_what_is() {
        for words in [
            "",
            "Box",
            "trapezoid",
            "trapezoid:1",
            "trapezoid:0.7,0.7",
            "trapezoid:-1,0",
            "trapezoid:nan,0",
            "curve:",
            "curve:1",
            "curve:0,0",
            "curve:1,-1",
            "curve:1,inf",
            "round:1,2",
        ] {
            let told = words.parse::<ShutterShape>().unwrap_err().to_string();
            assert!(told.contains("expected"), "{words}: {told}");
        }
        let told = "bok".parse::<ShutterShape>().unwrap_err().to_string();
        assert!(told.starts_with("shutter shape is bok, expected box, triangle"), "{told}");
    }
}
