//! Frames made smaller, to be looked at.

use glam::Vec3;
use hair_render::Frame;

use crate::Fit;
use crate::fit::fitted;

/// The size of a frame of `width` x `height` pixels whose longest edge is to be at most `longest`.
#[must_use]
pub fn smaller_size(width: u32, height: u32, longest: u32) -> (u32, u32) {
    let edge = width.max(height);
    if edge <= longest {
        return (width, height);
    }
    let scaled = |length: u32| {
        let scaled = f64::from(length) * f64::from(longest) / f64::from(edge);
        (scaled.round() as u32).max(1)
    };
    (scaled(width), scaled(height))
}

/// The frame with its longest edge at most `longest` pixels: beauty, alpha and passes are means of the areas that
/// pixels cover, so that the passes still add up to the beauty. A frame that is small enough comes back as it is.
#[must_use]
pub fn smaller(frame: &Frame, longest: u32) -> Frame {
    let (width, height) = smaller_size(frame.width, frame.height, longest);
    if (width, height) == (frame.width, frame.height) {
        return frame.clone();
    }
    let from = (frame.width as usize, frame.height as usize);
    let to = (width as usize, height as usize);
    let shrink = |pixels: &[Vec3]| fitted(pixels, from, to, Fit::Stretch).pixels;
    let alpha: Vec<Vec3> = frame.alpha.iter().map(|&alpha| Vec3::splat(alpha)).collect();
    Frame {
        width,
        height,
        cutout: None,
        beauty: shrink(&frame.beauty),
        alpha: shrink(&alpha).into_iter().map(|alpha| alpha.x.clamp(0.0, 1.0)).collect(),
        passes: frame.passes.iter().map(|(aov, pixels)| (*aov, shrink(pixels))).collect(),
        report: frame.report.clone(),
    }
}
