//! A writer that is killed leaves the old file as it was, whatever the format.

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};

use end_to_end_tests::{program, run};
use groom_formats::Format;

/// What the kernel kills with when a file grows over the limit; like `kill -9`, it leaves the program no
/// say, and it comes in the middle of writing on slow and fast machines alike.
const SIGXFSZ: i32 = 25;

/// Limits in blocks of 512 bytes (1024 for some shells): right at the start, and well into the file.
const LIMITS: [u32; 2] = [1, 200];

#[test]
fn a_killed_writer_leaves_the_old_file_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.hair");
    let wanted = ["--style", "curly", "--strands", "1000", "--points", "50", "--arrays", "all", "-o"];
    let made = Command::new(program("groom-samples")).args(wanted).arg(&input).status().unwrap();
    assert!(made.success());
    for format in Format::ALL.into_iter().filter(|format| format.can_write()) {
        let output = folder.path().join(format!("out.{format}"));
        std::fs::write(&output, b"the old file").unwrap();
        for limit in LIMITS {
            let killed = run_limited(limit, &input, &output);
            assert_eq!(killed.signal(), Some(SIGXFSZ), "{format}, {limit} blocks: {killed}");
            assert_eq!(std::fs::read(&output).unwrap(), b"the old file", "{format}, {limit} blocks");
            assert!(unfinished(folder.path()) > 0, "{format}, {limit} blocks: it had not begun");
        }
        // The next run clears away what the killed ones left.
        let run = run("cyhair-convert", &[&input, &output]);
        assert!(run.status.success(), "{format}: {}", String::from_utf8_lossy(&run.stderr));
        assert_ne!(std::fs::read(&output).unwrap(), b"the old file", "{format}");
        assert_eq!(unfinished(folder.path()), 0, "{format}: rubbish is left");
    }
}

/// Converts under a limit on the size of files, without a core dump.
fn run_limited(blocks: u32, input: &Path, output: &Path) -> ExitStatus {
    Command::new("sh")
        .args(["-c", &format!("ulimit -c 0; ulimit -f {blocks}; exec \"$@\""), "sh"])
        .arg(program("cyhair-convert"))
        .args([input, output])
        .stderr(Stdio::null())
        .status()
        .unwrap()
}

/// How many temporary files there are.
fn unfinished(folder: &Path) -> usize {
    let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    names.filter(|name| name.to_string_lossy().ends_with(".tmp")).count()
}
