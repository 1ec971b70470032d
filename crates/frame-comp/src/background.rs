//! What is put behind the transparent part of a frame.

use std::path::Path;

use glam::Vec3;

use crate::plate::light_of_srgb;
use crate::{CompError, Meaning, Plate};

/// A colour or a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// One colour, linear Rec. 709, to be seen as it is.
    Color(Vec3),
    /// A picture.
    Plate(Plate),
}

impl Background {
    /// What its numbers stand for.
    #[must_use]
    pub fn meaning(&self) -> Meaning {
        match self {
            Background::Color(_) => Meaning::Display,
            Background::Plate(plate) => plate.meaning(),
        }
    }

    /// `#rrggbb` (sRGB), `r,g,b` (linear Rec. 709) or the path of a picture.
    ///
    /// # Errors
    /// [`CompError::Color`], or those of [`Plate::read`].
    pub fn read(words: &str) -> Result<Background, CompError> {
        let fault = || CompError::Color { found: words.to_owned() };
        if let Some(digits) = words.strip_prefix('#') {
            // A file may be called `#1.png`.
            if !Path::new(words).exists() {
                return hex(digits).map(Background::Color).ok_or_else(fault);
            }
        }
        let numbers: Option<Vec<f32>> = words.split(',').map(|part| part.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[red, green, blue]) => {
                let color = [red, green, blue];
                let is_color = color.iter().all(|value| (0.0..=1000.0).contains(value));
                if is_color { Ok(Background::Color(Vec3::from_array(color))) } else { Err(fault()) }
            }
            Some(_) if !Path::new(words).exists() => Err(fault()),
            _ => Plate::read(Path::new(words)).map(Background::Plate),
        }
    }
}

/// The light of six hexadecimal digits of sRGB.
fn hex(digits: &str) -> Option<Vec3> {
    if digits.len() != 6 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let whole = u32::from_str_radix(digits, 16).ok()?;
    let byte = |shift: u32| light_of_srgb((whole >> shift & 0xff) as f32 / 255.0);
    Some(Vec3::new(byte(16), byte(8), byte(0)))
}
