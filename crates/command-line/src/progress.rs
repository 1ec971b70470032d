//! Progress bars for work of over a second.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How long work runs before a bar appears.
const PATIENCE: Duration = Duration::from_secs(1);

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
    let template = "{msg} [{bar:30}] {percent:>3} %  {elapsed} elapsed, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
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

    /// Prints a line above the bar, on stderr; a plain line when there is no bar.
    pub fn say(&self, line: &str) {
        self.bar.suspend(|| {
            #[allow(clippy::print_stderr)] // words of a program go to stderr
            {
                eprintln!("{line}");
            }
        });
    }

    /// Takes the bar off the terminal.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn show_when_due(&self) {
        if self.bar.is_hidden() && self.start.elapsed() >= PATIENCE {
            // Ten draws a second; indicatif itself draws nothing when stderr is no terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_work_shows_no_bar() {
        let bar = progress_bar(10, "converting");
        bar.inc(5);
        assert!(bar.bar.is_hidden());
        bar.finish();
    }
}
