//! Renders that are stopped, killed, taken up again, skipped and looked at.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use hair_render::{Checkpoint, Frame, FrameHeader, FrameReport, Metadata};

use crate::support::*;

/// Some seconds of work in many passes.
const WORK: [&str; 8] = ["--width", "32", "--height", "24", "--spp", "500", "--aovs", "all"];

fn work<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&WORK[..], more].concat()
}

fn words(done: &Output) -> String {
    String::from_utf8_lossy(&done.stderr).into_owned()
}

/// Everything but what hangs on the clock.
fn assert_same(found: &Path, expected: &Path) {
    let [a, b] = [found, expected].map(|path| Frame::read_exr(path).unwrap().0);
    assert!(a.beauty == b.beauty && a.alpha == b.alpha && a.passes == b.passes, "other pixels");
    let figures = |frame: &Frame| (frame.report.rel_mse, frame.report.closest_rays, frame.report.shadow_rays);
    assert_eq!(figures(&a), figures(&b));
}

/// Waits until `path` is there; a test that waits in vain ends by its runner.
fn wait_for(path: &Path) {
    while !path.exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[cfg(unix)]
fn signal(name: &str, process: u32) {
    assert!(Command::new("kill").args([name, &process.to_string()]).status().unwrap().success());
}

#[cfg(unix)]
#[test]
fn killed_and_told_to_end_it_goes_on_to_the_same_bits() {
    let folder = folder("killed");
    assert!(run(&folder, &work(&["-o", "undisturbed.exr"])).status.success());
    let part = folder.join(".a.part.exr");
    let arguments = work(&["-o", "a.exr", "--checkpoint-every", "16spp"]);
    let mut child = command(&folder, &arguments).stderr(Stdio::null()).spawn().unwrap();
    wait_for(&part);
    child.kill().unwrap();
    child.wait().unwrap();
    let first = Checkpoint::read(&part).unwrap();
    assert!(first.spp() >= 16 && first.spp() < 500, "{}", first.spp());

    let child = command(&folder, &arguments).args(["--threads", "1"]).stderr(Stdio::piped()).spawn().unwrap();
    while Checkpoint::read(&part).unwrap().spp() <= first.spp() {
        std::thread::sleep(Duration::from_millis(5));
    }
    signal("-TERM", child.id());
    let told = child.wait_with_output().unwrap();
    assert_eq!(told.status.code(), Some(75), "{}", words(&told));
    assert!(
        words(&told).contains("going on at") && words(&told).contains("kept in .a.part.exr"),
        "{}",
        words(&told)
    );
    let second = Checkpoint::read(&part).unwrap();
    assert!(second.spp() > first.spp() && second.seconds() > first.seconds());

    let done = run(&folder, &arguments);
    assert_eq!(done.status.code(), Some(0), "{}", words(&done));
    assert_same(&folder.join("a.exr"), &folder.join("undisturbed.exr"));
    assert_eq!(names(&folder), ["a.exr", "undisturbed.exr"], "nothing else is left");
}

#[test]
fn a_time_limit_cuts_the_work_into_pieces_with_the_same_bits() {
    let folder = folder("limited");
    assert!(run(&folder, &work(&["-o", "undisturbed.exr"])).status.success());
    let (mut starts, mut passed) = (0, 0);
    let limit = |seconds: f64| run(&folder, &work(&["-o", "a.exr", "--time-limit", &seconds.to_string()]));
    // However slow the machine: the limit grows until it is enough.
    while limit(0.2 * 1.5f64.powi(starts)).status.code() == Some(75) {
        let spp = Checkpoint::read(&folder.join(".a.part.exr")).unwrap().spp();
        assert!(spp >= passed);
        (starts, passed) = (starts + 1, spp);
    }
    assert!(starts > 0);
    assert_same(&folder.join("a.exr"), &folder.join("undisturbed.exr"));
    assert_eq!(names(&folder), ["a.exr", "undisturbed.exr"]);
}

#[test]
fn other_checkpoints_and_broken_ones_are_told_and_left_out() {
    let folder = folder("other");
    let small = ["--width", "16", "--height", "12", "--spp", "40", "-o", "a.exr"];
    let stopped = run(&folder, &[&small[..], &["--time-limit", "1e-9"]].concat());
    assert_eq!(stopped.status.code(), Some(75), "{}", words(&stopped));
    let kept = std::fs::read(folder.join(".a.part.exr")).unwrap();
    let cut = &kept[..kept.len() / 2];
    for (part, more, says) in [
        (&kept[..], &["--seed", "1"][..], "of another picture, beginning anew"),
        (&kept, &["--no-resume"], ""),
        (cut, &[], "warning: .a.part.exr: not a readable picture"),
        (&kept, &[], "going on at 0 of 40"),
    ] {
        std::fs::write(folder.join(".a.part.exr"), part).unwrap();
        let done = run(&folder, &[&small[..], more].concat());
        assert_eq!(done.status.code(), Some(0), "{}", words(&done));
        assert!(words(&done).contains(says), "{}", words(&done));
        assert_eq!(words(&done).contains("going on"), says.contains("going on"), "{}", words(&done));
        assert_eq!(names(&folder), ["a.exr"]);
    }
}

#[test]
fn a_picture_that_is_there_is_skipped_until_anything_changes() {
    let folder = folder("skipped");
    let sound = sample("straight.hair");
    std::fs::copy(&sound, folder.join("copy.hair")).unwrap();
    let small = ["--width", "16", "--height", "12", "--spp", "4", "-o", "a.exr", "--skip-existing", "--json"];
    let again = |groom: &Path, more: &[&str]| {
        let done = command_on(groom, &folder, &[&small[..], more].concat()).output().unwrap();
        assert_eq!(done.status.code(), Some(0), "{}", words(&done));
        serde_json::from_slice::<serde_json::Value>(&done.stdout).unwrap()["skipped"] == true
    };
    let output = folder.join("a.exr");
    assert!(!again(&sound, &[]));
    let first = std::fs::read(&output).unwrap();
    // The file's name does not count, nor how many threads there are, nor a preview that is wanted too.
    for (groom, more) in [
        (sound.clone(), &[][..]),
        ("copy.hair".into(), &[]),
        (sound.clone(), &["--threads", "1"]),
        (sound.clone(), &["--png", "a.png"]),
    ] {
        assert!(again(&groom, more), "{more:?}");
        assert_eq!(std::fs::read(&output).unwrap(), first);
    }
    assert!(folder.join("a.png").exists());
    for more in [
        &["--seed", "1"][..],
        &["--azimuth", "1"],
        &["--beta-m", "0.31"],
        &["--half"],
        &["--env-rotate", "1"],
    ] {
        assert!(!again(&sound, more), "{more:?}");
        assert!(again(&sound, more), "{more:?}");
    }
    assert!(!again(&sound, &[]));
    let mut damaged = std::fs::read(&output).unwrap();
    // Several bytes: one bit may unpack to the same pixels, as a copy from another place that holds the same.
    let middle = damaged.len() * 3 / 4;
    damaged[middle..middle + 8].iter_mut().for_each(|byte| *byte ^= 0xff);
    std::fs::write(&output, damaged).unwrap();
    assert!(!again(&sound, &[]), "a damaged picture is made again");
    let mut other = std::fs::read(&sound).unwrap();
    let last = other.len() - 2;
    other[last] ^= 0x10;
    std::fs::write(folder.join("copy.hair"), other).unwrap();
    assert!(!again(Path::new("copy.hair"), &[]), "one bit of the groom");
}

#[cfg(unix)]
#[test]
fn a_snapshot_shows_the_picture_so_far() {
    let folder = folder("snapshot");
    let snapshot = folder.join("a.snapshot.exr");
    for (more, asks) in [(&["--snapshot", "0.01"][..], false), (&[], true)] {
        let arguments = work(&[&["-o", "a.exr", "--checkpoint-every", "16spp"], more].concat());
        let mut child = command(&folder, &arguments).stderr(Stdio::null()).spawn().unwrap();
        if asks {
            wait_for(&folder.join(".a.part.exr"));
            signal("-USR1", child.id());
        }
        wait_for(&snapshot);
        let header = FrameHeader::read(&snapshot).unwrap();
        assert!(header.spp >= 16 && header.spp < 500 && header.relative_error.is_some());
        assert!(child.wait().unwrap().success());
        assert_eq!(names(&folder), ["a.exr"], "gone once the picture is there");
        assert_eq!(FrameHeader::read(&folder.join("a.exr")).unwrap().digest, header.digest);
    }
    // One that a run left which was killed goes too; another picture's stays.
    let small = ["--width", "16", "--height", "12", "-o", "a.exr"];
    for (spp, left) in [("4", &["a.exr"][..]), ("5", &["a.exr", "a.snapshot.exr"])] {
        assert!(run(&folder, &[&small[..], &["--spp", "4"]].concat()).status.success());
        let frame = Frame::read_exr(&folder.join("a.exr")).unwrap();
        let report = FrameReport { spp: 2, ..frame.0.report.clone() };
        let metadata = Metadata { digest: frame.1.digest, ..Metadata::default() };
        Frame { report, ..frame.0 }.write_exr(&snapshot, &metadata).unwrap();
        assert!(run(&folder, &[&small[..], &["--spp", spp]].concat()).status.success());
        assert_eq!(names(&folder), left, "{spp}");
    }
}

#[test]
fn a_crop_is_a_part_of_the_whole() {
    let folder = folder("crop");
    let small = ["--width", "20", "--height", "10", "--spp", "3"];
    assert!(run(&folder, &[&small[..], &["-o", "whole.exr"]].concat()).status.success());
    assert!(
        run(&folder, &[&small[..], &["-o", "part.exr", "--crop", "0.25,0.75,0.5,1"]].concat())
            .status
            .success()
    );
    let [whole, part] = ["whole.exr", "part.exr"].map(|name| Frame::read_exr(&folder.join(name)).unwrap().0);
    assert_eq!((part.width, part.height), (10, 5));
    for (i, pixel) in part.beauty.iter().enumerate() {
        assert_eq!(*pixel, whole.beauty[(i / 10 + 5) * 20 + i % 10 + 5]);
    }
}

#[test]
fn farms_read_progress_on_stdout() {
    let folder = folder("progress");
    for (style, last) in [
        ("alf", "ALF_PROGRESS 100%"),
        ("openjd", "openjd_progress: 100.0"),
        ("json", r#"{"progress":100.0,"status":"rendering"}"#),
    ] {
        let small = ["--width", "16", "--height", "12", "--spp", "2", "-o", "a.exr", "--progress", style];
        let done = run(&folder, &small);
        let lines = String::from_utf8(done.stdout.clone()).unwrap();
        assert_eq!(lines.lines().last(), Some(last), "{}", words(&done));
    }
    let failed = run(&folder, &["-o", "a.exr", "--mesh", "none.obj", "--progress", "openjd"]);
    assert_eq!(failed.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&failed.stdout).starts_with("openjd_fail: "));
}

/// A viewer gets the picture under its name, and one that is not there stops nothing.
#[test]
fn a_viewer_is_sent_the_picture() {
    use std::io::Read;
    let folder = folder("viewer");
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let server = |address: &str| format!("--display-server={address}");
    let heard = server(&listener.local_addr().unwrap().to_string());
    let small = ["--width", "16", "--height", "12", "--spp", "40", "-o", "a.exr"];
    let viewer = std::thread::spawn(move || {
        let mut bytes = Vec::new();
        listener.accept().unwrap().0.read_to_end(&mut bytes).unwrap();
        bytes
    });
    assert!(run(&folder, &[&small[..], &[&heard]].concat()).status.success());
    let bytes = viewer.join().unwrap();
    assert!(bytes.windows(6).any(|w| w == b"a.exr\0"), "the picture's name");
    // The picture after a pass and the finished one: 16 x 12 pixels of 4 floats each.
    assert!(bytes.len() > 2 * 16 * 12 * 16, "{}", bytes.len());
    let alone = run(&folder, &[&small[..], &[&server("127.0.0.1:1"), "--preview"]].concat());
    assert_eq!(alone.status.code(), Some(0), "{}", words(&alone));
    let words = words(&alone);
    assert_eq!(words.matches("--display-server").count(), 1, "{words}");
    assert!(words.contains("stderr is no terminal"), "{words}");
}

/// A disk that is full in the middle of the picture: words that say so, and the old picture as it was.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_old_picture() {
    let folder = folder("full");
    std::fs::write(folder.join("a.exr"), "old").unwrap();
    // The shell makes writes beyond 4 blocks of 512 bytes fail, as those on a full disk do.
    let limited = "ulimit -f 4; trap '' XFSZ; exec \"$0\" \"$@\"";
    let done = Command::new("sh")
        .current_dir(&folder)
        .args(["-c", limited, env!("CARGO_BIN_EXE_hair-render")])
        .arg(sample("straight.hair"))
        .args(["--width", "64", "--height", "64", "--spp", "1", "-o", "a.exr"])
        .output()
        .unwrap();
    assert_eq!(done.status.code(), Some(2), "{}", words(&done));
    assert!(words(&done).contains("a.exr") && words(&done).contains("too large"), "{}", words(&done));
    assert_eq!(std::fs::read(folder.join("a.exr")).unwrap(), b"old");
    assert_eq!(names(&folder), ["a.exr"]);
}

/// Ends at once when told twice; before the first pixel is done there is little to wait for.
#[cfg(unix)]
#[test]
fn ctrl_c_ends_within_a_pixel() {
    let folder = folder("interrupted");
    let arguments =
        [&FOREVER[..], &["-o", "a.exr", "--checkpoint-every", "16spp", "--width", "16", "--height", "16"]]
            .concat();
    let child = command(&folder, &arguments).stderr(Stdio::piped()).spawn().unwrap();
    wait_for(&folder.join(".a.part.exr"));
    let start = Instant::now();
    signal("-INT", child.id());
    let stopped = child.wait_with_output().unwrap();
    assert_eq!(stopped.status.code(), Some(75), "{} after {:?}", words(&stopped), start.elapsed());
    assert_eq!(names(&folder), [".a.part.exr"]);
}
