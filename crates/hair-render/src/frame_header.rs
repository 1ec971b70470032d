//! Reading a frame that was written to an OpenEXR file, and what its header says.

use std::collections::BTreeMap;
use std::path::Path;

use glam::Vec3;

use crate::exr_read::{Attributes, Opened, Unreadable, floats, with_file};
use crate::{Aov, Frame, FrameReport, MotionReport, RenderError};

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
    /// All other attributes that are text.
    pub extra: BTreeMap<String, String>,
}

/// Attributes that are told elsewhere than in `FrameHeader::extra`.
const OWN_TEXTS: [&str; 5] = ["digest", "seed", "command", "colorInteropID", "shutter"];

/// Counts are whole numbers up to here.
const MOST: f64 = 9_007_199_254_740_992.0;

impl FrameHeader {
    /// Reads the header alone; the pixels may still be damaged or missing.
    ///
    /// # Errors
    /// [`RenderError::Io`], or [`RenderError::InvalidPicture`] for what is no picture of this renderer.
    pub fn read(path: &Path) -> Result<FrameHeader, RenderError> {
        with_file(path, |opened| Ok(header(&opened.attributes())?))
    }
}

impl Frame {
    /// Reads a frame that [`Frame::write_exr`] wrote, to the bit where it was written in [`crate::Precision::Float`]:
    /// beauty, alpha, all passes and the figures. Layers that are no pass of this renderer are left out.
    ///
    /// # Errors
    /// [`RenderError::Io`], or [`RenderError::InvalidPicture`] for what is no picture of this renderer, or damaged.
    pub fn read_exr(path: &Path) -> Result<(Frame, FrameHeader), RenderError> {
        with_file(path, read)
    }
}

fn header(attributes: &Attributes) -> Result<FrameHeader, String> {
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
        extra: attributes.texts().filter(|(name, _)| !own(name)).collect(),
    })
}

/// Which pixels a channel goes to.
#[derive(Clone, Copy)]
enum Target {
    Beauty(usize),
    Alpha,
    Pass(usize, usize),
    Nothing,
}

fn read(opened: Opened) -> Result<(Frame, FrameHeader), Unreadable> {
    let header = header(&opened.attributes())?;
    let (window, [full_width, full_height]) = (opened.window, opened.size);
    let channels = opened.channels();
    let has = |name: &str| channels.iter().any(|(found, _)| found == name);
    let rgb = |prefix: &str| ["R", "G", "B"].map(|color| format!("{prefix}{color}"));
    let pass = |aov: Aov| rgb(&format!("{}.", aov.name()));
    let aovs: Vec<Aov> = Aov::ALL.into_iter().filter(|&aov| pass(aov).iter().any(|name| has(name))).collect();
    let needed = aovs.iter().flat_map(|&aov| pass(aov)).chain(rgb("")).chain(["A".to_owned()]);
    if let Some(missing) = needed.into_iter().find(|name| !has(name)) {
        return Err(format!("there is no channel `{missing}`").into());
    }
    let target = |name: &str| {
        let color = |names: &[String; 3]| names.iter().position(|own| own == name);
        let of_pass =
            || aovs.iter().enumerate().find_map(|(i, &aov)| Some(Target::Pass(i, color(&pass(aov))?)));
        if name == "A" { Some(Target::Alpha) } else { color(&rgb("")).map(Target::Beauty).or_else(of_pass) }
    };
    let targets: Vec<Target> =
        channels.iter().map(|(name, _)| target(name).unwrap_or(Target::Nothing)).collect();
    let report = report(&header, &opened.attributes(), window.count() as u64)?;
    let mut frame = Frame {
        width: window.width,
        height: window.height,
        cutout: window.cutout(full_width, full_height),
        beauty: vec![Vec3::ZERO; window.count()],
        alpha: vec![0.0; window.count()],
        passes: aovs.iter().map(|&aov| (aov, vec![Vec3::ZERO; window.count()])).collect(),
        report,
    };
    let width = window.width as usize;
    opened.lines(|channel, row, bytes| {
        let values = floats(bytes, channels[channel].1);
        let places = row * width..(row + 1) * width;
        let (pixels, color) = match targets[channel] {
            Target::Beauty(color) => (&mut frame.beauty, color),
            Target::Pass(pass, color) => (&mut frame.passes[pass].1, color),
            Target::Alpha => {
                frame.alpha[places].iter_mut().zip(values).for_each(|(alpha, value)| *alpha = value);
                return;
            }
            Target::Nothing => return,
        };
        pixels[places].iter_mut().zip(values).for_each(|(pixel, value)| pixel[color] = value);
    })?;
    Ok((frame, header))
}

fn report(header: &FrameHeader, attributes: &Attributes, pixels: u64) -> Result<FrameReport, String> {
    let count = |name: &str| match attributes.number(name) {
        Some(_) => attributes.needed(name, 0.0..=MOST).map(|value| value as u64),
        // Frames of versions that did not tell.
        None => Ok(0),
    };
    Ok(FrameReport {
        seconds: header.seconds,
        spp: header.spp,
        seed: header.seed,
        threads: header.threads,
        samples: pixels * u64::from(header.spp),
        closest_rays: count("closestRays")?,
        shadow_rays: count("shadowRays")?,
        rejected_samples: count("rejectedSamples")?,
        rel_mse: header.rel_mse,
        relative_error: header.relative_error,
        motion: motion(attributes)?,
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
