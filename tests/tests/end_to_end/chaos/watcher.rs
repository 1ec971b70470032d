//! A reader that opens everything all the while, as a compositor or a contact sheet would.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use crate::turntable_bench::{content, files_below, is_hidden};

/// What a reader saw.
#[derive(Default)]
pub struct Seen {
    /// Files that were opened and found whole.
    pub whole: usize,
    /// Checkpoints among them.
    pub checkpoints: usize,
    /// Files that were not whole, and why.
    pub broken: Vec<String>,
}

/// Reads in a thread of its own until it is stopped.
pub struct Watcher {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<Seen>,
}

impl Watcher {
    pub fn start(folder: PathBuf) -> Watcher {
        let stop = Arc::new(AtomicBool::new(false));
        let told = Arc::clone(&stop);
        let thread = std::thread::spawn(move || {
            let mut seen = Seen::default();
            while !told.load(Ordering::Relaxed) {
                files_below(&folder).iter().for_each(|path| look(path, &mut seen));
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            seen
        });
        Watcher { stop, thread }
    }

    pub fn stop(self) -> Seen {
        self.stop.store(true, Ordering::Relaxed);
        self.thread.join().unwrap()
    }
}

fn look(path: &Path, seen: &mut Seen) {
    let is_checkpoint = path.to_string_lossy().ends_with(".part.exr");
    if is_hidden(path) && !is_checkpoint {
        return; // being written, and known by its name for that
    }
    match whole(path) {
        Ok(()) => {
            seen.whole += 1;
            seen.checkpoints += usize::from(is_checkpoint);
        }
        // Gone since the folder was listed, as checkpoints go.
        Err(_) if !path.exists() => {}
        Err(why) => seen.broken.push(format!("{}: {why}", path.display())),
    }
}

/// Whether a file is all there, by what its format says of its end.
fn whole(path: &Path) -> Result<(), String> {
    let read = || std::fs::read(path).map_err(|error| error.to_string());
    let json =
        |text: &[u8]| serde_json::from_slice::<serde_json::Value>(text).map_err(|error| error.to_string());
    match path.extension().and_then(|e| e.to_str()) {
        Some("exr") => content(path).map(drop),
        Some("png") => image::load_from_memory(&read()?).map(drop).map_err(|error| error.to_string()),
        Some("json") => json(&read()?).map(drop),
        Some("html") => match read()?.trim_ascii_end().ends_with(b"</html>") {
            true => Ok(()),
            false => Err("it does not end".to_owned()),
        },
        // Lines are added to it: all that have ended are whole.
        Some("jsonl") => {
            let text = read()?;
            let ended = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
            let lines = text[..ended].split(|&byte| byte == b'\n').filter(|line| !line.is_empty());
            lines.map(json).try_for_each(|line| line.map(drop))
        }
        _ => read().map(drop),
    }
}
