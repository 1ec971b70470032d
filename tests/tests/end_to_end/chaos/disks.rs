//! Disks that are full, and folders that may not be written: what was made stays, what could not be is named, and with
//! room again the same command goes on.
//!
//! Rights do not bind root, as whom gates often run: a small file system and a read-only mount do. They need a mount
//! namespace of their own (`unshare`), which some containers forbid; then the test says that it skipped.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{program, say_skipped};

use crate::turntable_bench::{Bench, Content, assert_same, contents, files_below, is_hidden};

const PIPELINE: &str = "version: 1
groom: {sample: {style: wavy, strands: 40, points: 6}}
lights: {environment: {constant: [1, 0.9, 0.8]}}
turntable: {frames: 4}
render: {width: 48, height: 48, spp: 4, max_bounces: 4, aovs: [R, TT]}
sheet: {columns: 4, gap: 2}
";

/// How to get a mount namespace here: as root, or as a root of one's own making.
fn unshare() -> Option<Vec<&'static str>> {
    let ways = [vec!["unshare", "--mount"], vec!["unshare", "--map-root-user", "--mount"]];
    let works = |way: &Vec<&str>| {
        let mut command = Command::new(way[0]);
        command.args(&way[1..]).args(["mount", "-t", "tmpfs", "-o", "size=64k", "none", "/mnt"]);
        command.output().is_ok_and(|output| output.status.success())
    };
    let way = ways.into_iter().find(works);
    if way.is_none() {
        say_skipped("no mount namespace can be had here (unshare --mount): nothing is mounted for the test");
    }
    way
}

/// Runs a script with mounts of its own; `$1` is the output folder, `$2` where to copy it to, the rest the command.
fn in_namespace(way: &[&str], script: &str, bench: &Bench, copy: &Path) -> Output {
    let mut command = Command::new(way[0]);
    command.args(&way[1..]).args(["sh", "-c", script, "sh"]).arg(bench.out()).arg(copy);
    command.arg(program("turntable")).arg(bench.pipeline()).arg("--out").arg(bench.out());
    command.output().unwrap()
}

fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn undisturbed() -> Bench {
    let bench = Bench::new(PIPELINE);
    bench.make(&[]);
    bench
}

fn frames(folder: &Path) -> Vec<PathBuf> {
    let is_frame = |path: &PathBuf| path.extension().is_some_and(|e| e == "exr") && !is_hidden(path);
    files_below(folder).into_iter().filter(is_frame).collect()
}

/// All frames of `folder` are among the wanted ones, bit for bit.
fn assert_sound(folder: &Path, wanted: &std::collections::BTreeMap<PathBuf, Content>) {
    for (name, content) in contents(folder).iter().filter(|(name, _)| !is_hidden(name)) {
        assert!(wanted.get(name) == Some(content), "{} is not what it should be", name.display());
    }
}

#[test]
fn a_full_disk_is_told_and_with_room_again_it_goes_on() {
    let Some(way) = unshare() else { return };
    let undisturbed = undisturbed();
    let wanted = contents(&undisturbed.out());
    let size = |path: &PathBuf| path.metadata().unwrap().len();
    // Room for two frames and a half, and for the little that is written beside them.
    let room = frames(&undisturbed.out()).iter().map(size).max().unwrap() * 5 / 2 + 24 * 1024;
    let bench = Bench::new(PIPELINE);
    std::fs::create_dir(bench.out()).unwrap();
    let copies = tempfile::tempdir().unwrap();
    let script = format!(
        "out=$1 copies=$2; shift 2; mount -t tmpfs -o size={room} none \"$out\" || exit 99
         \"$@\"; echo \"ended $?\" >&2; cp -a \"$out\" \"$copies/full\"
         mount -o remount,size=64m \"$out\" || exit 99
         \"$@\"; echo \"ended $?\" >&2; cp -a \"$out\" \"$copies/after\""
    );
    let output = in_namespace(&way, &script, &bench, copies.path());
    let told = words(&output);
    assert_eq!(output.status.code(), Some(0), "{told}");
    let (full, after) = told.split_once("ended 2").unwrap_or_else(|| panic!("no exit code of 2: {told}"));
    assert!(full.contains("frame.000") && full.contains(".exr"), "no frame is named: {full}");
    assert!(full.to_lowercase().contains("no space left"), "the cause is not told: {full}");
    assert!(after.contains("ended 0"), "{told}");
    let (full, after) = (copies.path().join("full"), copies.path().join("after"));
    let made = frames(&full).len();
    assert!((1..4).contains(&made), "{made} frames fitted: the test is set wrong");
    assert_sound(&full, &wanted);
    assert_same(&contents(&after), &wanted);
}

#[test]
fn a_folder_that_may_not_be_written_is_told_and_keeps_what_it_has() {
    let Some(way) = unshare() else { return };
    let undisturbed = undisturbed();
    let wanted = contents(&undisturbed.out());
    let bench = Bench::new(PIPELINE);
    bench.make(&["--frames", "2"]);
    let copies = tempfile::tempdir().unwrap();
    let script = "out=$1 copies=$2; shift 2
        mount --bind \"$out\" \"$out\" && mount -o remount,bind,ro \"$out\" || exit 99
        \"$@\"; echo \"ended $?\" >&2; cp -a \"$out\" \"$copies/locked\"
        mount -o remount,bind,rw \"$out\" || exit 99
        \"$@\"; echo \"ended $?\" >&2";
    let output = in_namespace(&way, script, &bench, copies.path());
    let told = words(&output);
    assert_eq!(output.status.code(), Some(0), "{told}");
    let (locked, after) = told.split_once("ended 2").unwrap_or_else(|| panic!("no exit code of 2: {told}"));
    assert!(locked.contains(&*bench.out().to_string_lossy()), "the folder is not named: {locked}");
    assert!(locked.to_lowercase().contains("read-only"), "the cause is not told: {locked}");
    assert!(after.contains("ended 0"), "{told}");
    let locked = copies.path().join("locked");
    assert_eq!(frames(&locked).len(), 1);
    assert_sound(&locked, &wanted);
    assert_same(&contents(&bench.out()), &wanted);
}

/// Without any mount: files may not grow beyond a limit, as quotas have it. The signal that comes with it is ignored,
/// so that the program is told by an error.
#[test]
fn a_file_that_may_not_grow_is_told() {
    let undisturbed = undisturbed();
    let wanted = contents(&undisturbed.out());
    let bench = Bench::new(PIPELINE);
    let mut limited = Command::new("sh");
    // 8 blocks are 4 or 8 KiB: no frame fits.
    limited.args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "sh"]).arg(program("turntable"));
    let output = limited.arg(bench.pipeline()).arg("--out").arg(bench.out()).output().unwrap();
    let told = words(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("frame.0001.exr"), "no frame is named: {told}");
    assert!(told.to_lowercase().contains("file too large"), "the cause is not told: {told}");
    assert_sound(&bench.out(), &wanted);
    assert!(frames(&bench.out()).is_empty());
    bench.make(&[]);
    assert_same(&contents(&bench.out()), &wanted);
}
