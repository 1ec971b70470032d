//! From a result to an exit code.

use std::io::{self, Write};
use std::process::ExitCode;

use crate::{interrupt, snapshot};

/// How a program ended, as its exit code says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// 0: done.
    Good,
    /// 1: checked, and found wanting.
    Wanting,
    /// 2: could not; bad input or usage.
    Failed,
    /// 75: stopped by a signal or a time limit with its work kept; the same command goes on from there. Schedulers
    /// take it (`EX_TEMPFAIL` of sysexits.h) for a reason to start the task again.
    TryAgain,
    /// 130: stopped by Ctrl-C.
    Interrupted,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        ExitCode::from(match outcome {
            Outcome::Good => 0,
            Outcome::Wanting => 1,
            Outcome::Failed => 2,
            Outcome::TryAgain => 75,
            Outcome::Interrupted => 130,
        })
    }
}

/// Runs a program's body: handles signals, prints errors with their causes, returns the exit code.
///
/// A typed error of a library converts by `?`. A reader that closes the pipe early (`| head`) is no
/// error: the program ends quietly with 0.
pub fn run(body: impl FnOnce() -> anyhow::Result<Outcome>) -> ExitCode {
    // First of all: other threads must not see the signal it waits for.
    snapshot::install();
    interrupt::install();
    match body() {
        Ok(outcome) => outcome.into(),
        Err(error) => {
            if is_closed_pipe(&error) {
                return Outcome::Good.into();
            }
            // `eprintln!` would panic when nobody reads stderr any more.
            let _ = writeln!(io::stderr(), "error: {}", in_words(&error));
            Outcome::Failed.into()
        }
    }
}

fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error.chain().filter_map(|e| e.downcast_ref::<io::Error>()).any(|e| e.kind() == io::ErrorKind::BrokenPipe)
}

/// The error and its causes on one line, leaving out causes the text before already tells.
fn in_words(error: &anyhow::Error) -> String {
    let mut words = String::new();
    for cause in error.chain() {
        let cause = cause.to_string();
        if !words.contains(&cause) {
            words += if words.is_empty() { "" } else { ": " };
            words += &cause;
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use anyhow::Context;

    use super::*;

    fn failed(kind: io::ErrorKind, context: &'static str) -> anyhow::Error {
        Err::<(), _>(io::Error::from(kind)).context(context).unwrap_err()
    }

    #[test]
    fn causes_are_told_once() {
        let cause = io::Error::from(io::ErrorKind::NotFound).to_string();
        let told = format!("a.txt: {cause}");
        let repeated =
            Err::<(), _>(io::Error::from(io::ErrorKind::NotFound)).context(told.clone()).unwrap_err();
        assert_eq!(in_words(&repeated), told);
        assert_eq!(in_words(&failed(io::ErrorKind::NotFound, "reading")), format!("reading: {cause}"));
    }

    #[test]
    fn a_closed_pipe_is_found_behind_other_errors() {
        assert!(is_closed_pipe(&io::Error::from(io::ErrorKind::BrokenPipe).into()));
        assert!(is_closed_pipe(&failed(io::ErrorKind::BrokenPipe, "writing")));
        assert!(!is_closed_pipe(&failed(io::ErrorKind::NotFound, "writing")));
    }
}
