//! What the renderer tells, passed on.

use hair_render::Progress;

use crate::Reporter;

/// Passes the renderer's progress on.
pub(super) struct Watch<'a> {
    pub reporter: &'a dyn Reporter,
    /// How many frames came before.
    pub index: u32,
    pub of: u32,
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
