//! Asked to end: no half file is left behind.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static ASK: AtomicBool = AtomicBool::new(false);

/// Installs the handler for SIGINT, SIGTERM and SIGHUP.
///
/// At first the process ends at once, after its temporary files are removed. A program that can stop
/// by itself calls [`on_interrupt_ask`]; a second signal then still ends it at once.
pub(crate) fn install() {
    // Fails only when a handler is there already, which then is this one.
    let _ = ctrlc::set_handler(|| {
        let second = INTERRUPTED.swap(true, Ordering::SeqCst);
        if second || !ASK.load(Ordering::SeqCst) {
            end_at_once(130);
        }
    });
}

/// Ends the process, leaving no temporary file.
pub(crate) fn end_at_once(code: i32) -> ! {
    whole_file::abandon_all();
    #[allow(clippy::exit)] // the process is asked to end and no body polls for it
    std::process::exit(code)
}

/// From now on a first Ctrl-C (SIGINT, SIGTERM, SIGHUP) only sets [`interrupted`], which the caller promises
/// to poll.
pub fn on_interrupt_ask() {
    ASK.store(true, Ordering::SeqCst);
}

/// Whether Ctrl-C was pressed, or the process was told to end.
#[must_use]
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}
