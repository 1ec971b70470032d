//! A writer that is killed leaves the old file as it was, whatever the format.

#![allow(clippy::unwrap_used)] // tests fail by panicking
#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use end_to_end_tests::program;
use groom_formats::Format;

/// Long enough for any machine to start writing.
const PATIENCE: Duration = Duration::from_secs(60);

#[test]
fn kill_minus_9_leaves_the_old_file_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.hair");
    let made = Command::new(program("groom-samples"))
        .args(["--style", "curly", "--strands", "20000", "--points", "50", "--arrays", "all", "-o"])
        .arg(&input)
        .status()
        .unwrap();
    assert!(made.success());
    for format in Format::ALL.into_iter().filter(|format| format.can_write()) {
        let output = folder.path().join(format!("out.{format}"));
        std::fs::write(&output, b"the old file").unwrap();
        let caught = kill_while_writing(&input, &output);
        assert_eq!(std::fs::read(&output).unwrap(), b"the old file", "{format}");
        assert!(caught, "{format}: the writer was never caught at it");
        // The next run clears away what the killed one left.
        let run = Command::new(program("cyhair-convert")).args([&input, &output]).output().unwrap();
        assert!(run.status.success(), "{format}: {}", String::from_utf8_lossy(&run.stderr));
        assert_ne!(std::fs::read(&output).unwrap(), b"the old file", "{format}");
        assert_eq!(unfinished(folder.path()), 0, "{format}: rubbish is left");
    }
}

/// Starts the converter and kills it as soon as it has a temporary file with something in it; whether it
/// was caught before it ended. A few tries, because small machines may look away.
fn kill_while_writing(input: &Path, output: &Path) -> bool {
    (0..20).any(|_| {
        let mut child = Command::new(program("cyhair-convert"))
            .args([input, output])
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let start = Instant::now();
        loop {
            if unfinished(output.parent().unwrap()) > 0 {
                child.kill().unwrap();
                let ended = child.wait().unwrap();
                if !ended.success() {
                    return true;
                }
                std::fs::write(output, b"the old file").unwrap();
                return false;
            }
            if child.try_wait().unwrap().is_some() {
                std::fs::write(output, b"the old file").unwrap();
                return false;
            }
            assert!(start.elapsed() < PATIENCE, "the converter neither writes nor ends");
        }
    })
}

/// How many temporary files there are.
fn unfinished(folder: &Path) -> usize {
    let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    names.filter(|name| name.to_string_lossy().ends_with(".tmp")).count()
}
