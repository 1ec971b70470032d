//! The page that shows the result.

mod layers;
mod tone;
mod words;

use flip_page::{Axis, Page, Shot, Variant as Shown};
use hair_render::Frame;

use super::look::Look;
use super::parameters::parameters;
use super::{Asked, Finished, Wanted};
use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::{Event, FrameLine, Step, StepKind, TurntableError};
use layers::Layers;

/// Bytes that the passes of a page may take, about; above, those of every second, third, ... frame are kept.
const MOST_BYTES: u64 = 64_000_000;

/// Pictures a second where the pipeline asks for no film.
const RATE: f64 = 12.0;

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
    let mut making = Making {
        finished,
        looks: Look::all(finished.variants, finished.base)?,
        size: settings.size,
        passes: if settings.passes { layers::names(finished.variants) } else { Vec::new() },
        every: 1,
        command: None,
        lines: Vec::new(),
    };
    let rate = pipeline.video.first().map_or(RATE, |video| video.fps);
    let mut page = making.page(rate)?;
    for (index, frame) in finished.frames.iter().enumerate() {
        if finished.reporter.cancelled() {
            return Err(TurntableError::Interrupted);
        }
        making.shot(&mut page, index, frame)?;
    }
    making.told(page).write(&finished.output.join(&step.output))?;
    Ok(true)
}

struct Making<'a> {
    finished: &'a Finished<'a>,
    looks: Vec<Look>,
    size: u32,
    passes: Vec<String>,
    /// Passes are kept of every so many frames.
    every: usize,
    /// The command that made the first frame.
    command: Option<String>,
    lines: Vec<FrameLine>,
}

impl Making<'_> {
    /// The page without its frames.
    fn page(&self, rate: f64) -> Result<Page, TurntableError> {
        let names: Vec<&str> = self.passes.iter().map(String::as_str).collect();
        let mut page = Page::new(format!("Turntable {}", self.finished.name), &names)
            .with_axes(axes(self.finished.variants))
            .with_rate(rate);
        for (Variant { id, axes, pipeline }, look) in self.finished.variants.iter().zip(&self.looks) {
            let size = frame_comp::smaller_size(pipeline.render.width, pipeline.render.height, self.size);
            let weights = look.weights.changed().map(|(pass, factor)| (pass.name().to_owned(), factor));
            let shown = Shown {
                id: id.clone(),
                settings: axes.iter().map(|(_, setting)| setting.clone()).collect(),
                weights: weights.collect(),
                parameters: parameters(pipeline),
            };
            page.variant(shown, tone::tone(pipeline, look, size)?);
        }
        Ok(page)
    }

    fn shot(&mut self, page: &mut Page, index: usize, step: &Step) -> Result<(), TurntableError> {
        let StepKind::Frame { number, azimuth } = step.kind else { return Ok(()) };
        let Some((place, look)) = step.variant.and_then(|v| Some((v, self.looks.get(v)?))) else {
            return Ok(());
        };
        let (frame, header) = Frame::read_exr(&self.finished.output.join(&step.output))?;
        let small = frame_comp::smaller(&frame, self.size);
        let shown = look.shown(&frame_comp::reweigh(&small, &look.weights)?);
        let keeps = !self.passes.is_empty() && index.is_multiple_of(self.every);
        let layers = keeps.then(|| Layers::of(&small, look, &self.passes));
        let slices: Option<Vec<&[[f32; 3]]>> =
            layers.as_ref().map(|layers| layers.light.iter().map(Vec::as_slice).collect());
        page.shot(
            place,
            &Shot {
                number,
                facts: words::facts(&header),
                width: small.width,
                height: small.height,
                shown: &tone::without_alpha(&shown.rgba),
                alpha: layers.as_ref().map_or(&small.alpha, |layers| &layers.alpha),
                layers: slices.as_deref(),
            },
        )?;
        if index == 0 {
            // The first frame tells what the others will take.
            let all = page.bytes().layers.saturating_mul(self.finished.frames.len() as u64);
            self.every = usize::try_from(all.div_ceil(MOST_BYTES)).unwrap_or(usize::MAX).max(1);
        }
        self.command.get_or_insert(header.command);
        self.lines.push(FrameLine {
            variant: self.finished.variants.get(place).map(|variant| variant.id.clone()).unwrap_or_default(),
            number,
            file: step.output.clone(),
            azimuth,
            rendered: false,
            spp: header.spp,
            threads: header.threads,
            seconds: header.seconds,
            relative_error: header.relative_error,
        });
        Ok(())
    }

    /// The page with everything that its frames' headers tell.
    fn told(&self, page: Page) -> Page {
        let Finished { name, variants, .. } = *self.finished;
        page.with_report(words::report(name, variants, &self.lines))
            .with_left_out(words::what_is_left_out(variants, self.every, MOST_BYTES))
            .with_about(words::about(self.command.as_deref().unwrap_or_default(), &self.lines))
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
