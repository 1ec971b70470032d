//! The frames in figures.

use std::path::Path;

use hair_render::FrameHeader;

use super::Run;
use crate::{FrameLine, Phase, Step, StepKind, TurntableError, report};

impl Run<'_> {
    /// The frames asked for that are there, as their own headers tell.
    pub(super) fn frame_lines(&self) -> Vec<FrameLine> {
        let line = |step: &Step| {
            let StepKind::Frame { number, azimuth } = step.kind else { return None };
            let header = FrameHeader::read(&self.path(step)).ok()?;
            let FrameHeader { digest, spp, seconds, relative_error, threads, .. } = header;
            (digest == step.digest.as_str()).then_some(FrameLine {
                variant: self.plan.variants.get(step.variant?)?.id.clone(),
                number,
                file: step.output.clone(),
                azimuth,
                rendered: self.rendered.contains(&step.output),
                spp,
                threads,
                seconds,
                relative_error,
            })
        };
        self.plan.frames().filter_map(line).collect()
    }

    /// Writes the error report when it would say something new.
    pub(super) fn report(&mut self, lines: &[FrameLine]) -> Result<(), TurntableError> {
        if !self.plan.options.wants(Phase::Outputs) {
            return Ok(());
        }
        let report = report::of_frames(&self.plan.name, &self.plan.variants, lines);
        for (name, text) in [("report.json", report.to_json()?), ("report.html", report.to_html()?)] {
            let path = self.plan.output.join(name);
            if std::fs::read_to_string(&path).is_ok_and(|old| old == text) {
                continue;
            }
            whole_file::write_whole(&path, text.as_bytes())?;
            self.tell_made(Path::new(name));
        }
        Ok(())
    }
}
