//! Rendering a frame, from its checkpoint where there is one.

use std::path::{Path, PathBuf};

use hair_render::{Checkpoint, FrameReport, Metadata, RenderError, Rendered, checkpoint_path};

use super::Run;
use super::frames::DueFrame;
use super::watch::{Left, Watch};
use crate::schema::Precision;
use crate::stage::{self, Stage, View};
use crate::{Event, Picture, Step, TurntableError};

impl Run<'_> {
    /// Renders a frame and puts it in its place; of one that has to stop, the work so far is kept.
    pub(super) fn render(
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
        let (checkpoint, snapshot) = (checkpoint_path(&path), self.snapshot_of(frame.step));
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
