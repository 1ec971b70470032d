//! Making what a plan says is missing.

mod convert;
mod estimate;
mod folders;
mod frames;
mod moves;
mod one_frame;
mod others;
mod outputs;
mod reports;
mod watch;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Instant;

use estimate::Estimate;
use frames::{Due, OfOthers};

use crate::manifest::Manifest;
use crate::stage::Store;
use crate::{Event, Failure, Plan, Reporter, State, Step, StepKind, Summary, TurntableError};

impl Plan {
    /// Makes whatever is not up to date; loads grooms and builds scenes only if something needs them.
    ///
    /// What cannot be made is named in [`Summary::failed`] and the rest is made, unless [`crate::Options::fail_fast`].
    ///
    /// # Errors
    /// A [`TurntableError`] that leaves nothing to go on with, as a folder that cannot be written to; outputs finished
    /// before it stay, each of them whole. Asked to stop, it ends with [`TurntableError::Interrupted`]; the frame being
    /// rendered then has a checkpoint beside it.
    pub fn run(&self, reporter: &dyn Reporter) -> Result<Summary, TurntableError> {
        let start = Instant::now();
        let mut run = Run::new(self, reporter);
        let result = run.all();
        // However it ended, what was made is known to the next run.
        let closed = run.manifest.close();
        result?;
        closed?;
        let lines = run.frame_lines();
        run.report(&lines)?;
        let kept = self.steps().iter().filter(|s| s.state == State::UpToDate).count();
        Ok(Summary {
            output: self.output.clone(),
            made: run.made,
            up_to_date: kept + run.found_done,
            failed: run.failed,
            frames: lines,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn frames(&self) -> impl Iterator<Item = &Step> {
        self.steps().iter().filter(|s| is_frame(s))
    }
}

fn is_frame(step: &Step) -> bool {
    matches!(step.kind, StepKind::Frame { .. })
}

fn is_due(step: &Step) -> bool {
    matches!(step.state, State::Missing | State::Stale)
}

/// One run of a plan.
struct Run<'a> {
    plan: &'a Plan,
    reporter: &'a dyn Reporter,
    manifest: Manifest,
    /// What variants have in common.
    store: Store,
    made: Vec<PathBuf>,
    /// The frames among them that were rendered.
    rendered: BTreeSet<PathBuf>,
    failed: Vec<Failure>,
    /// Outputs that other processes made meanwhile.
    found_done: usize,
    estimate: Estimate,
    /// Frames left to render, by variant.
    to_render: BTreeMap<usize, usize>,
    /// Frames dealt with, of those to render.
    index: u32,
    /// Frames to render.
    of: u32,
}

impl<'a> Run<'a> {
    fn new(plan: &'a Plan, reporter: &'a dyn Reporter) -> Self {
        Run {
            plan,
            reporter,
            manifest: Manifest::open(&plan.output, plan.options.verify),
            store: Store::default(),
            made: Vec::new(),
            rendered: BTreeSet::new(),
            failed: Vec::new(),
            found_done: 0,
            estimate: Estimate::default(),
            to_render: BTreeMap::new(),
            index: 0,
            of: 0,
        }
    }

    fn all(&mut self) -> Result<(), TurntableError> {
        self.make_folders()?;
        self.warn_of_left_over();
        self.manifest.tidy()?;
        self.manifest.record_inputs(&self.plan.inputs)?;
        for (output, digest) in &self.plan.read {
            self.manifest.adopt(output, digest)?;
        }
        let due = self.due_frames()?;
        let mut put_off = Due::new();
        for variant in 0..self.plan.variants.len() {
            self.convert(variant)?;
            if let Some(frames) = due.get(&variant) {
                put_off.insert(variant, self.frames(variant, frames, OfOthers::PutOff)?);
            }
        }
        for (variant, frames) in put_off {
            self.frames(variant, &frames, OfOthers::Render)?;
        }
        self.outputs()
    }

    /// Makes the converted files that are due of one variant.
    fn convert(&mut self, variant: usize) -> Result<(), TurntableError> {
        let own = self.plan.steps().iter().filter(|s| s.variant == Some(variant));
        let converts: Vec<&Step> = own.filter(|s| s.kind == StepKind::Convert && is_due(s)).collect();
        if !converts.is_empty() {
            let result = self.converts(variant, &converts);
            self.go_on_without(&converts, result)?;
        }
        Ok(())
    }

    fn path(&self, step: &Step) -> PathBuf {
        self.plan.output.join(&step.output)
    }

    /// Tells that an output was put in its place, and writes it down.
    fn made(&mut self, step: &Step) -> Result<(), TurntableError> {
        self.manifest.record(&step.output, &step.digest)?;
        self.tell_made(&step.output);
        Ok(())
    }

    fn tell_made(&mut self, output: &Path) {
        self.made.push(output.to_owned());
        self.reporter.event(&Event::Made(output));
    }

    /// What could not be made is remembered; only what would keep all else from being made ends the run.
    fn go_on_without<T>(
        &mut self,
        steps: &[&Step],
        result: Result<T, TurntableError>,
    ) -> Result<Option<T>, TurntableError> {
        match result {
            Ok(value) => Ok(Some(value)),
            Err(error) if self.plan.options.fail_fast || error.ends_all() => Err(error),
            Err(error) => {
                let outputs = steps.iter().map(|step| step.output.clone());
                let outputs = outputs.filter(|output| !self.made.contains(output)).collect();
                let failure = Failure { outputs, error: error.to_string() };
                self.reporter.event(&Event::Failed(&failure));
                self.failed.push(failure);
                Ok(None)
            }
        }
    }

    fn stop_if_asked(&self) -> Result<(), TurntableError> {
        let late = self.plan.options.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        if late || self.reporter.cancelled() { Err(TurntableError::Interrupted) } else { Ok(()) }
    }
}
