//! A finished picture and what is known about it.

use glam::Vec3;
use serde::Serialize;

use crate::{Aov, Cutout, MotionReport};

/// A finished picture: linear Rec. 709 radiance, row by row from the upper left.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Where it lies in the whole picture, if it is but a part of it.
    pub cutout: Option<Cutout>,
    /// Everything the camera sees, premultiplied by `alpha`; width x height values.
    pub beauty: Vec<Vec3>,
    /// How much of each pixel is covered, 0..1 (1 everywhere when the background is visible).
    pub alpha: Vec<f32>,
    /// The passes that were asked for, in the order of [`Aov::ALL`].
    pub passes: Vec<(Aov, Vec<Vec3>)>,
    /// What it cost and how exact it is.
    pub report: FrameReport,
}

impl Frame {
    /// A picture in which nothing is to be seen.
    #[must_use]
    pub fn empty(width: u32, height: u32) -> Frame {
        let count = width as usize * height as usize;
        let (beauty, alpha) = (vec![Vec3::ZERO; count], vec![0.0; count]);
        Frame {
            width,
            height,
            cutout: None,
            beauty,
            alpha,
            passes: Vec::new(),
            report: FrameReport::default(),
        }
    }

    /// The pixels of a pass, if it was asked for.
    #[must_use]
    pub fn pass(&self, aov: Aov) -> Option<&[Vec3]> {
        self.passes.iter().find(|(found, _)| *found == aov).map(|(_, pixels)| pixels.as_slice())
    }
}

/// What a picture cost and how exact it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FrameReport {
    /// Wall-clock seconds spent rendering (not building the scene), in all runs together.
    pub seconds: f64,
    /// Samples a pixel.
    pub spp: u32,
    /// The seed it was made from.
    pub seed: u64,
    /// Threads that worked on it.
    pub threads: usize,
    /// Camera paths traced: width x height x spp (more where a pass was broken off).
    pub samples: u64,
    /// Rays that looked for the closest hit.
    pub closest_rays: u64,
    /// Rays that only asked whether a light is hidden.
    pub shadow_rays: u64,
    /// Samples that could not be used because a value was not finite; 0 unless something is wrong.
    pub rejected_samples: u64,
    /// Estimated mean over pixels and channels of `variance / (value^2 + 0.01)`, the relMSE against a
    /// perfect render. Estimated from two halves of the samples that know nothing of each other;
    /// taken over the covered pixels only when the background is transparent. `None` below 2 spp.
    pub rel_mse: Option<f64>,
    /// The square root of `rel_mse`: 0.05 reads "a typical pixel is 5 % off".
    pub relative_error: Option<f64>,
    /// What moved while the shutter was open; `None` for a still picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionReport>,
}
