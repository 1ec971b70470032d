//! Frame by frame: in memory that does not grow with them, and whole or not at all.

use std::process::{Command, Stdio};

use end_to_end_tests::{program, validators};

use super::support::{hair, head, names_in};

/// Runs what follows it and prints the most memory that was in use, in KiB on Linux.
const PEAK: &str = "\
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, stderr=subprocess.DEVNULL)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)";

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_frames() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("wavy.hair"));
    let peak = |frames: &str, output: &str| -> f64 {
        let run = Command::new(&python)
            .args(["-c", PEAK])
            .arg(program("groom-bind"))
            .args([&hair, "--mesh", &mesh, "--up", "y", "--frames", frames, "-o", output])
            // Each thread keeps a heap of its own; one is enough to be held against another run.
            .env("RAYON_NUM_THREADS", "1")
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        String::from_utf8(run.stdout).unwrap().trim().parse::<f64>().unwrap() / 1024.0
    };
    for output in ["a.usdc", "a.abc", "a.####.hair"] {
        let (few, many) = (peak("0-3", output), peak("0-63", output));
        let frame = 2200.0 * 13.0 * 24.0 / (1024.0 * 1024.0);
        // Sixty frames more are 40 MiB.
        assert!(many < few + 6.0 * frame, "{output}: {few} MiB for 4 frames, {many} for 64");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_no_half_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("out.usdc"), "the old file").unwrap();
    let (mesh, hair) = (head(), hair("straight.hair"));
    let mut child = Command::new(program("groom-bind"))
        .args([&hair, "--mesh", &mesh, "--up", "y", "--frames", "0-90000", "-o", "out.usdc"])
        .current_dir(folder.path())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while names_in(folder.path()).len() < 2 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it began to write");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(names_in(folder.path()), ["out.usdc"]);
    assert_eq!(std::fs::read(folder.path().join("out.usdc")).unwrap(), b"the old file");
}
