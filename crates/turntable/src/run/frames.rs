//! Which frames are rendered, and in which order.

use std::collections::BTreeMap;

use hair_render::{Frame, FrameHeader};

use super::others::begun;
use super::{Run, is_due};
use crate::stage::Stage;
use crate::stamp::Stamp;
use crate::{Event, Step, StepKind, TurntableError};

/// A frame to be rendered.
#[derive(Clone, Copy)]
pub(super) struct DueFrame<'a> {
    pub step: &'a Step,
    pub number: u32,
    pub azimuth: f64,
    /// What stood in its place when the run began.
    seen: Option<Stamp>,
}

/// Frames to be rendered, by variant.
pub(super) type Due<'a> = BTreeMap<usize, Vec<DueFrame<'a>>>;

/// What to do about a frame that another run is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OfOthers {
    /// Leave it for later.
    PutOff,
    /// Render it all the same.
    Render,
}

impl<'a> Run<'a> {
    /// Moves frames that are there elsewhere; the others have to be rendered.
    pub(super) fn due_frames(&mut self) -> Result<Due<'a>, TurntableError> {
        let mut steps: Vec<&Step> = self.move_frames()?;
        steps.extend(self.plan.frames().filter(|step| is_due(step)));
        let mut due: Due = BTreeMap::new();
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
        Ok(due)
    }

    /// Renders frames of one variant; returns those that were put off. One that cannot be made does not keep the next
    /// from being made.
    pub(super) fn frames(
        &mut self,
        variant: usize,
        frames: &[DueFrame<'a>],
        of_others: OfOthers,
    ) -> Result<Vec<DueFrame<'a>>, TurntableError> {
        let plan = self.plan;
        let mut stage: Option<Stage> = None;
        let mut put_off = Vec::new();
        for (index, frame) in frames.iter().enumerate() {
            self.stop_if_asked()?;
            if self.is_done_meanwhile(frame) {
                self.manifest.adopt(&frame.step.output, frame.step.digest.as_str())?;
                self.reporter.event(&Event::FoundDone(&frame.step.output));
                self.found_done += 1;
                self.dealt_with(variant, 1);
                continue;
            }
            let Some(_begun) = begun(&self.path(frame.step), of_others)? else {
                put_off.push(*frame);
                continue;
            };
            if stage.is_none() {
                let pipeline = &plan.variants[variant].pipeline;
                let set = Stage::set(pipeline, &plan.base, self.reporter, &mut self.store);
                let left: Vec<&Step> =
                    frames[index..].iter().chain(&put_off).map(|frame| frame.step).collect();
                stage = self.go_on_without(&left, set)?;
                if stage.is_none() {
                    // Without a scene there is none of the variant's frames.
                    self.dealt_with(variant, left.len());
                    return Ok(Vec::new());
                }
            }
            let Some(stage) = &mut stage else { continue };
            let result = self.frame(variant, stage, frame);
            self.go_on_without(&[frame.step], result)?;
            self.dealt_with(variant, 1);
        }
        Ok(put_off)
    }

    /// Tells how far it is after `count` more frames of a variant, made or not.
    fn dealt_with(&mut self, variant: usize, count: usize) {
        self.index += count as u32;
        if let Some(left) = self.to_render.get_mut(&variant) {
            *left = left.saturating_sub(count);
        }
        self.reporter.advance(f64::from(self.index) / f64::from(self.of));
        let left = self.to_render.iter().map(|(&variant, &left)| (variant, left));
        if let Some(seconds) = self.estimate.left(left) {
            self.reporter.event(&Event::Left(seconds));
        }
    }

    /// Whether another process put the frame in its place since this run began.
    fn is_done_meanwhile(&self, frame: &DueFrame) -> bool {
        let path = self.path(frame.step);
        let now = Stamp::of(&path);
        now.is_some()
            && now != frame.seen
            && FrameHeader::read(&path).is_ok_and(|header| header.digest == frame.step.digest.as_str())
            && Frame::read_exr(&path).is_ok()
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
}
