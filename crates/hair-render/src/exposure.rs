//! Which ray belongs to a place on the film and a moment of the shutter.

use strand_tracing::Ray;

use crate::moving_camera::Lenses;
use crate::shutter_times::ShutterTimes;
use crate::{MovingCamera, Scene};

/// The camera and its shutter.
#[derive(Debug)]
pub(crate) struct Exposure {
    lenses: Lenses,
    /// None where nothing moves: all samples are then of one moment.
    times: Option<ShutterTimes>,
}

impl Exposure {
    /// Of a picture of `width` x `height` pixels.
    pub fn new(scene: &Scene, camera: &MovingCamera, width: u32, height: u32) -> Self {
        let lenses = camera.lenses(scene.center(), width, height);
        let moves = scene.motion_keys().is_some() || lenses.moves();
        let times = moves.then(|| ShutterTimes::new(scene.shutter().shape()));
        Exposure { lenses, times }
    }

    /// The camera ray through `x`, `y` of the picture, in pixels from its upper left corner, at the moment that
    /// `when`, a number in [0, 1), stands for.
    #[inline]
    pub fn ray(&self, x: f32, y: f32, when: f32) -> Ray {
        let time = self.times.as_ref().map_or(0.0, |times| times.at(when));
        let lens = self.lenses.at(time);
        Ray { origin: lens.origin, direction: lens.direction(x, y), t_max: f32::INFINITY, time }
    }
}
