//! Rendering the frames that are due.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use hair_render::{FrameReport, Metadata};

use super::watch::Watch;
use super::{Run, is_due};
use crate::stage::{self, Stage, View};
use crate::stamp::Stamp;
use crate::{Event, Step, StepKind, TurntableError, frame_file};

/// A frame to be rendered.
pub(super) struct DueFrame<'a> {
    pub step: &'a Step,
    pub number: u32,
    pub azimuth: f64,
    /// What stood in its place when the run began.
    seen: Option<Stamp>,
}

/// The frames to be rendered, by variant.
pub(super) struct Due<'a>(BTreeMap<usize, Vec<DueFrame<'a>>>);

impl<'a> Due<'a> {
    pub fn of(&self, variant: usize) -> Option<&[DueFrame<'a>]> {
        self.0.get(&variant).map(Vec::as_slice)
    }
}

/// The checkpoint of a frame, beside it.
pub(super) fn checkpoint_of(frame: &Path) -> PathBuf {
    let stem = frame.file_stem().unwrap_or_default().to_string_lossy();
    frame.with_file_name(format!(".{stem}.part.exr"))
}

impl<'a> Run<'a> {
    /// Moves frames that are there elsewhere; the others have to be rendered.
    pub(super) fn due_frames(&mut self) -> Result<Due<'a>, TurntableError> {
        let mut steps: Vec<&Step> = self.move_frames()?;
        steps.extend(self.plan.frames().filter(|step| is_due(step)));
        let mut due: BTreeMap<usize, Vec<DueFrame>> = BTreeMap::new();
        for step in steps {
            let (StepKind::Frame { number, azimuth }, Some(variant)) = (step.kind, step.variant) else {
                continue;
            };
            let seen = Stamp::of(&self.path(step));
            due.entry(variant).or_default().push(DueFrame { step, number, azimuth, seen });
        }
        due.values_mut().for_each(|frames| frames.sort_by_key(|frame| frame.number));
        self.to_render = due.iter().map(|(&variant, frames)| (variant, frames.len())).collect();
        self.of = due.values().map(Vec::len).sum::<usize>() as u32;
        Ok(Due(due))
    }

    /// Renders frames of one variant. One that cannot be made does not keep the next from being made.
    pub(super) fn frames(&mut self, variant: usize, frames: &[DueFrame<'a>]) -> Result<(), TurntableError> {
        self.stop_if_asked()?;
        let plan = self.plan;
        let mut stage: Option<Stage> = None;
        for frame in frames {
            self.stop_if_asked()?;
            if self.is_done_meanwhile(frame) {
                self.manifest.adopt(&frame.step.output, frame.step.digest.as_str())?;
                self.reporter.event(&Event::FoundDone(&frame.step.output));
                self.found_done += 1;
            } else {
                if stage.is_none() {
                    stage = Some(Stage::set(&plan.variants[variant].pipeline, &plan.base, self.reporter)?);
                }
                let Some(stage) = &mut stage else { continue };
                let result = self.frame(variant, stage, frame);
                self.go_on_without(&[frame.step], result)?;
            }
            self.index += 1;
            if let Some(left) = self.to_render.get_mut(&variant) {
                *left -= 1;
            }
            let left = self.to_render.iter().map(|(&variant, &left)| (variant, left));
            if let Some(seconds) = self.estimate.left(left) {
                self.reporter.event(&Event::Left(seconds));
            }
        }
        Ok(())
    }

    /// Whether another process put the frame in its place since this run began.
    fn is_done_meanwhile(&self, frame: &DueFrame) -> bool {
        let path = self.path(frame.step);
        let now = Stamp::of(&path);
        now.is_some()
            && now != frame.seen
            && frame_file::whole_header(&path).is_some_and(|h| h.digest == frame.step.digest.as_str())
            && frame_file::unpacks(&path)
    }

    fn frame(&mut self, variant: usize, stage: &mut Stage, frame: &DueFrame) -> Result<(), TurntableError> {
        let (number, index, of) = (frame.number, self.index, self.of);
        let id = self.plan.variants[variant].id.as_str();
        self.reporter.event(&Event::FrameBegins { variant: id, number, index, of });
        let report = self.render(variant, stage, frame)?;
        self.made(frame.step)?;
        self.rendered.insert(frame.step.output.clone());
        self.estimate.add(variant, report.seconds);
        let (seconds, relative_error) = (report.seconds, report.relative_error);
        self.reporter.event(&Event::FrameDone { variant: id, number, index, of, seconds, relative_error });
        if report.rejected_samples > 0 {
            let (frame, count) = (frame.step.output.display(), report.rejected_samples);
            self.reporter.event(&Event::Warning(&format!("{frame}: {count} samples were not finite")));
        }
        Ok(())
    }

    fn render(
        &mut self,
        variant: usize,
        stage: &mut Stage,
        frame: &DueFrame,
    ) -> Result<FrameReport, TurntableError> {
        let pipeline = &self.plan.variants[variant].pipeline;
        let View { scene, camera, frame_rate, exposure_seconds } = stage.view(frame.number)?;
        // The digest holds the pipeline's seed and the view: the noise of views must differ.
        let seed = frame.step.digest.number();
        let settings = stage::render_settings(&pipeline.render, seed, self.plan.options.threads);
        let watch = Watch { reporter: self.reporter, index: self.index, of: self.of };
        let picture =
            hair_render::render_moving(scene, &camera, &settings, &watch).map_err(|error| match error {
                hair_render::RenderError::Cancelled => TurntableError::Interrupted,
                other => other.into(),
            })?;
        let extra = [("turntable", self.plan.name.clone()), ("azimuth", frame.azimuth.to_string())];
        let metadata = Metadata {
            command: self.plan.options.command.clone(),
            digest: frame.step.digest.as_str().to_owned(),
            camera: Some(camera.at(0.5)),
            frame_rate,
            exposure_seconds,
            extra: extra.into_iter().map(|(key, value)| (key.to_owned(), value)).collect(),
            ..Metadata::default()
        };
        picture.write_exr(&self.path(frame.step), &metadata).map_err(TurntableError::Write)?;
        Ok(picture.report)
    }
}
