//! Values on the command line: what they may be, and what is said when they are not.

use clap::ValueEnum;
use command_line::numbers;
use glam::{DMat4, DVec3, Vec3};
use groom::{Expression, Ramp, UpAxis, VAxis};
use groom_formats::Format;

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

/// Which way v runs in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum V {
    Up,
    Down,
}

impl From<V> for VAxis {
    fn from(v: V) -> Self {
        match v {
            V::Up => VAxis::Up,
            V::Down => VAxis::Down,
        }
    }
}

/// How often and how strongly to smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Smooth {
    pub(crate) iterations: u32,
    pub(crate) strength: f32,
}

/// A turn about an axis through the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    pub(crate) axis: DVec3,
    pub(crate) degrees: f64,
}

pub(super) fn format(name: &str) -> Result<Format, String> {
    let known = || Format::ALL.map(Format::name).join(", ");
    Format::from_name(name).ok_or_else(|| format!("expected one of {}", known()))
}

pub(super) fn unit(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v: &f64| v.is_finite() && *v > 0.0).ok_or("expected a number over 0".into())
}

pub(super) fn factor(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|v: &f32| v.is_finite() && *v > 0.0).ok_or("expected a number over 0".into())
}

pub(super) fn width(text: &str) -> Result<f32, String> {
    text.parse()
        .ok()
        .filter(|v: &f32| v.is_finite() && *v >= 0.0)
        .ok_or("expected a number, 0 or more".into())
}

pub(super) fn color(text: &str) -> Result<Vec3, String> {
    let channels: Vec<f32> = text.split(',').map_while(|word| word.trim().parse().ok()).collect();
    match channels[..] {
        [r, g, b] if text.split(',').count() == 3 && channels.iter().all(|c| (0.0..=1.0).contains(c)) => {
            Ok(Vec3::new(r, g, b))
        }
        _ => Err("expected three numbers from 0 to 1, as 0.8,0.5,0.2".into()),
    }
}

pub(super) fn length(text: &str) -> Result<f32, String> {
    width(text)
}

pub(super) fn step(text: &str) -> Result<f32, String> {
    factor(text)
}

pub(super) fn vector(text: &str) -> Result<DVec3, String> {
    numbers(text).map(DVec3::from_array).ok_or("expected three numbers, as 0,1.5,-2".into())
}

pub(super) fn matrix(text: &str) -> Result<DMat4, String> {
    let rows: Option<[f64; 16]> = numbers(text);
    let expected = "expected 16 numbers, row by row, as 1,0,0,5,0,1,0,0,0,0,1,0,0,0,0,1 (moves by 5 along x)";
    rows.map(|rows| DMat4::from_cols_array(&rows).transpose()).ok_or(expected.into())
}

pub(super) fn turn(text: &str) -> Result<Turn, String> {
    let parts = || {
        let (axis, degrees) = text.split_once(':')?;
        let axis = match axis.trim().to_ascii_lowercase().as_str() {
            "x" => DVec3::X,
            "y" => DVec3::Y,
            "z" => DVec3::Z,
            other => numbers(other).map(DVec3::from_array).filter(|axis| *axis != DVec3::ZERO)?,
        };
        let [degrees] = numbers(degrees)?;
        Some(Turn { axis, degrees })
    };
    parts().ok_or("expected an axis and degrees, as z:90 or 1,1,0:-30".into())
}

pub(super) fn smooth(text: &str) -> Result<Smooth, String> {
    let parts = || {
        let (iterations, strength) = text.split_once(':').unwrap_or((text, "0.5"));
        let (iterations, strength) = (iterations.trim().parse().ok()?, strength.trim().parse().ok()?);
        (iterations > 0 && (0.0..=1.0).contains(&strength)).then_some(Smooth { iterations, strength })
    };
    parts().ok_or("expected how often (1 or more) and how strongly (0 to 1), as 5 or 5:0.8".into())
}

pub(super) fn ramp(text: &str) -> Result<Ramp, String> {
    text.parse().map_err(|error: groom::GroomError| error.to_string())
}

pub(super) fn expression(text: &str) -> Result<Expression, String> {
    text.parse().map_err(|error: groom::GroomError| error.to_string())
}

pub(super) fn setting(text: &str) -> Result<(String, Expression), String> {
    let Some((name, value)) = text.split_once('=') else {
        return Err("expected name=value, as curl=0.3".into());
    };
    let name = name.trim();
    // What every format can write.
    let sound = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !sound {
        return Err(format!("expected letters, digits and _ as a name, not `{name}`"));
    }
    Ok((name.to_owned(), expression(value)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(color("1,0.5,0"), Ok(Vec3::new(1.0, 0.5, 0.0)));
        for text in ["", "1,1", "1,1,1,1", "1,1,2", "1,1,x", "1,x,1,1", "nan,0,0"] {
            assert!(color(text).is_err(), "{text}");
        }
        assert!(unit("0").is_err() && unit("inf").is_err() && factor("-1").is_err() && width("nan").is_err());
        assert_eq!(width("0"), Ok(0.0));
    }

    #[test]
    fn turns_moves_and_matrices() {
        assert_eq!(vector("1, -2,3e1"), Ok(DVec3::new(1.0, -2.0, 30.0)));
        assert_eq!(turn("Z:-90"), Ok(Turn { axis: DVec3::Z, degrees: -90.0 }));
        assert_eq!(turn("1,1,0:30").unwrap().axis, DVec3::new(1.0, 1.0, 0.0));
        let moved = matrix("1,0,0,5, 0,1,0,6, 0,0,1,7, 0,0,0,1").unwrap();
        assert_eq!(moved, DMat4::from_translation(DVec3::new(5.0, 6.0, 7.0)));
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf"] {
            assert!(vector(text).is_err() && matrix(text).is_err(), "{text}");
        }
        for text in ["z", "90", "w:90", "z:x", "0,0,0:9", "z:nan", "1,2:3"] {
            assert!(turn(text).is_err(), "{text}");
        }
    }

    #[test]
    fn smoothing_and_settings() {
        assert_eq!(smooth("3"), Ok(Smooth { iterations: 3, strength: 0.5 }));
        assert_eq!(smooth("3:1").unwrap().strength, 1.0);
        for text in ["", "0", "-1", "3:", "3:2", "3:nan", "x:1"] {
            assert!(smooth(text).is_err(), "{text}");
        }
        assert_eq!(setting("a_1 = 0.5").unwrap().0, "a_1");
        for text in ["a", "=1", "a b=1", "1a=1", "a=", "a=x", "\u{e4}=1"] {
            assert!(setting(text).is_err(), "{text}");
        }
    }
}
