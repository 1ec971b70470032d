//! SIGUSR1: somebody wants to see how far it is.

use std::sync::atomic::{AtomicBool, Ordering};

static WANTED: AtomicBool = AtomicBool::new(false);
static ASK: AtomicBool = AtomicBool::new(false);

/// Waits for SIGUSR1 on a thread of its own; nothing where there is no such signal.
///
/// The signal is held back from all other threads, so this has to come before the first of them starts.
pub(crate) fn install() {
    #[cfg(unix)]
    {
        use nix::sys::signal::{SigSet, Signal};
        let mut signals = SigSet::empty();
        signals.add(Signal::SIGUSR1);
        if signals.thread_block().is_err() {
            return; // then the signal does what it always did
        }
        let waiting = std::thread::Builder::new().name("signals".into()).spawn(move || {
            while signals.wait().is_ok() {
                came();
            }
        });
        if waiting.is_err() {
            let _ = signals.thread_unblock();
        }
    }
}

/// Who does not listen ends, as the signal does by itself, though without leaving half files.
#[cfg(unix)]
fn came() {
    if ASK.load(Ordering::SeqCst) {
        WANTED.store(true, Ordering::SeqCst);
    } else {
        crate::interrupt::end_at_once(128 + nix::sys::signal::Signal::SIGUSR1 as i32);
    }
}

/// From now on SIGUSR1 only sets what [`snapshot_asked`] takes; before, it ends the process.
pub fn on_snapshot_ask() {
    ASK.store(true, Ordering::SeqCst);
}

/// Whether a snapshot was asked for since this was last called: every request is taken once.
#[must_use]
pub fn snapshot_asked() -> bool {
    WANTED.swap(false, Ordering::SeqCst)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_is_taken_once() {
        on_snapshot_ask();
        assert!(!snapshot_asked());
        #[cfg(unix)]
        came();
        #[cfg(unix)]
        assert!(snapshot_asked());
        assert!(!snapshot_asked());
    }
}
