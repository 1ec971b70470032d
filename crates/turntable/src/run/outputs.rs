//! What is made of frames.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::{Run, is_due};
use crate::outputs::{self, Finished};
use crate::{Event, Failure, State, Step, StepKind, TurntableError, explain};

impl Run<'_> {
    /// Makes what is due of what is made of frames.
    pub(super) fn outputs(&mut self) -> Result<(), TurntableError> {
        let plan = self.plan;
        let frames: Vec<&Step> = plan.frames().collect();
        let finished = Finished {
            name: &plan.name,
            base: &plan.base,
            output: &plan.output,
            variants: &plan.variants,
            frames: &frames,
            reporter: self.reporter,
        };
        let is_output = |kind: StepKind| !matches!(kind, StepKind::Convert | StepKind::Frame { .. });
        let lost: BTreeSet<PathBuf> = self.failed.iter().flat_map(|f| f.outputs.iter().cloned()).collect();
        for step in plan.steps() {
            if let State::Waiting(count) = step.state {
                let words = format!("{}: left out, {}", step.output.display(), explain::waits(count));
                self.reporter.event(&Event::Warning(&words));
            }
        }
        for step in plan.steps().iter().filter(|s| is_output(s.kind) && is_due(s)) {
            self.stop_if_asked()?;
            let lacks = step.needs.iter().filter_map(|&at| frames.get(at)).find(|f| lost.contains(&f.output));
            if let Some(frame) = lacks {
                let error = format!("needs {}, which could not be made", frame.output.display());
                self.failed.push(Failure { outputs: vec![step.output.clone()], error });
                continue;
            }
            let result = outputs::make(step, &finished);
            if self.go_on_without(&[step], result)? == Some(true) {
                self.made(step)?;
            }
        }
        Ok(())
    }
}
