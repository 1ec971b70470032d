//! Rendering the frames that are due.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use hair_render::{Checkpoint, FrameReport, Metadata, RenderError, Rendered};

use super::watch::{Left, Watch};
use super::{Run, is_due};
use crate::schema::Precision;
use crate::stage::{self, Stage, View};
use crate::stamp::Stamp;
use crate::{Event, Picture, Step, StepKind, TurntableError, frame_file};

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
                    let pipeline = &plan.variants[variant].pipeline;
                    stage = Some(Stage::set(pipeline, &plan.base, self.reporter, &mut self.store)?);
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
        &self,
        variant: usize,
        stage: &mut Stage,
        frame: &DueFrame,
    ) -> Result<FrameReport, TurntableError> {
        let (path, digest) = (self.path(frame.step), frame.step.digest.as_str());
        let pipeline = &self.plan.variants[variant].pipeline;
        let View { scene, camera, frame_rate, exposure_seconds } = stage.view(frame.number)?;
        // The digest holds the pipeline's seed and the view: the noise of views must differ.
        let seed = frame.step.digest.number();
        let settings = stage::render_settings(&pipeline.render, seed, self.plan.options.threads);
        let extra = [("turntable", self.plan.name.clone()), ("azimuth", frame.azimuth.to_string())];
        let metadata = Metadata {
            command: self.plan.options.command.clone(),
            digest: digest.to_owned(),
            camera: Some(camera.at(0.5)),
            precision: match pipeline.render.precision {
                Precision::Float => hair_render::Precision::Float,
                Precision::Half => hair_render::Precision::Half,
            },
            frame_rate,
            exposure_seconds,
            extra: extra.into_iter().map(|(key, value)| (key.to_owned(), value)).collect(),
            ..Metadata::default()
        };
        let (checkpoint, snapshot) = (checkpoint_of(&path), self.snapshot_of(frame.step));
        let frames: Vec<(usize, usize)> = self.to_render.iter().map(|(&v, &left)| (v, left)).collect();
        let watch = Watch::new(
            self.reporter,
            &self.plan.options,
            (self.index, self.of),
            (checkpoint.clone(), snapshot.clone()),
            &metadata,
            Left { estimate: &self.estimate, variant, frames: &frames },
        );
        let render = |start| hair_render::render_from(scene, &camera, &settings, digest, start, &watch);
        let rendered = match render(self.start(&checkpoint, digest)) {
            Err(error @ RenderError::OtherCheckpoint { .. }) => {
                self.drop_checkpoint(&checkpoint, &error.to_string());
                render(None)
            }
            rendered => rendered,
        };
        match rendered? {
            Rendered::Done(picture) => {
                picture.write_exr(&path, &metadata).map_err(TurntableError::Write)?;
                for file in [&checkpoint, &snapshot] {
                    // Mostly there is none.
                    let _ = std::fs::remove_file(file);
                }
                self.reporter.picture(Picture::Finished, &picture);
                Ok(picture.report)
            }
            Rendered::Stopped(so_far) => {
                so_far.write(&checkpoint).map_err(TurntableError::Write)?;
                Err(TurntableError::Interrupted)
            }
        }
    }

    /// What an earlier run left of this frame.
    fn start(&self, path: &Path, digest: &str) -> Option<Checkpoint> {
        if !self.plan.options.resume || !path.exists() {
            return None;
        }
        match Checkpoint::read(path) {
            Ok(found) if found.digest() == digest => {
                let (spp, of) = (found.spp(), found.spp_asked());
                self.reporter.event(&Event::Resumed { spp, of });
                Some(found)
            }
            Ok(_) => {
                self.drop_checkpoint(path, "it is of other inputs or settings");
                None
            }
            Err(error) => {
                self.drop_checkpoint(path, &error.to_string());
                None
            }
        }
    }

    fn drop_checkpoint(&self, path: &Path, why: &str) {
        let name = path.strip_prefix(&self.plan.output).unwrap_or(path).display();
        let text = format!("{name}: the checkpoint is dropped, and the frame begun anew: {why}");
        self.reporter.event(&Event::Warning(&text));
        let _ = std::fs::remove_file(path);
    }

    /// Where a frame is shown while it is rendered: not beside the frames, where it would be taken for one.
    fn snapshot_of(&self, step: &Step) -> PathBuf {
        let inner = step.output.strip_prefix("frames").unwrap_or(&step.output);
        self.plan.output.join("snapshots").join(inner)
    }
}
