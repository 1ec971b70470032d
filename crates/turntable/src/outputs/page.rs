//! The page that shows the result.

use std::collections::BTreeMap;

use error_report::{Point, Report, Series};
use flip_page::{Axis, Curve, Page, Plate, Shot, Tone, Variant as Shown};
use frame_comp::{Background, Fit, Meaning};
use glam::Vec3;
use hair_render::{Aov, Backdrop, Frame, FrameHeader};

use super::look::Look;
use super::parameters::parameters;
use super::{Asked, Finished, Wanted, facts};
use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::left_out::left_out;
use crate::schema::{Pipeline, ToneCurve};
use crate::{Event, Step, StepKind, TurntableError};

/// Bytes that the passes of a page may take, about; above, those of every second, third, ... frame are kept.
const MOST_BYTES: u64 = 64_000_000;

/// The layer of what is in no pass that was asked for.
const OTHER: &str = "other light";

/// The layer of a plate of light.
const PLATE: &str = "plate";

pub(super) fn wanted(asked: &Asked) -> Result<Option<Wanted>, TurntableError> {
    let Some(page) = asked.variants.first().and_then(|v| v.pipeline.page.as_ref()) else { return Ok(None) };
    let mut digest = Ingredients::of("page").settings(page);
    for Variant { id, axes, pipeline } in asked.variants {
        // All parameters are on it.
        digest = Look::added(digest.word(id).settings(axes).settings(pipeline), pipeline, asked.base)?;
    }
    let digest = asked.frames.iter().fold(digest, |digest, frame| digest.digest(&frame.digest)).finish();
    let needs = (0..asked.frames.len()).collect();
    Ok(Some(Wanted { variant: None, kind: StepKind::Page, output: page.file.clone(), digest, needs }))
}

pub(super) fn make(step: &Step, finished: &Finished) -> Result<bool, TurntableError> {
    let Some(Variant { pipeline, .. }) = finished.variants.first() else { return Ok(false) };
    let Some(settings) = &pipeline.page else { return Ok(false) };
    finished.reporter.event(&Event::Stage("making the page"));
    let looks: Result<Vec<Look>, _> =
        finished.variants.iter().map(|variant| Look::of(&variant.pipeline, finished.base)).collect();
    let mut making = Making {
        finished,
        looks: looks?,
        size: settings.size,
        passes: if settings.passes { passes(finished.variants) } else { Vec::new() },
        every: 1,
        headers: Vec::new(),
    };
    let mut page = making.page(pipeline)?;
    for (index, frame) in finished.frames.iter().enumerate() {
        if finished.reporter.cancelled() {
            return Err(TurntableError::Interrupted);
        }
        making.shot(&mut page, index, frame)?;
    }
    let page = making.finished(page);
    page.write(&finished.output.join(&step.output))?;
    Ok(true)
}

/// The layers that frames are taken apart into: every pass that some variant asks for, and what is left.
fn passes(variants: &[Variant]) -> Vec<String> {
    let asks = |aov: &Aov| {
        let names = variants.iter().flat_map(|variant| &variant.pipeline.render.aovs);
        names.into_iter().any(|name| name.eq_ignore_ascii_case("all") || Aov::from_name(name) == Some(*aov))
    };
    let mut passes: Vec<String> =
        Aov::ALL.into_iter().filter(asks).map(|aov| aov.name().to_owned()).collect();
    if !passes.is_empty() {
        // The page leaves out what is black in all frames.
        passes.extend([OTHER.to_owned(), PLATE.to_owned()]);
    }
    passes
}

struct Making<'a> {
    finished: &'a Finished<'a>,
    looks: Vec<Look>,
    size: u32,
    passes: Vec<String>,
    /// Passes are kept of every so many frames.
    every: usize,
    headers: Vec<(usize, u32, FrameHeader)>,
}

impl Making<'_> {
    /// The page without its frames.
    fn page(&self, pipeline: &Pipeline) -> Result<Page, TurntableError> {
        let tone = self.tone(pipeline)?;
        let names: Vec<&str> = self.passes.iter().map(String::as_str).collect();
        let weights: BTreeMap<String, f32> = self
            .looks
            .first()
            .map(|look| {
                look.weights.changed().map(|(pass, factor)| (pass.name().to_owned(), factor)).collect()
            })
            .unwrap_or_default();
        let mut page = Page::new(format!("Turntable {}", self.finished.name), tone, &names)
            .with_axes(axes(self.finished.variants))
            .with_weights(weights)
            .with_rate(pipeline.video.first().map_or(12.0, |video| video.fps));
        for Variant { id, axes, pipeline } in self.finished.variants {
            let settings = axes.iter().map(|(_, setting)| setting.clone()).collect();
            page.variant(Shown { id: id.clone(), settings, parameters: parameters(pipeline) });
        }
        Ok(page)
    }

    /// The first variant's tone: what is behind a plate that is to be seen as it is.
    fn tone(&self, pipeline: &Pipeline) -> Result<Tone, TurntableError> {
        let look = self.looks.first();
        let plate = match look.and_then(|look| look.plate.as_ref()) {
            Some(background @ Background::Plate(plate)) if plate.meaning() == Meaning::Display => {
                let (width, height) = self.sized(pipeline.render.width, pipeline.render.height);
                let empty = Frame::empty(width, height);
                let mapping = look.map(|look| look.mapping).unwrap_or_default();
                let rgba = frame_comp::shown(&empty, Some(background), Fit::Fill, &mapping).rgba;
                Some(Plate::new(width, height, &without_alpha(&rgba))?)
            }
            _ => None,
        };
        let mapping = look.map(|look| look.mapping).unwrap_or_default();
        let backdrop = match mapping.backdrop {
            Backdrop::Solid(color) => color.to_array(),
            Backdrop::Transparent => [0.0; 3],
        };
        let curve = match pipeline.tone.curve {
            ToneCurve::Neutral => Curve::Neutral,
            ToneCurve::Clip => Curve::Clip,
        };
        Ok(Tone { exposure: mapping.exposure, curve, backdrop, plate })
    }

    fn sized(&self, width: u32, height: u32) -> (u32, u32) {
        frame_comp::smaller_size(width, height, self.size)
    }

    fn shot(&mut self, page: &mut Page, index: usize, frame: &Step) -> Result<(), TurntableError> {
        let StepKind::Frame { number, .. } = frame.kind else { return Ok(()) };
        let Some((place, look)) = frame.variant.and_then(|v| Some((v, self.looks.get(v)?))) else {
            return Ok(());
        };
        let (frame, header) = Frame::read_exr(&self.finished.output.join(&frame.output))?;
        let small = frame_comp::smaller(&frame, self.size);
        let shown = look.shown(&frame_comp::reweigh(&small, &look.weights)?);
        let keeps = !self.passes.is_empty() && index.is_multiple_of(self.every);
        let (layers, alpha) =
            if keeps { self.layers(&small, look) } else { (Vec::new(), small.alpha.clone()) };
        let slices: Vec<&[[f32; 3]]> = layers.iter().map(Vec::as_slice).collect();
        let mut said = Vec::new();
        if let Some(error) = header.relative_error {
            said.push(("relative error".to_owned(), facts::percent(error)));
        }
        said.push(("seconds".to_owned(), facts::seconds(header.seconds)));
        said.push(("samples a pixel".to_owned(), format!("{} spp", header.spp)));
        page.shot(
            place,
            &Shot {
                number,
                facts: said,
                width: small.width,
                height: small.height,
                shown: &without_alpha(&shown.rgba),
                alpha: &alpha,
                layers: keeps.then_some(slices.as_slice()),
            },
        )?;
        self.headers.push((place, number, header));
        if index == 0 {
            // The first frame tells what the others will take.
            let all = page.bytes().layers.saturating_mul(self.finished.frames.len() as u64);
            self.every = usize::try_from(all.div_ceil(MOST_BYTES)).unwrap_or(usize::MAX).max(1);
        }
        Ok(())
    }

    /// The frame's layers in the page's order, and how much of it they cover.
    fn layers(&self, frame: &Frame, look: &Look) -> (Vec<Vec<[f32; 3]>>, Vec<f32>) {
        let over = match &look.plate {
            Some(background @ Background::Plate(plate)) if plate.meaning() == Meaning::Light => {
                Some(frame_comp::behind(frame, background, Fit::Fill))
            }
            _ => None,
        };
        let brightest = frame.beauty.iter().map(|pixel| pixel.max_element()).fold(0.0, f32::max);
        let layer = |name: &String| -> Vec<[f32; 3]> {
            let count = frame.beauty.len();
            match (name.as_str(), &over) {
                (OTHER, _) => {
                    let left = |index: usize| {
                        let passes =
                            frame.passes.iter().filter_map(|(_, pixels)| pixels.get(index)).sum::<Vec3>();
                        let left = frame.beauty[index] - passes;
                        // What rounding leaves is no light.
                        if left.max_element() > 1e-5 * brightest { left.to_array() } else { [0.0; 3] }
                    };
                    (0..count).map(left).collect()
                }
                (PLATE, Some(over)) => over
                    .beauty
                    .iter()
                    .zip(&frame.beauty)
                    .map(|(over, own)| (*over - *own).to_array())
                    .collect(),
                (PLATE, None) => vec![[0.0; 3]; count],
                (name, _) => {
                    let pixels = Aov::from_name(name).and_then(|aov| frame.pass(aov)).unwrap_or_default();
                    let mut pixels: Vec<[f32; 3]> = pixels.iter().map(Vec3::to_array).collect();
                    pixels.resize(count, [0.0; 3]);
                    pixels
                }
            }
        };
        let alpha = over.as_ref().map_or(&frame.alpha, |over| &over.alpha).clone();
        (self.passes.iter().map(layer).collect(), alpha)
    }

    /// The page with everything that its frames' headers tell.
    fn finished(&self, page: Page) -> Page {
        let left_out = left_out(self.finished.variants.iter().map(|variant| &variant.pipeline));
        let mut left_out: Vec<(String, String)> =
            left_out.map(|(what, why)| (what.to_owned(), why.to_owned())).collect();
        if self.every > 1 {
            let why = format!("passes of all frames would take more than {} MB", MOST_BYTES / 1_000_000);
            left_out.push((format!("passes of all but every {}th frame", self.every), why));
        }
        page.with_report(self.report()).with_left_out(left_out).with_about(self.about())
    }

    fn report(&self) -> Report {
        let mut report = Report::new(self.finished.name);
        for (place, variant) in self.finished.variants.iter().enumerate() {
            let label = if variant.id.is_empty() { "frames" } else { variant.id.as_str() };
            let reference =
                "the picture at infinitely many samples, estimated from two halves of the samples";
            // The error of a mean of independent samples falls as one over the root of their number.
            let mut series = Series::cases(label, "relative error", reference, 0.5);
            for (_, number, header) in self.headers.iter().filter(|(of, ..)| *of == place) {
                let Some(error) = header.relative_error else { continue };
                series.points.push(Point::new(format!("{label}, frame {number}"), header.seconds, error));
            }
            if !series.points.is_empty() {
                report = report.with_series(series);
            }
        }
        report
    }

    fn about(&self) -> Vec<(String, String)> {
        let mut about = vec![(
            "program".to_owned(),
            concat!("groomkit turntable ", env!("CARGO_PKG_VERSION")).to_owned(),
        )];
        if let Some((_, _, header)) = self.headers.first() {
            about.push(("command".to_owned(), header.command.clone()));
            about.push(("threads".to_owned(), header.threads.to_string()));
        }
        let seconds: f64 = self.headers.iter().map(|(_, _, header)| header.seconds).sum();
        about.push(("rendering".to_owned(), format!("{} in all", facts::seconds(seconds))));
        about
    }
}

/// What differs from variant to variant, as menus.
fn axes(variants: &[Variant]) -> Vec<Axis> {
    let mut axes: Vec<Axis> = Vec::new();
    for (index, (axis, setting)) in variants.iter().flat_map(|variant| variant.axes.iter().enumerate()) {
        if axes.len() <= index {
            axes.push(Axis { name: axis.clone(), settings: Vec::new() });
        }
        if !axes[index].settings.contains(setting) {
            axes[index].settings.push(setting.clone());
        }
    }
    axes
}

fn without_alpha(rgba: &[u8]) -> Vec<u8> {
    rgba.as_chunks::<4>().0.iter().flat_map(|[red, green, blue, _]| [*red, *green, *blue]).collect()
}
