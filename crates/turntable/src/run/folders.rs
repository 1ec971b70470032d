//! Room for what is due, and what killed runs left behind.

use std::collections::BTreeSet;
use std::path::Path;

use hair_render::checkpoint_path;

use super::Run;
use crate::{Event, State, TurntableError};

impl Run<'_> {
    /// Makes the folders of what is due and clears what killed runs left in those that are there.
    pub(super) fn make_folders(&self) -> Result<(), TurntableError> {
        let output = &self.plan.output;
        let make = |folder: &Path| {
            std::fs::create_dir_all(folder).map_err(|e| TurntableError::io(folder, "make the folder", e))
        };
        make(output)?;
        whole_file::clear_stale_in(output);
        let mut seen = BTreeSet::from([output.clone()]);
        for step in
            self.plan.steps().iter().filter(|s| !matches!(s.state, State::NotAsked | State::Waiting(_)))
        {
            let path = self.path(step);
            let folder = path.parent().unwrap_or(output);
            if !seen.contains(folder) {
                if step.state != State::UpToDate {
                    make(folder)?;
                }
                // What is up to date now may have been half written by others before.
                whole_file::clear_stale_in(folder);
                seen.insert(folder.to_owned());
            }
            if super::is_frame(step) && step.state == State::UpToDate {
                // A slower process may have left it.
                let _ = std::fs::remove_file(checkpoint_path(&path));
            }
        }
        Ok(())
    }

    /// Whoever takes all of `frames/*.exr` for the turntable would be surprised by these.
    pub(super) fn warn_of_left_over(&self) {
        let left = self.plan.left_over();
        if let (Some(first), count) = (left.first(), left.len()) {
            let (folder, first) = (self.plan.output.display(), first.display());
            let text = format!(
                "{folder}: {count} frames are none of this turntable's, from {first} on; nothing uses them"
            );
            self.reporter.event(&Event::Warning(&text));
        }
    }
}
