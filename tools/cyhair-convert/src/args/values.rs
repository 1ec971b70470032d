//! Values on the command line: what they may be, and what is said when they are not.

use clap::ValueEnum;
use glam::Vec3;
use groom::UpAxis;
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
}
