//! `turntable comp`: finished frames put together anew.

use std::path::PathBuf;

use anyhow::Context as _;
use command_line::Outcome;
use frame_comp::{Background, Fit, Meaning, Plate, Weights, behind, outputs, residual, reweigh, shown};
use hair_render::{Backdrop, Curve, Frame, FrameHeader, Metadata, ToneMapping};
use serde::Serialize;

/// Weigh the passes of finished frames anew and put something behind them; nothing is rendered.
#[derive(Debug, clap::Args)]
pub struct CompArgs {
    /// Frames that were rendered, `.exr`
    #[arg(required = true, value_name = "FRAME")]
    frames: Vec<PathBuf>,

    /// What to write: `.exr` (light) or `.png` (as shown); for several frames `out.####.png`, which keeps their numbers
    #[arg(long, short, value_name = "FILE")]
    out: PathBuf,

    /// Factors on passes, 0..=1000, 1 for those not named: `TT=0.5,TRT=2`
    #[arg(long, value_name = "PASS=FACTOR,...", default_value = "", hide_default_value = true)]
    weight: Weights,

    /// What lies behind: a picture (`.png` and `.jpg` are seen as they are, `.exr` and `.hdr` are light), `#rrggbb`
    /// (sRGB) or `r,g,b` (linear Rec. 709) [default: nothing, the frame stays transparent]
    #[arg(long, value_name = "PICTURE|COLOR")]
    background: Option<String>,

    /// How a picture of another shape is brought behind the frame
    #[arg(long, default_value = "fill", value_parser = ["fill", "whole", "stretch"], requires = "background")]
    fit: String,

    /// Stops: each doubles the light
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true, value_name = "STOPS")]
    exposure: f32,

    /// How bright values are brought into a PNG [default: neutral]
    #[arg(long, value_parser = ["neutral", "clip"])]
    curve: Option<String>,

    /// Write what was done as JSON to standard output
    #[arg(long)]
    json: bool,
}

/// A frame that was put together.
#[derive(Serialize)]
struct Done {
    frame: PathBuf,
    out: PathBuf,
    /// Largest difference between the sum of the passes and the beauty, over the largest value.
    passes_off_by: f64,
    /// Share of the light that is in no pass.
    in_no_pass: f64,
    passes_missing: Vec<&'static str>,
}

pub fn run(args: &CompArgs) -> anyhow::Result<Outcome> {
    anyhow::ensure!(
        (-64.0..=64.0).contains(&args.exposure),
        "--exposure is {}, expected -64..=64 stops",
        args.exposure
    );
    let ending = args.out.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    anyhow::ensure!(
        ["exr", "png"].contains(&ending.as_str()),
        "{}: expected a name in .exr or .png",
        args.out.display()
    );
    let keeps_light = args.curve.is_some() && ending == "exr";
    anyhow::ensure!(!keeps_light, "--curve is for a .png; {} would hold light as it is", args.out.display());
    let named = outputs(&args.frames, &args.out)?;
    let background = args.background.as_deref().map(Background::read).transpose()?;
    let bar = command_line::progress_bar(args.frames.len() as u64, "putting together");
    let mut done = Vec::new();
    for (frame, out) in args.frames.iter().zip(named) {
        let (source, header) = Frame::read_exr(frame)?;
        if let (Some(Background::Plate(plate)), true) = (&background, done.is_empty()) {
            bar.say(&told(plate, &source, args.fit()));
        }
        let found = residual(&source);
        let missing: Vec<&str> = found.missing.iter().map(|pass| pass.name()).collect();
        if !source.passes.is_empty() {
            let lacking =
                if missing.is_empty() { String::new() } else { format!(" (no pass {})", missing.join(", ")) };
            bar.say(&format!(
                "{}: its passes add up to its beauty but for {:.2e} of its largest value{lacking}",
                frame.display(),
                found.relative
            ));
        }
        let weighed = reweigh(&source, &args.weight).with_context(|| frame.display().to_string())?;
        if ending == "png" {
            shown(&weighed, background.as_ref(), args.fit(), &args.mapping()).write_png(&out)?;
        } else {
            args.over(weighed, background.as_ref()).write_exr(&out, &args.metadata(header))?;
        }
        bar.inc(1);
        done.push(Done {
            frame: frame.clone(),
            out,
            passes_off_by: found.relative,
            in_no_pass: found.share,
            passes_missing: missing,
        });
    }
    bar.finish();
    if args.json {
        crate::json::print(&done)?;
    }
    Ok(Outcome::Good)
}

impl CompArgs {
    fn fit(&self) -> Fit {
        Fit::from_name(&self.fit).unwrap_or_default()
    }

    fn mapping(&self) -> ToneMapping {
        let curve = if self.curve.as_deref() == Some("clip") { Curve::Clip } else { Curve::Neutral };
        ToneMapping { exposure: self.exposure, curve, backdrop: Backdrop::Transparent }
    }

    /// The frame with what lies behind it, exposed: what is to be seen as it is comes after the exposure.
    fn over(&self, frame: Frame, background: Option<&Background>) -> Frame {
        match background {
            None => exposed(frame, self.exposure),
            Some(light) if light.meaning() == Meaning::Light => {
                exposed(behind(&frame, light, self.fit()), self.exposure)
            }
            Some(display) => behind(&exposed(frame, self.exposure), display, self.fit()),
        }
    }

    /// What the frame's file told, and what was done to it. It is no longer what its digest stands for.
    fn metadata(&self, header: FrameHeader) -> Metadata {
        let FrameHeader { mut extra, frame_rate, exposure_seconds, matrices, .. } = header;
        extra.insert("compWeights".into(), self.weight.to_string());
        if let Some(background) = &self.background {
            extra.insert("compBackground".into(), background.clone());
        }
        let command = command_line::words();
        Metadata { command, extra, frame_rate, exposure_seconds, matrices, ..Metadata::default() }
    }
}

/// What becomes of a plate in a frame.
fn told(plate: &Plate, frame: &Frame, fit: Fit) -> String {
    let ((width, height), fitted) = (plate.size(), plate.behind(frame, fit));
    let (across, down) = fitted.scale;
    let scale = if across == down { format!("{across:.3}") } else { format!("{across:.3} x {down:.3}") };
    let mut words = format!("the plate of {width} x {height} pixels is scaled by {scale}");
    if fitted.cut > 0.0 {
        words += &format!(", {:.1} % of it are cut", 100.0 * fitted.cut);
    }
    if fitted.bare > 0.0 {
        words += &format!(", {:.1} % of the frame stay black behind", 100.0 * fitted.bare);
    }
    words
}

/// The frame with all its light multiplied.
fn exposed(mut frame: Frame, stops: f32) -> Frame {
    let gain = stops.exp2();
    let passes = frame.passes.iter_mut().flat_map(|(_, pixels)| pixels);
    frame.beauty.iter_mut().chain(passes).for_each(|pixel| *pixel *= gain);
    frame
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use glam::Vec3;
    use hair_render::FrameReport;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        comp: CompArgs,
    }

    fn asked(words: &str) -> CompArgs {
        Line::try_parse_from(["comp", "a.exr", "-o", "b.exr"].into_iter().chain(words.split(' ')))
            .unwrap()
            .comp
    }

    /// Colours behind are seen as they are, at any exposure; light behind is exposed with the frame.
    #[test]
    fn the_exposure_is_for_light() {
        let (width, height, passes, report) = (1, 1, Vec::new(), FrameReport::default());
        let frame =
            Frame { width, height, cutout: None, beauty: vec![Vec3::ONE], alpha: vec![0.75], passes, report };
        let args = asked("--exposure 1 --background 0.4,0.4,0.4");
        let background = Background::read(args.background.as_deref().unwrap()).unwrap();
        let over = args.over(frame.clone(), Some(&background));
        assert!((over.beauty[0].x - 2.1).abs() < 1e-6 && over.alpha == [1.0], "{over:?}");
        let light = Plate::new(1, 1, vec![Vec3::splat(0.4)], Meaning::Light).map(Background::Plate);
        assert!((args.over(frame.clone(), light.as_ref()).beauty[0].x - 2.2).abs() < 1e-6);
        assert_eq!(args.over(frame, None).beauty, [Vec3::splat(2.0)]);
    }

    #[test]
    fn what_the_file_told_is_kept_but_for_its_digest() {
        let header = FrameHeader {
            digest: "old".into(),
            frame_rate: Some(24.0),
            exposure_seconds: Some(0.01),
            matrices: Some([glam::Mat4::IDENTITY; 2]),
            extra: [("frame".to_owned(), "7".to_owned())].into(),
            ..FrameHeader::default()
        };
        let told = asked("--weight TT=2").metadata(header);
        assert_eq!(
            (told.digest.as_str(), told.frame_rate, told.exposure_seconds),
            ("", Some(24.0), Some(0.01))
        );
        assert_eq!((told.extra["frame"].as_str(), told.extra["compWeights"].as_str()), ("7", "TT=2"));
        assert!(told.matrices.is_some());
    }
}
