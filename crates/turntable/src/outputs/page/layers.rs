//! A frame taken apart into what the page weighs.

use frame_comp::{Background, Fit, Meaning};
use glam::Vec3;
use hair_render::{Aov, Frame};

use crate::expand::Variant;
use crate::outputs::look::Look;

/// The layer of what is in no pass that was asked for.
const OTHER: &str = "other light";

/// The layer of a plate of light.
const PLATE: &str = "plate";

/// What rounding may leave of a frame's brightest value when its passes are taken away.
const ROUNDING: f32 = 1e-5;

/// The layers that frames are taken apart into: every pass that some variant asks for, and what is left. The page
/// leaves out what is black in all frames.
pub(super) fn names(variants: &[Variant]) -> Vec<String> {
    let asks = |aov: &Aov| {
        let names = variants.iter().flat_map(|variant| &variant.pipeline.render.aovs);
        names.into_iter().any(|name| name.eq_ignore_ascii_case("all") || Aov::from_name(name) == Some(*aov))
    };
    let mut names: Vec<String> = Aov::ALL.into_iter().filter(asks).map(|aov| aov.name().to_owned()).collect();
    if !names.is_empty() {
        names.extend([OTHER.to_owned(), PLATE.to_owned()]);
    }
    names
}

/// Layers by name, and how much of the picture they cover.
pub(super) struct Layers {
    pub light: Vec<Vec<[f32; 3]>>,
    pub alpha: Vec<f32>,
}

impl Layers {
    /// The layers of a frame in the order of `names`.
    pub fn of(frame: &Frame, look: &Look, names: &[String]) -> Layers {
        let over = match look.plate.as_deref() {
            Some(background @ Background::Plate(plate)) if plate.meaning() == Meaning::Light => {
                Some(frame_comp::behind(frame, background, Fit::Fill))
            }
            _ => None,
        };
        let count = frame.beauty.len();
        let light = names.iter().map(|name| match (name.as_str(), &over) {
            (OTHER, _) => other(frame),
            (PLATE, Some(over)) => {
                over.beauty.iter().zip(&frame.beauty).map(|(over, own)| (*over - *own).to_array()).collect()
            }
            (PLATE, None) => vec![[0.0; 3]; count],
            (name, _) => {
                let pixels = Aov::from_name(name).and_then(|aov| frame.pass(aov)).unwrap_or_default();
                let mut pixels: Vec<[f32; 3]> = pixels.iter().map(Vec3::to_array).collect();
                pixels.resize(count, [0.0; 3]);
                pixels
            }
        });
        let alpha = over.as_ref().map_or(&frame.alpha, |over| &over.alpha).clone();
        Layers { light: light.collect(), alpha }
    }
}

/// What is in none of a frame's passes.
fn other(frame: &Frame) -> Vec<[f32; 3]> {
    let brightest = frame.beauty.iter().map(|pixel| pixel.max_element()).fold(0.0, f32::max);
    let left = |(index, beauty): (usize, &Vec3)| {
        let passes = frame.passes.iter().filter_map(|(_, pixels)| pixels.get(index)).sum::<Vec3>();
        let left = *beauty - passes;
        if left.max_element() > ROUNDING * brightest { left.to_array() } else { [0.0; 3] }
    };
    frame.beauty.iter().enumerate().map(left).collect()
}
