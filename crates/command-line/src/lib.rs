//! What every groomkit program shares: exit codes, error words, signals, progress for people and farms, and lists of
//! numbers as values of options.
//!
//! ```no_run
//! use command_line::Outcome;
//!
//! fn main() -> std::process::ExitCode {
//!     command_line::run(|| Ok(Outcome::Good))
//! }
//! ```
//!
//! Words go to stderr, data to stdout; only programs use this crate, and `frame-view`, which shows pictures for them.

mod interrupt;
mod meter;
mod numbers;
mod outcome;
mod progress;
mod snapshot;
mod words;

pub use interrupt::{interrupted, on_interrupt_ask};
pub use meter::{Meter, ProgressStyle};
pub use numbers::numbers;
pub use outcome::{Outcome, run};
pub use progress::{Bar, progress_bar};
pub use snapshot::{on_snapshot_ask, snapshot_asked};
pub use words::{say, words};
