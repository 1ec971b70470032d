//! How well the passes of a frame add up to its beauty.

use glam::DVec3;
use hair_render::{Aov, Frame};

/// The light of a frame that its passes do not account for.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// Passes that the frame does not carry: their light is part of what is left.
    pub missing: Vec<Aov>,
    /// The largest difference of a channel.
    pub largest: f64,
    /// Sum of all differences over the sum of the beauty, 0 for a black frame.
    pub share: f64,
    /// Largest difference over the largest value of the beauty, 0 for a black frame: what rounding explains is below
    /// 1e-6 for frames in 32-bit and below 4e-3 for frames in 16-bit floats.
    pub relative: f64,
}

/// The difference between the sum of the passes of `frame` and its beauty.
#[must_use]
pub fn residual(frame: &Frame) -> Residual {
    let missing: Vec<Aov> = Aov::ALL.into_iter().filter(|&pass| frame.pass(pass).is_none()).collect();
    let (mut largest, mut sum, mut light, mut brightest) = (0.0f64, 0.0, 0.0, 0.0f64);
    for (index, beauty) in frame.beauty.iter().enumerate() {
        let beauty = beauty.as_dvec3();
        let passes = frame.passes.iter().filter_map(|(_, pixels)| pixels.get(index));
        let difference = (passes.map(|pixel| pixel.as_dvec3()).sum::<DVec3>() - beauty).abs();
        largest = largest.max(difference.max_element());
        brightest = brightest.max(beauty.abs().max_element());
        sum += difference.element_sum();
        light += beauty.abs().element_sum();
    }
    let over = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
    Residual { missing, largest, share: over(sum, light), relative: over(largest, brightest) }
}
