//! What the header of a frame's OpenEXR file says.

use std::collections::BTreeMap;
use std::path::Path;

use glam::Mat4;

use crate::exr_read::{Attributes, with_file};
use crate::{MotionReport, RenderError};

/// What a frame's file says about how it was made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameHeader {
    /// Digest of everything the picture depends on; empty where none was given.
    pub digest: String,
    /// Samples a pixel.
    pub spp: u32,
    /// The seed it was made from.
    pub seed: u64,
    /// Threads that worked on it.
    pub threads: usize,
    /// Seconds it took to render.
    pub seconds: f64,
    /// Estimated relMSE; `None` below 2 samples a pixel.
    pub rel_mse: Option<f64>,
    /// Estimated relative error; `None` below 2 samples a pixel.
    pub relative_error: Option<f64>,
    /// The program that made it.
    pub software: String,
    /// The command line that made it.
    pub command: String,
    /// Frames a second, where there is more than one.
    pub frame_rate: Option<f64>,
    /// Seconds that the shutter was open, where that was told.
    pub exposure_seconds: Option<f64>,
    /// `worldToCamera` and `worldToNDC`, where the camera was told, as [`crate::Camera`] has them.
    pub matrices: Option<[Mat4; 2]>,
    /// All other attributes that are text.
    pub extra: BTreeMap<String, String>,
}

/// Attributes that are told elsewhere than in `FrameHeader::extra`.
const OWN_TEXTS: [&str; 5] = ["digest", "seed", "command", "colorInteropID", "shutter"];

/// Counts are whole numbers up to here.
pub(crate) const MOST: f64 = 9_007_199_254_740_992.0;

impl FrameHeader {
    /// Reads the header alone; the pixels may still be damaged or missing.
    ///
    /// # Errors
    /// [`RenderError::Io`], or [`RenderError::InvalidPicture`] for what is no picture of this renderer.
    pub fn read(path: &Path) -> Result<FrameHeader, RenderError> {
        with_file(path, |opened| Ok(header(&opened.attributes())?))
    }
}

pub(crate) fn header(attributes: &Attributes) -> Result<FrameHeader, String> {
    let seed = attributes.text("seed").unwrap_or_default();
    let text = |name: &str| attributes.text(name).unwrap_or_default();
    let own = |name: &String| OWN_TEXTS.contains(&name.as_str());
    Ok(FrameHeader {
        digest: text("digest"),
        spp: attributes.needed("spp", 0.0..=f64::from(u32::MAX))? as u32,
        seed: seed.parse().map_err(|_| format!("attribute `seed` is `{seed}`, expected a whole number"))?,
        threads: attributes.needed("threads", 0.0..=MOST)? as usize,
        seconds: attributes.needed("seconds", 0.0..=f64::MAX)?,
        rel_mse: attributes.number("relMSE"),
        relative_error: attributes.number("relativeError"),
        software: attributes.software(),
        command: text("command"),
        frame_rate: attributes.frame_rate(),
        exposure_seconds: attributes.exposure_seconds(),
        matrices: attributes.matrices(),
        extra: attributes.texts().filter(|(name, _)| !own(name)).collect(),
    })
}

/// What moved, as `put_figures` writes it.
pub(crate) fn motion(attributes: &Attributes) -> Result<Option<MotionReport>, String> {
    let Some(shutter) = attributes.text("shutter") else { return Ok(None) };
    let parts = || {
        let (times, shape) = shutter.split_once(' ')?;
        let (open, close) = times.split_once(':')?;
        Some((open.parse().ok()?, close.parse().ok()?, shape.to_owned()))
    };
    let (shutter_open, shutter_close, shutter_shape) = parts()
        .ok_or_else(|| format!("attribute `shutter` is `{shutter}`, expected opening:closing shape"))?;
    let keys = |name: &str| match attributes.number(name) {
        Some(_) => attributes.needed(name, 0.0..=65_536.0).map(|keys| Some(keys as usize)),
        None => Ok(None),
    };
    let (keys, camera_keys) = (keys("motionKeys")?, keys("cameraKeys")?);
    Ok(Some(MotionReport { shutter_open, shutter_close, shutter_shape, keys, camera_keys }))
}
