//! Frames that are there under another number or of another variant.

use std::collections::HashMap;
use std::path::Path;

use hair_render::FrameHeader;

use super::Run;
use crate::{State, Step, TurntableError};

impl<'a> Run<'a> {
    /// Copies frames that are there elsewhere; returns those that have to be rendered after all.
    ///
    /// A frame must not be written over while another still waits to be copied from it. Where frames wait for each
    /// other in a circle, one is given up and rendered.
    pub(super) fn move_frames(&mut self) -> Result<Vec<&'a Step>, TurntableError> {
        let source = |step: &'a Step| match &step.state {
            State::Elsewhere(path) => Some((step, path.as_path())),
            _ => None,
        };
        let mut waiting: Vec<(&Step, &Path)> = self.plan.frames().filter_map(source).collect();
        // How many wait to be copied from each file.
        let mut wanted: HashMap<&Path, usize> = HashMap::new();
        waiting.iter().for_each(|(_, from)| *wanted.entry(from).or_default() += 1);
        let mut given_up = Vec::new();
        while !waiting.is_empty() {
            let before = waiting.len();
            let mut still = Vec::new();
            for (step, from) in waiting {
                if wanted.get(self.path(step).as_path()).is_some_and(|&count| count > 0) {
                    still.push((step, from));
                    continue;
                }
                if !self.copy(step, from)? {
                    given_up.push(step);
                }
                wanted.entry(from).and_modify(|count| *count -= 1);
            }
            waiting = still;
            if waiting.len() == before
                && let Some((step, from)) = waiting.pop()
            {
                wanted.entry(from).and_modify(|count| *count -= 1);
                given_up.push(step);
            }
        }
        Ok(given_up)
    }

    /// False when the frame is there no more, or no more what it was: another process may work in this folder too.
    fn copy(&mut self, step: &Step, from: &Path) -> Result<bool, TurntableError> {
        self.stop_if_asked()?;
        let is_same = || FrameHeader::read(from).is_ok_and(|header| header.digest == step.digest.as_str());
        let Some(bytes) = is_same().then(|| std::fs::read(from).ok()).flatten() else { return Ok(false) };
        whole_file::write_whole(self.path(step), &bytes)?;
        self.made(step)?;
        Ok(true)
    }
}
