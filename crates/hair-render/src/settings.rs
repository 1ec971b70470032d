//! How a picture is made from a scene.

use crate::crop::Window;
use crate::{Aov, AovSet, Crop, RenderError};

/// Which ways of finding light are used. Anything but [`LightSampling::Both`] is for verification:
/// all three agree in the mean and differ in noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightSampling {
    /// Lights and fibres are both sampled and weighed against each other (MIS, power heuristic).
    #[default]
    Both,
    /// Only towards the lights.
    LightsOnly,
    /// Only where the scattering goes.
    ScatteringOnly,
}

/// What becomes of the light that comes straight from the environment to the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Background {
    /// It is left out; alpha says how much of the pixel is covered, colours are premultiplied.
    #[default]
    Transparent,
    /// It is part of the beauty, and alpha is 1 everywhere.
    Visible,
}

/// How a picture is made.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Pixels across, 1..=65536.
    pub width: u32,
    /// Pixels down, 1..=65536.
    pub height: u32,
    /// Samples a pixel, at least 1; an error estimate needs 2.
    pub spp: u32,
    /// Everything random follows from it.
    pub seed: u64,
    /// Scatterings after the first before a path is cut; 0 is direct light only. What a cut takes
    /// away is lost energy: light hair needs 64 and more.
    pub max_bounces: u32,
    /// Russian roulette may end a path from this scattering on (it changes noise, not the mean).
    pub roulette_start: u32,
    /// Threads; one a core when `None`. The picture does not depend on it.
    pub threads: Option<usize>,
    /// Radius of the pixel filter (Blackman-Harris, sampled by importance), in pixels, above 0.
    pub filter_radius: f32,
    /// Passes to keep beside beauty and alpha.
    pub aovs: AovSet,
    /// Whether the environment is seen behind the hair.
    pub background: Background,
    /// Which ways of finding light are used.
    pub light_sampling: LightSampling,
    /// The part of the picture to render; all of it when `None`.
    pub crop: Option<Crop>,
}

impl Default for RenderSettings {
    fn default() -> Self {
        RenderSettings {
            width: 512,
            height: 512,
            spp: 64,
            seed: 0,
            max_bounces: 256,
            roulette_start: 16,
            threads: None,
            filter_radius: 1.5,
            aovs: AovSet::none(),
            background: Background::Transparent,
            light_sampling: LightSampling::Both,
            crop: None,
        }
    }
}

impl RenderSettings {
    /// Whether every value is in its range.
    ///
    /// # Errors
    /// [`RenderError::Argument`] naming the first value that is not.
    pub fn check(&self) -> Result<(), RenderError> {
        for (what, size) in [("width", self.width), ("height", self.height)] {
            if !(1..=65_536).contains(&size) {
                return Err(RenderError::argument(what, size, "1..=65536 pixels"));
            }
        }
        if self.spp == 0 {
            return Err(RenderError::argument("spp", 0, "at least 1 sample a pixel"));
        }
        if !(self.filter_radius > 0.0 && self.filter_radius <= 16.0) {
            return Err(RenderError::argument(
                "filter radius",
                self.filter_radius,
                "above 0, at most 16 pixels",
            ));
        }
        if self.threads == Some(0) {
            return Err(RenderError::argument("threads", 0, "at least 1"));
        }
        self.window().map(drop)
    }

    /// The pixels to render.
    pub(crate) fn window(&self) -> Result<Window, RenderError> {
        match &self.crop {
            Some(crop) => crop.window(self.width, self.height),
            None => Ok(Window { x: 0, y: 0, width: self.width, height: self.height }),
        }
    }

    /// The threads that work.
    pub(crate) fn pool(&self) -> Result<rayon::ThreadPool, RenderError> {
        let threads = self.threads.unwrap_or(0);
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|fault| RenderError::Threads { threads, reason: fault.to_string() })
    }

    /// The same settings with one more pass.
    #[must_use]
    pub fn with_aov(mut self, aov: Aov) -> Self {
        self.aovs.insert(aov);
        self
    }
}
