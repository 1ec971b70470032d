//! The groom in other formats.

use groom_formats::WriteOptions;

use super::Run;
use crate::{Event, Step, TurntableError, stage};

impl Run<'_> {
    /// Writes the groom of a variant to the files that are due.
    pub(super) fn converts(&mut self, variant: usize, steps: &[&Step]) -> Result<(), TurntableError> {
        self.stop_if_asked()?;
        let plan = self.plan;
        let groom =
            stage::groom(&plan.variants[variant].pipeline, &plan.base, self.reporter, &mut self.store)?;
        for step in steps {
            self.stop_if_asked()?;
            let path = self.path(step);
            for warning in groom_formats::write(&groom, &path, &WriteOptions::default())? {
                self.reporter.event(&Event::Warning(&format!("{}: {warning}", path.display())));
            }
            self.made(step)?;
        }
        Ok(())
    }
}
