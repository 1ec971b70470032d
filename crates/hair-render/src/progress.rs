//! How a long render talks to whoever waits for it.

/// Told of progress and asked whether to stop, from any of the rendering threads.
pub trait Progress: Sync {
    /// `done` of `total` tiles are finished; may be called out of order by other threads.
    fn advance(&self, done: u64, total: u64);

    /// Whether to give up; then [`crate::render`] returns [`crate::RenderError::Cancelled`].
    fn cancelled(&self) -> bool {
        false
    }
}

/// Tells nobody and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _done: u64, _total: u64) {}
}
