//! A frame read from the OpenEXR file it was written to.

use std::path::Path;

use glam::Vec3;

use crate::exr_read::{Attributes, Opened, Unreadable, floats, with_file};
use crate::frame_header::{MOST, header, motion};
use crate::{Aov, Frame, FrameHeader, FrameReport, RenderError};

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
