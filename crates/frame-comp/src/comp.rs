//! Frames before something.

use glam::Vec3;
use hair_render::{
    Backdrop, Frame, Preview, ToneMapping, tone_map, tone_map_deep, tone_map_over, tone_map_over_deep,
};

use crate::{Background, Fit, Meaning};

/// The frame over `background`, in light: beauty x 1 + background x (1 - alpha), and nothing transparent is left. What is
/// said in display values (a colour, a PNG) is taken as the light that shows like that at exposure 0 with the
/// curve `clip`. The passes stay: what was put behind is in none of them.
#[must_use]
pub fn behind(frame: &Frame, background: &Background, fit: Fit) -> Frame {
    let mut over = frame.clone();
    let fitted = match background {
        Background::Color(_) => None,
        Background::Plate(plate) => Some(plate.behind(frame, fit).pixels),
    };
    for (index, (pixel, alpha)) in over.beauty.iter_mut().zip(&mut over.alpha).enumerate() {
        let light = match (background, &fitted) {
            (Background::Color(color), _) => *color,
            (_, Some(pixels)) => pixels.get(index).copied().unwrap_or(Vec3::ZERO),
            _ => Vec3::ZERO,
        };
        *pixel += light * (1.0 - *alpha);
        *alpha = 1.0;
    }
    over
}

/// The frame over `background` as it would be shown: display values behind it are seen as they are, light is
/// exposed with the frame. Without a background, the backdrop of `mapping` counts.
#[must_use]
pub fn shown(frame: &Frame, background: Option<&Background>, fit: Fit, mapping: &ToneMapping) -> Preview {
    match background {
        None => tone_map(frame, mapping),
        Some(&Background::Color(color)) => {
            tone_map(frame, &ToneMapping { backdrop: Backdrop::Solid(color), ..*mapping })
        }
        Some(light @ Background::Plate(plate)) if plate.meaning() == Meaning::Light => {
            tone_map(&behind(frame, light, fit), mapping)
        }
        Some(Background::Plate(plate)) => tone_map_over(frame, mapping, &plate.behind(frame, fit).pixels),
    }
}

/// As [`shown`], with sixteen bits a channel: red, green, blue, straight alpha, row by row from the upper left.
#[must_use]
pub fn shown_deep(
    frame: &Frame,
    background: Option<&Background>,
    fit: Fit,
    mapping: &ToneMapping,
) -> Vec<u16> {
    match background {
        None => tone_map_deep(frame, mapping),
        Some(&Background::Color(color)) => {
            tone_map_deep(frame, &ToneMapping { backdrop: Backdrop::Solid(color), ..*mapping })
        }
        Some(light @ Background::Plate(plate)) if plate.meaning() == Meaning::Light => {
            tone_map_deep(&behind(frame, light, fit), mapping)
        }
        Some(Background::Plate(plate)) => {
            tone_map_over_deep(frame, mapping, &plate.behind(frame, fit).pixels)
        }
    }
}
