//! What a picture says about what moved in it.

use serde::Serialize;

use crate::{MovingCamera, Scene};

/// What moved while the shutter was open.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MotionReport {
    /// When the shutter opened, in frames relative to the frame.
    pub shutter_open: f64,
    /// When it closed, in frames relative to the frame.
    pub shutter_close: f64,
    /// How it opened and closed, as [`crate::ShutterShape`] is written.
    pub shutter_shape: String,
    /// The most keys of any groom or mesh that moved; `None` where only the camera did.
    pub keys: Option<usize>,
    /// Keys of the camera; `None` where it stood still.
    pub camera_keys: Option<usize>,
}

impl MotionReport {
    pub(crate) fn of(scene: &Scene, camera: &MovingCamera) -> Option<Self> {
        let (keys, camera_keys) = (scene.motion_keys(), camera.moves().then_some(camera.key_count()));
        let shutter = scene.shutter();
        (keys.is_some() || camera_keys.is_some()).then(|| MotionReport {
            shutter_open: shutter.open(),
            shutter_close: shutter.close(),
            shutter_shape: shutter.shape().to_string(),
            keys,
            camera_keys,
        })
    }
}
