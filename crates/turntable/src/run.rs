//! Making what a plan says is missing.

use std::path::{Path, PathBuf};
use std::time::Instant;

use groom::Groom;
use groom_formats::WriteOptions;
use hair_render::{FrameReport, Metadata, Progress};
use serde::Serialize;

use crate::frame_file::{self, FrameHeader};
use crate::manifest::Manifest;
use crate::outputs::{self, Finished};
use crate::schema::Pipeline;
use crate::stage::{self, Stage, View};
use crate::{Event, Plan, Reporter, State, Step, StepKind, TurntableError, report};

/// What a run made and how exact its frames are.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// The output folder.
    pub output: PathBuf,
    /// Files made by this run, inside the output folder.
    pub made: Vec<PathBuf>,
    /// How many outputs were up to date.
    pub up_to_date: usize,
    /// The frames that were asked for, made now or before.
    pub frames: Vec<FrameLine>,
    /// Seconds this run took.
    pub seconds: f64,
}

/// A frame in figures.
#[derive(Clone, Debug, Serialize)]
pub struct FrameLine {
    /// The variant it shows, by its id; empty where the pipeline has no `matrix`.
    pub variant: String,
    /// Number, from 1.
    pub number: u32,
    /// The EXR, inside the output folder.
    pub file: PathBuf,
    /// Azimuth of the camera, degrees.
    pub azimuth: f64,
    /// Whether this run rendered it.
    pub rendered: bool,
    /// Samples a pixel.
    pub spp: u32,
    /// Seconds it took to render, now or then.
    pub seconds: f64,
    /// Estimated relative error; none below 2 samples a pixel.
    pub relative_error: Option<f64>,
}

impl Plan {
    /// Makes whatever is not up to date; loads the groom and builds the scene only if something
    /// needs them.
    ///
    /// # Errors
    /// The first [`TurntableError`]; outputs finished before it stay, each of them whole. Asked to
    /// stop, it ends with [`TurntableError::Interrupted`].
    pub fn run(&self, reporter: &dyn Reporter) -> Result<Summary, TurntableError> {
        let start = Instant::now();
        let mut run = Run { plan: self, reporter, manifest: Manifest::open(&self.output), made: Vec::new() };
        run.make_folders()?;
        run.warn_of_left_over();
        let moved = run.move_frames()?;
        for variant in 0..self.variants.len() {
            run.variant(variant, &moved)?;
        }
        run.outputs()?;
        let lines = run.frame_lines();
        run.report(&lines)?;
        let up_to_date = self.steps().iter().filter(|s| s.state == State::UpToDate).count();
        let (output, made) = (self.output.clone(), run.made);
        Ok(Summary { output, made, up_to_date, frames: lines, seconds: start.elapsed().as_secs_f64() })
    }

    fn frames(&self) -> impl Iterator<Item = &Step> {
        self.steps().iter().filter(|s| matches!(s.kind, StepKind::Frame { .. }))
    }
}

fn is_due(step: &Step) -> bool {
    matches!(step.state, State::Missing | State::Stale)
}

fn needs_render(frame: &Step, moved: &[&Step]) -> bool {
    is_due(frame)
        || matches!(frame.state, State::Elsewhere(_)) && !moved.iter().any(|step| step.output == frame.output)
}

/// One run of a plan.
struct Run<'a> {
    plan: &'a Plan,
    reporter: &'a dyn Reporter,
    manifest: Manifest,
    made: Vec<PathBuf>,
}

impl<'a> Run<'a> {
    fn path(&self, step: &Step) -> PathBuf {
        self.plan.output.join(&step.output)
    }

    fn made(&mut self, output: &Path) {
        self.made.push(output.to_owned());
        self.reporter.event(&Event::Made(output));
    }

    fn stop_if_asked(&self) -> Result<(), TurntableError> {
        if self.reporter.cancelled() { Err(TurntableError::Interrupted) } else { Ok(()) }
    }

    /// Makes the folders of what is due and clears what killed runs left beside it.
    fn make_folders(&self) -> Result<(), TurntableError> {
        for step in self.plan.steps().iter().filter(|s| s.state != State::NotAsked) {
            let path = self.path(step);
            if step.state != State::UpToDate {
                let folder = path.parent().unwrap_or(&self.plan.output);
                std::fs::create_dir_all(folder)
                    .map_err(|e| TurntableError::io(folder, "make the folder", e))?;
            }
            whole_file::clear_stale(&path);
        }
        Ok(())
    }

    /// Whoever takes all of `frames/*.exr` for the turntable would be surprised by these.
    fn warn_of_left_over(&self) {
        let left = self.plan.left_over();
        if let (Some(first), count) = (left.first(), left.len()) {
            let (folder, first) = (self.plan.output.display(), first.display());
            let text = format!(
                "{folder}: {count} frames are none of this turntable's, from {first} on; nothing uses them"
            );
            self.reporter.event(&Event::Warning(&text));
        }
    }

    /// Copies frames that are there under another number; returns those that found their place.
    ///
    /// A frame must not be overwritten while another still waits to be copied from it. Where frames
    /// wait for each other in a circle, one is given up and rendered.
    fn move_frames(&mut self) -> Result<Vec<&'a Step>, TurntableError> {
        let source = |step: &'a Step| match &step.state {
            State::Elsewhere(path) => Some((step, path.as_path())),
            _ => None,
        };
        let mut waiting: Vec<(&Step, &Path)> = self.plan.frames().filter_map(source).collect();
        let mut moved = Vec::new();
        while !waiting.is_empty() {
            let is_free = |step: &Step| {
                !waiting.iter().any(|(other, from)| other.output != step.output && *from == self.path(step))
            };
            match waiting.iter().position(|(step, _)| is_free(step)) {
                Some(index) => {
                    let (step, from) = waiting.swap_remove(index);
                    let bytes = std::fs::read(from).map_err(|e| TurntableError::io(from, "read", e))?;
                    whole_file::write_whole(self.path(step), &bytes)?;
                    self.manifest.record(&step.output, &step.digest)?;
                    self.made(&step.output);
                    moved.push(step);
                }
                None => drop(waiting.pop()),
            }
        }
        Ok(moved)
    }

    /// Makes what is due of one variant: converted files and frames.
    fn variant(&mut self, index: usize, moved: &[&Step]) -> Result<(), TurntableError> {
        let plan = self.plan;
        let own = || plan.steps().iter().filter(|s| s.variant == Some(index));
        let converts: Vec<&Step> = own().filter(|s| s.kind == StepKind::Convert && is_due(s)).collect();
        let is_frame = |s: &&Step| matches!(s.kind, StepKind::Frame { .. });
        let frames: Vec<&Step> = own().filter(is_frame).filter(|f| needs_render(f, moved)).collect();
        let pipeline = &plan.variants[index].pipeline;
        if !converts.is_empty() {
            let groom = stage::groom(pipeline, &plan.base, self.reporter)?;
            self.convert(&groom, &converts)?;
        }
        if !frames.is_empty() {
            self.stop_if_asked()?;
            let mut stage = Stage::set(pipeline, &plan.base, self.reporter)?;
            self.render(&mut stage, pipeline, &frames)?;
        }
        Ok(())
    }

    fn convert(&mut self, groom: &Groom, steps: &[&Step]) -> Result<(), TurntableError> {
        for step in steps {
            self.stop_if_asked()?;
            let path = self.path(step);
            for warning in groom_formats::write(groom, &path, &WriteOptions::default())? {
                self.reporter.event(&Event::Warning(&format!("{}: {warning}", path.display())));
            }
            self.manifest.record(&step.output, &step.digest)?;
            self.made(&step.output);
        }
        Ok(())
    }

    fn render(
        &mut self,
        stage: &mut Stage,
        pipeline: &Pipeline,
        frames: &[&Step],
    ) -> Result<(), TurntableError> {
        for (index, step) in frames.iter().enumerate() {
            let StepKind::Frame { number, azimuth } = step.kind else { continue };
            self.stop_if_asked()?;
            let (index, of) = (index as u32, frames.len() as u32);
            self.reporter.event(&Event::FrameBegins { number, index, of });
            let watch = Watch { reporter: self.reporter, index, of };
            let report = self.render_frame(stage, pipeline, step, (number, azimuth), &watch)?;
            self.manifest.record(&step.output, &step.digest)?;
            self.made(&step.output);
            let (seconds, relative_error) = (report.seconds, report.relative_error);
            self.reporter.event(&Event::FrameDone { number, index, of, seconds, relative_error });
            if report.rejected_samples > 0 {
                let text = format!("frame {number}: {} samples were not finite", report.rejected_samples);
                self.reporter.event(&Event::Warning(&text));
            }
        }
        Ok(())
    }

    fn render_frame(
        &self,
        stage: &mut Stage,
        pipeline: &Pipeline,
        step: &Step,
        (number, azimuth): (u32, f64),
        watch: &Watch,
    ) -> Result<FrameReport, TurntableError> {
        let View { scene, camera, frame_rate, exposure_seconds } = stage.view(number)?;
        // The digest holds the pipeline's seed and the view.
        let seed = step.digest.number();
        let settings = stage::render_settings(&pipeline.render, seed, self.plan.options.threads);
        let frame =
            hair_render::render_moving(scene, &camera, &settings, watch).map_err(|error| match error {
                hair_render::RenderError::Cancelled => TurntableError::Interrupted,
                other => other.into(),
            })?;
        let extra = [("turntable", self.plan.name.clone()), ("azimuth", azimuth.to_string())];
        let metadata = Metadata {
            command: self.plan.options.command.clone(),
            digest: step.digest.as_str().to_owned(),
            camera: Some(camera.at(0.5)),
            frame_rate,
            exposure_seconds,
            extra: extra.into_iter().map(|(key, value)| (key.to_owned(), value)).collect(),
            ..Metadata::default()
        };
        frame.write_exr(&self.path(step), &metadata)?;
        Ok(frame.report)
    }

    /// Makes what is due of what is made of frames.
    fn outputs(&mut self) -> Result<(), TurntableError> {
        let plan = self.plan;
        let frames: Vec<&Step> = plan.frames().collect();
        let finished = Finished {
            output: &plan.output,
            variants: &plan.variants,
            frames: &frames,
            reporter: self.reporter,
        };
        let is_output = |kind: StepKind| !matches!(kind, StepKind::Convert | StepKind::Frame { .. });
        for step in plan.steps().iter().filter(|s| is_output(s.kind) && is_due(s)) {
            self.stop_if_asked()?;
            if outputs::make(step, &finished)? {
                self.manifest.record(&step.output, &step.digest)?;
                self.made(&step.output);
            }
        }
        Ok(())
    }

    /// The frames asked for that are there, as their own headers tell.
    fn frame_lines(&self) -> Vec<FrameLine> {
        let line = |step: &Step| {
            let StepKind::Frame { number, azimuth } = step.kind else { return None };
            let header = frame_file::header(&self.path(step))?;
            let FrameHeader { digest, spp, seconds, relative_error, .. } = header;
            let rendered = self.made.contains(&step.output) && !matches!(step.state, State::Elsewhere(_));
            let file = step.output.clone();
            let variant = self.plan.variants.get(step.variant?)?.id.clone();
            (digest == step.digest.as_str()).then_some(FrameLine {
                variant,
                number,
                file,
                azimuth,
                rendered,
                spp,
                seconds,
                relative_error,
            })
        };
        self.plan.frames().filter_map(line).collect()
    }

    /// Writes the error report when it would say something new.
    fn report(&mut self, lines: &[FrameLine]) -> Result<(), TurntableError> {
        let threads = self.plan.frames().find_map(|f| Some(frame_file::header(&self.path(f))?.threads));
        let report = report::of_frames(&self.plan.name, &self.plan.variants[0].pipeline, threads, lines);
        for (name, text) in [("report.json", report.to_json()?), ("report.html", report.to_html()?)] {
            let path = self.plan.output.join(name);
            if std::fs::read_to_string(&path).is_ok_and(|old| old == text) {
                continue;
            }
            whole_file::clear_stale(&path);
            whole_file::write_whole(&path, text.as_bytes())?;
            self.made(Path::new(name));
        }
        Ok(())
    }
}

/// Passes the renderer's progress on.
struct Watch<'a> {
    reporter: &'a dyn Reporter,
    index: u32,
    of: u32,
}

impl Progress for Watch<'_> {
    fn advance(&self, done: u64, total: u64) {
        let share = done as f64 / total.max(1) as f64;
        self.reporter.advance((f64::from(self.index) + share) / f64::from(self.of));
    }

    fn cancelled(&self) -> bool {
        self.reporter.cancelled()
    }
}
