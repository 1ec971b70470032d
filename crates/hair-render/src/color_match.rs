//! Colour that arrives: the absorption that gives *this* groom the colour that was picked.
//!
//! Chiang's fit ([`fibre_scattering::absorption_from_color`]) holds for one thick assembly of fibres. How light
//! a groom becomes also hangs on how dense it is, how its fibres lie and how many bounces are followed.
//! So the groom itself is asked: it is rendered small, lit evenly from all around, and its absorption is
//! changed until its mean colour is the one picked.

use std::time::Instant;

use fibre_scattering::absorption_from_color;
use glam::{DVec3, Vec3};
use serde::Serialize;

use crate::Environment;
use crate::color_probe::{Probe, Seen};
use crate::color_search::{Channel, Reach};
use crate::exposure::Exposure;
use crate::lights::Lights;
use crate::{Camera, MovingCamera, Progress, RenderError, RenderSettings, Scene};

/// What is to be matched, and how closely.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorMatching {
    /// Index into the scene's hair.
    pub object: usize,
    /// The mean colour the groom shall have under even white light of radiance 1; linear Rec. 709, at least 0.
    pub color: Vec3,
    /// How far off a channel may be, above 0; a channel is also taken as reached within the standard error
    /// of the probe.
    pub tolerance: f32,
    /// Pixels along each edge of the probe, 8..=1024.
    pub size: u32,
    /// Samples a pixel of the probe, at least 8 (rounded up to a multiple of 8).
    pub spp: u32,
    /// The part of the picture that counts: left, upper, right, lower edge, as shares of its width and
    /// height from the upper left corner.
    pub patch: [f32; 4],
    /// Renders after which the best so far is taken, at least 2.
    pub max_probes: u32,
}

impl Default for ColorMatching {
    fn default() -> Self {
        ColorMatching {
            object: 0,
            color: Vec3::ONE,
            tolerance: 0.005,
            size: 64,
            spp: 32,
            patch: [0.0, 0.0, 1.0, 1.0],
            max_probes: 24,
        }
    }
}

/// What was found. Arrays are red, green, blue.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColorMatch {
    /// The colour that was picked.
    pub wanted: [f32; 3],
    /// The absorption found, of the cortex per fibre radius.
    pub absorption: [f32; 3],
    /// The mean colour with it.
    pub color: [f32; 3],
    /// How far that is from the wanted colour in the worst channel.
    pub error: f32,
    /// Chiang's absorption for the same colour.
    pub fit_absorption: [f32; 3],
    /// The mean colour with it.
    pub fit_color: [f32; 3],
    /// How far that is from the wanted colour in the worst channel.
    pub fit_error: f32,
    /// Whether each channel could be had at all.
    pub reach: [Reach; 3],
    /// Standard error of `color`.
    pub noise: [f32; 3],
    /// Share of the probe's patch that the groom covers.
    pub coverage: f32,
    /// Renders it took.
    pub probes: u32,
    /// Seconds it took.
    pub seconds: f64,
}

impl ColorMatch {
    /// Whether every channel was reached.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.reach.iter().all(|&reach| reach == Reach::Reached)
    }
}

/// Finds the absorption with which the groom has the colour `matching` asks for, as `camera` sees it, and
/// leaves the scene with it: one absorption for all strands of that groom.
///
/// `settings` are those of the render that will follow: bounces, roulette, seed and threads are taken from
/// it, for they too change the colour. The scene's own lights are put aside for a constant white environment;
/// everything else, the tree first of all, is used as it is. When this fails the scene is as it was.
///
/// # Errors
/// [`RenderError::Argument`] for a matching or settings out of range or a groom the camera does not see,
/// [`RenderError::Threads`], or [`RenderError::Cancelled`].
pub fn match_color(
    scene: &mut Scene,
    camera: &Camera,
    settings: &RenderSettings,
    matching: &ColorMatching,
    progress: &dyn Progress,
) -> Result<ColorMatch, RenderError> {
    settings.check()?;
    matching.check(scene)?;
    let pool = settings.pool()?;
    let white = Lights::new(Some(Environment::constant(Vec3::ONE)?), &[], scene.center());
    let refused = |source| RenderError::Scattering { object: matching.object, source };
    let before = scene.fibres[matching.object].set_cortex(Vec3::ZERO).map_err(refused)?;
    let lights = std::mem::replace(&mut scene.lights, white);
    let found = pool.install(|| search(scene, camera, settings, matching, progress));
    scene.lights = lights;
    if found.is_err() {
        scene.fibres[matching.object].set_absorption(before);
    }
    found
}

fn search(
    scene: &mut Scene,
    camera: &Camera,
    settings: &RenderSettings,
    matching: &ColorMatching,
    progress: &dyn Progress,
) -> Result<ColorMatch, RenderError> {
    let start = Instant::now();
    let probe = Probe {
        object: matching.object as u32,
        exposure: Exposure::new(scene, &MovingCamera::from(*camera), matching.size, matching.size),
        patch: matching.pixels(),
        spp: matching.spp,
        settings,
    };
    let beta_n = scene.fibres[matching.object].beta_n();
    let refused = |source| RenderError::Scattering { object: matching.object, source };
    let mut look = |sigma: Vec3| {
        scene.fibres[matching.object].set_cortex(sigma).map_err(refused)?;
        probe.look(scene, progress)
    };
    let wanted = matching.color;
    // The fit ends at white; that a colour beyond it cannot be had is what the search will tell.
    let fit = absorption_from_color(wanted.min(Vec3::ONE), beta_n).map_err(refused)?;
    let mut sigma = fit;
    let mut channels = wanted.to_array().map(|wanted| Channel::new(f64::from(wanted)));
    let mut first: Option<Seen> = None;
    let mut probes = 0;
    loop {
        let seen = look(sigma)?;
        probes += 1;
        // The last of them is told once it is known to be the last.
        progress.advance(u64::from(probes - 1), u64::from(matching.max_probes));
        if seen.coverage <= 0.0 {
            return Err(RenderError::argument(
                "colour to match",
                "of hair the camera does not see",
                "hair in the patch",
            ));
        }
        let fitted = *first.get_or_insert(seen);
        for (c, channel) in channels.iter_mut().enumerate() {
            let near = f64::from(matching.tolerance).max(seen.noise[c]);
            channel.learn(f64::from(sigma[c]), seen.color[c], near);
        }
        let settled = channels.iter().all(Channel::is_settled);
        if settled || probes >= matching.max_probes {
            let all = u64::from(matching.max_probes);
            progress.advance(all, all);
            return Ok(ColorMatch {
                wanted: wanted.to_array(),
                absorption: sigma.to_array(),
                color: seen.color.as_vec3().to_array(),
                error: worst(seen.color, wanted),
                fit_absorption: fit.to_array(),
                fit_color: fitted.color.as_vec3().to_array(),
                fit_error: worst(fitted.color, wanted),
                reach: channels.each_ref().map(Channel::reach),
                noise: seen.noise.as_vec3().to_array(),
                coverage: seen.coverage as f32,
                probes,
                seconds: start.elapsed().as_secs_f64(),
            });
        }
        sigma = Vec3::from_array(channels.each_ref().map(|channel| channel.next() as f32));
    }
}

fn worst(found: DVec3, wanted: Vec3) -> f32 {
    (found - wanted.as_dvec3()).abs().max_element() as f32
}

impl ColorMatching {
    fn check(&self, scene: &Scene) -> Result<(), RenderError> {
        if self.object >= scene.fibres.len() {
            return Err(RenderError::argument("hair object to match", self.object, "one of the scene's"));
        }
        if !(self.color.is_finite() && self.color.min_element() >= 0.0) {
            return Err(RenderError::argument("colour to match", self.color, "finite, at least 0"));
        }
        if !(self.tolerance > 0.0 && self.tolerance <= 1.0) {
            return Err(RenderError::argument("colour tolerance", self.tolerance, "above 0, at most 1"));
        }
        if !(8..=1024).contains(&self.size) {
            return Err(RenderError::argument("size of the colour probe", self.size, "8..=1024 pixels"));
        }
        if self.spp < 8 {
            return Err(RenderError::argument("spp of the colour probe", self.spp, "at least 8"));
        }
        if self.max_probes < 2 {
            return Err(RenderError::argument("colour probes", self.max_probes, "at least 2"));
        }
        let [left, top, right, bottom] = self.patch;
        let inside = |a: f32, b: f32| 0.0 <= a && a < b && b <= 1.0;
        let [x0, y0, x1, y1] = self.pixels();
        if !(inside(left, right) && inside(top, bottom)) || x0 >= x1 || y0 >= y1 {
            let found = format!("{left},{top},{right},{bottom}");
            return Err(RenderError::argument(
                "colour patch",
                found,
                "left < right and upper < lower in 0..1",
            ));
        }
        Ok(())
    }

    fn pixels(&self) -> [u32; 4] {
        self.patch.map(|share| (share * self.size as f32).round() as u32)
    }
}
