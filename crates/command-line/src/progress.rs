//! Progress bars for work of over a second.

use std::io::Write;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How long work runs before a bar appears.
const PATIENCE: Duration = Duration::from_secs(1);

const LEFT_GUESSED: &str = "{msg} [{bar:30}] {percent:>3} %  {elapsed} elapsed, {eta} left";
const LEFT_TOLD: &str = "{msg} [{bar:30}] {percent:>3} %  {elapsed} elapsed{prefix}";

/// A progress bar on stderr; silent when that is no terminal, and during the first second.
#[derive(Clone, Debug)]
pub struct Bar {
    bar: ProgressBar,
    start: Instant,
}

/// A bar for `len` units of work called `label`.
#[must_use]
pub fn progress_bar(len: u64, label: &str) -> Bar {
    let bar = ProgressBar::with_draw_target(Some(len), ProgressDrawTarget::hidden());
    if let Ok(style) = ProgressStyle::with_template(LEFT_GUESSED) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(label.to_owned());
    Bar { bar, start: Instant::now() }
}

impl Bar {
    /// Says that `position` units are done.
    pub fn set(&self, position: u64) {
        self.show_when_due();
        self.bar.set_position(position);
    }

    /// Says that `delta` more units are done.
    pub fn inc(&self, delta: u64) {
        self.show_when_due();
        self.bar.inc(delta);
    }

    /// Says how many units there are after all.
    pub fn set_len(&self, len: u64) {
        self.bar.set_length(len);
    }

    /// Changes the words before the bar.
    pub fn set_label(&self, label: &str) {
        self.bar.set_message(label.to_owned());
    }

    /// Says how much longer it takes, in words that stand in for the bar's own estimate.
    pub(crate) fn set_left(&self, words: &str) {
        if let Ok(style) = ProgressStyle::with_template(LEFT_TOLD) {
            self.bar.set_style(style.progress_chars("=> "));
        }
        self.bar.set_prefix(words.to_owned());
    }

    /// Prints a line above the bar, on stderr; a plain line when there is no bar.
    pub fn say(&self, line: &str) {
        self.bar.suspend(|| {
            // `eprintln!` would panic when nobody reads stderr any more.
            let _ = writeln!(std::io::stderr(), "{line}");
        });
    }

    /// Takes the bar off the terminal.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn is_due(&self) -> bool {
        self.start.elapsed() >= PATIENCE
    }

    fn show_when_due(&self) {
        if self.bar.is_hidden() && self.is_due() {
            // Ten draws a second; indicatif itself draws nothing when stderr is no terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_work_shows_a_bar() {
        // In a test stderr may be no terminal, where the bar stays hidden in any case.
        let now = Instant::now();
        let started = |ago| Bar { start: now - ago, ..progress_bar(10, "converting") };
        assert!(!Bar { start: now + Duration::from_secs(60), ..progress_bar(10, "converting") }.is_due());
        assert!(started(PATIENCE).is_due());
        let bar = progress_bar(10, "converting");
        bar.inc(5);
        bar.inc(2);
        assert_eq!(bar.bar.position(), 7);
        bar.finish();
    }
}
