//! Runs that are killed, stopped or limited, and what they leave; several at once in one folder.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::turntable_bench::{Bench, FRAMES, assert_same, content, contents, small};

/// Enough samples that a kill can hit a frame being rendered.
const SLOW: [&str; 2] = ["--set", "render.spp=256"];

/// Files that are there are whole: those of an undisturbed run.
fn assert_whole(bench: &Bench, undisturbed: &Bench) {
    for name in FRAMES.iter().chain(&["sheet.png", "groom.txt", "groom.hair"]) {
        let path = bench.out().join(name);
        let is_whole = || content(&path).unwrap() == content(&undisturbed.out().join(name)).unwrap();
        assert!(!path.exists() || is_whole(), "{name}");
    }
}

/// Starts a run and waits until `name` is there or the run has ended.
fn run_until(bench: &Bench, name: &str) -> std::process::Child {
    let mut command = bench.command(&SLOW);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while !bench.out().join(name).exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

#[test]
fn a_killed_run_leaves_no_half_file_and_is_resumed_to_the_same_bits() {
    let undisturbed = small();
    undisturbed.made(&SLOW);
    let bench = small();
    let mut hits = 0;
    for (seen, coming) in [("groom.txt", FRAMES[0]), (FRAMES[0], FRAMES[1]), (FRAMES[1], FRAMES[2])] {
        let mut child = run_until(&bench, seen);
        child.kill().unwrap();
        child.wait().unwrap();
        hits += usize::from(!bench.out().join(coming).exists());
        assert_whole(&bench, &undisturbed);
    }
    assert!(hits > 0, "no kill came while something was left to make");
    // And at moments nobody chose, some of them while a file is being written.
    for delay in [3, 9, 20, 40] {
        let mut child = bench.command(&SLOW).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(delay));
        let _ = child.kill();
        child.wait().unwrap();
        assert_whole(&bench, &undisturbed);
    }
    bench.made(&SLOW);
    assert_same(&contents(&bench.out()), &contents(&undisturbed.out()));
}

#[test]
#[cfg(unix)]
fn an_interrupted_run_says_so_and_leaves_nothing_half_made() {
    let undisturbed = small();
    undisturbed.made(&SLOW);
    let bench = small();
    let mut child = run_until(&bench, FRAMES[0]);
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success(), "the run was over before it could be interrupted");
    assert_eq!(child.wait().unwrap().code(), Some(75), "try again");
    assert!(!bench.out().join("sheet.png").exists());
    assert_whole(&bench, &undisturbed);
    let names = contents(&bench.out()).into_keys().map(|p| p.display().to_string());
    assert_eq!(names.filter(|name| name.ends_with(".tmp")).count(), 0);
    bench.made(&SLOW);
    assert_same(&contents(&bench.out()), &contents(&undisturbed.out()));
}

/// Files that only a frame being rendered has beside it.
fn half_done(bench: &Bench) -> Vec<String> {
    let names = contents(&bench.out()).into_keys().map(|p| p.display().to_string());
    names.filter(|name| name.ends_with(".part.exr") || name.ends_with(".tmp")).collect()
}

#[test]
fn time_limits_keep_the_work_and_the_bits() {
    let undisturbed = small();
    undisturbed.made(&SLOW);
    let bench = small();
    let mut stops = 0;
    loop {
        // As short as can be: the first pass of the first frame is not finished by then.
        let limit = format!("{}", 0.02 * f64::from(stops + 1));
        let output = bench.command(&SLOW).args(["--time-limit", &limit]).output().unwrap();
        match output.status.code() {
            Some(0) => break,
            code => assert_eq!(code, Some(75), "{}", String::from_utf8_lossy(&output.stderr)),
        }
        stops += 1;
    }
    assert!(stops > 0, "no limit was met");
    assert_eq!(half_done(&bench), Vec::<String>::new());
    assert_same(&contents(&bench.out()), &contents(&undisturbed.out()));
}

#[test]
#[cfg(unix)]
fn signals_show_the_frame_and_keep_it() {
    let forever = ["--set", "render.spp=1000000", "--set", "turntable.frames=1"];
    let bench = small();
    let mut command = bench.command(&forever);
    let mut child = command.args(["--progress", "openjd"]).stdout(Stdio::piped()).spawn().unwrap();
    let send = |signal: &str, id: u32| {
        assert!(Command::new("kill").args([signal, &id.to_string()]).status().unwrap().success());
    };
    // From its first progress on it listens.
    let mut lines = std::io::BufRead::lines(std::io::BufReader::new(child.stdout.take().unwrap()));
    assert!(lines.by_ref().any(|line| line.unwrap().starts_with("openjd_progress: ")));
    send("-USR1", child.id());
    let shown = bench.out().join("snapshots/frame.0001.exr");
    while !shown.exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it showed anything");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(content(&shown).is_ok());
    send("-TERM", child.id());
    assert_eq!(child.wait().unwrap().code(), Some(75));
    assert_eq!(half_done(&bench), ["frames/.frame.0001.part.exr"]);
    let again = bench.command(&forever).args(["--time-limit", "0.5"]).output().unwrap();
    let told = String::from_utf8_lossy(&again.stderr).into_owned();
    assert!(told.contains("goes on from "), "{told}");
}

#[test]
fn checkpoints_that_do_not_fit_are_dropped_with_a_word() {
    let undisturbed = small();
    undisturbed.made(&[]);
    let bench = small();
    let checkpoint = bench.out().join("frames/.frame.0001.part.exr");
    std::fs::create_dir_all(checkpoint.parent().unwrap()).unwrap();
    std::fs::write(&checkpoint, b"half").unwrap();
    let output = bench.command(&[]).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(told.contains("frames/.frame.0001.part.exr: the checkpoint is dropped"), "{told}");
    assert!(output.status.success() && !checkpoint.exists(), "{told}");
    assert_same(&contents(&bench.out()), &contents(&undisturbed.out()));
    // A frame that is done needs none.
    std::fs::write(&checkpoint, b"half").unwrap();
    assert!(bench.made(&[]).is_empty());
    assert!(!checkpoint.exists());
}

#[test]
fn runs_at_once_in_one_folder_do_not_disturb_each_other() {
    let undisturbed = small();
    undisturbed.made(&[]);
    let bench = small();
    let start = |_| bench.command(&[]).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let children: Vec<_> = (0..4).map(start).collect();
    for child in children {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert_same(&contents(&bench.out()), &contents(&undisturbed.out()));
}

/// Any machine may be at a frame: it is rendered last, and all the same.
#[test]
fn frames_that_another_run_is_at_come_last() {
    let bench = small();
    let other = bench.out().join("frames/.frame.0001.exr.elsewhere.1.abc123.tmp");
    std::fs::create_dir_all(other.parent().unwrap()).unwrap();
    std::fs::write(&other, b"").unwrap();
    let frames: Vec<String> = bench.made(&[]).into_iter().filter(|name| name.ends_with(".exr")).collect();
    assert_eq!(frames, [FRAMES[1], FRAMES[2], FRAMES[0]]);
    assert!(other.exists(), "it is another's");
}

#[test]
fn runs_at_once_share_the_frames_out() {
    let bench = small();
    let flags = [&SLOW[..], &["--set", "turntable.frames=12", "--threads", "1", "--json"]].concat();
    let start = |_| bench.command(&flags).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let runs: Vec<_> = (0..2).map(start).collect();
    let rendered = |run: std::process::Child| {
        let output = run.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let frames = summary["frames"].as_array().unwrap();
        assert_eq!(frames.len(), 12);
        frames.iter().filter(|frame| frame["rendered"] == true).count()
    };
    let rendered: usize = runs.into_iter().map(rendered).sum();
    // The last frames may be made by both, as nobody waits; without sharing it would be 24.
    assert!((12..=16).contains(&rendered), "12 frames were rendered {rendered} times");
}
