//! Colours of hair, and whether they arrive.

use glam::Vec3;
use hair_render::{ColorMatch, ColorMatching, Progress, RenderSettings};
use serde::Serialize;

use crate::{Stage, SweepError};

/// A colour hair is known by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedColor {
    /// What it is called.
    pub name: &'static str,
    /// Linear Rec. 709.
    pub linear: Vec3,
}

/// The thesis' base colour, and six colours of hair. The thesis' figure of colours names none of its own, so
/// these are ours: sRGB bytes, picked by eye.
#[must_use]
pub fn colors() -> Vec<NamedColor> {
    let thesis = NamedColor { name: "thesis orange", linear: Vec3::new(0.856, 0.212_813, 0.046_948) };
    let ours = [
        ("platinum blond", [232, 219, 193]),
        ("honey blond", [201, 160, 98]),
        ("copper", [184, 88, 40]),
        ("chestnut", [122, 74, 46]),
        ("dark brown", [78, 54, 40]),
        ("steel grey", [148, 148, 152]),
    ];
    let named = |(name, srgb): (&'static str, [u8; 3])| NamedColor {
        name,
        linear: Vec3::from_array(srgb.map(|byte| linear(f32::from(byte) / 255.0))),
    };
    std::iter::once(thesis).chain(ours.into_iter().map(named)).collect()
}

/// The sRGB curve undone.
fn linear(value: f32) -> f32 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// One line of the table of colours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedMatch {
    /// The colour's name.
    pub name: &'static str,
    /// What was found.
    #[serde(flatten)]
    pub found: ColorMatch,
}

/// Matches each of [`colors`] on a groom: how far off Chiang's fit is there, and how near bisection comes.
///
/// # Errors
/// [`SweepError::Render`] as [`hair_render::match_color`].
pub fn match_colors(
    stage: &mut Stage,
    settings: &RenderSettings,
    matching: &ColorMatching,
    progress: &dyn Progress,
) -> Result<Vec<NamedMatch>, SweepError> {
    let camera = stage.camera(1.0)?;
    let all = colors();
    all.iter()
        .map(|&NamedColor { name, linear }| {
            let matching = ColorMatching { color: linear, ..matching.clone() };
            let found = hair_render::match_color(stage.scene_mut(), &camera, settings, &matching, progress)?;
            Ok(NamedMatch { name, found })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_srgbs() {
        assert!((linear(0.5) - 0.214_041).abs() < 1e-5 && linear(0.0) == 0.0 && linear(1.0) == 1.0);
        assert!((linear(0.04) - 0.003_096).abs() < 1e-6);

        for color in colors() {
            assert!(color.linear.min_element() > 0.0 && color.linear.max_element() < 1.0, "{color:?}");
        }
    }
}
