//! What is made again and what is left alone; kills and resumes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, SystemTime};

use end_to_end_tests::program;
use exr::prelude::{ReadChannels as _, ReadLayers as _};

const PIPELINE: &str = "version: 1
groom: {sample: {style: wavy, strands: 40, points: 6}}
convert: [groom.txt, groom.hair]
lights: {environment: {constant: [1, 0.9, 0.8]}}
turntable: {frames: 3}
render: {width: 16, height: 16, spp: 2, max_bounces: 4, aovs: [R]}
sheet: {columns: 3, gap: 2}
";

/// A pipeline in a folder of its own.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Bench {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("turn.yaml"), PIPELINE).unwrap();
        Bench { folder }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    fn command(&self, more: &[&str]) -> Command {
        let mut command = Command::new(program("turntable"));
        command.arg(self.folder.path().join("turn.yaml")).arg("--out").arg(self.out()).args(more);
        command
    }

    /// Runs to the end and returns the names of the files made, the report left out.
    fn made(&self, more: &[&str]) -> Vec<String> {
        let output = self.command(&[more, &["--json"]].concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let names = summary["made"].as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_owned());
        names.filter(|name| !name.starts_with("report.")).collect()
    }

    /// Every file of the output folder with its bytes; frames as their pixels, for their headers
    /// hold the seconds they took; without the report and the manifest, which hold those too.
    fn contents(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut found = BTreeMap::new();
        for folder in [self.out(), self.out().join("frames")] {
            for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
                let path = entry.path();
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                if path.is_file() && !name.starts_with("report.") && name != "manifest.jsonl" {
                    let is_frame = path.extension().is_some_and(|e| e == "exr");
                    let bytes = if is_frame && !name.starts_with('.') {
                        pixels(&path)
                    } else {
                        std::fs::read(&path).unwrap()
                    };
                    found.insert(path.strip_prefix(self.out()).unwrap().to_owned(), bytes);
                }
            }
        }
        found
    }
}

/// All channels of a frame, bit for bit.
fn pixels(path: &Path) -> Vec<u8> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let channels = image.layer_data.channel_data.list;
    channels
        .iter()
        .flat_map(|c| c.sample_data.values_as_f32().flat_map(|v| v.to_bits().to_le_bytes()))
        .collect()
}

const FRAMES: [&str; 3] = ["frames/frame.0001.exr", "frames/frame.0002.exr", "frames/frame.0003.exr"];

#[test]
fn only_what_changed_is_made_again() {
    let bench = Bench::new();
    let all = bench.made(&[]);
    assert_eq!(all, [&["groom.txt", "groom.hair"][..], &FRAMES, &["sheet.png"]].concat());
    assert_eq!(bench.made(&[]), Vec::<String>::new(), "nothing changed");
    assert_eq!(bench.made(&["--threads", "1"]), Vec::<String>::new(), "threads change no pixel");
    let check = bench.command(&["--check"]).output().unwrap();
    assert_eq!(check.status.code(), Some(0));

    let frames_and_sheet = [&FRAMES[..], &["sheet.png"]].concat();
    assert_eq!(bench.made(&["--set", "render.spp=3"]), frames_and_sheet, "samples concern frames");
    assert_eq!(bench.made(&[]), frames_and_sheet, "and back again");
    assert_eq!(bench.made(&["--set", "tone.exposure=1"]), ["sheet.png"], "exposure concerns the sheet");
    assert_eq!(bench.made(&[]), ["sheet.png"]);
    assert_eq!(bench.made(&["--set", "material.beta_m=0.3"]), Vec::<String>::new(), "a default spelled out");
    assert_eq!(bench.made(&["--set", "attributes.scale=2"]).len(), 6, "the groom concerns everything");
}

#[test]
fn damage_is_mended_and_nothing_else_touched() {
    let bench = Bench::new();
    bench.made(&[]);
    let whole = bench.contents();
    let path = |name: &str| bench.out().join(name);
    for name in ["groom.txt", FRAMES[1], "sheet.png"] {
        std::fs::remove_file(path(name)).unwrap();
        assert_eq!(bench.made(&[]), [name]);
        let bytes = std::fs::read(path(name)).unwrap();
        std::fs::write(path(name), &bytes[..bytes.len() - 7]).unwrap();
        assert_eq!(bench.made(&[]), [name], "a truncated {name}");
        std::fs::write(path(name), b"").unwrap();
        assert_eq!(bench.made(&[]), [name], "an empty {name}");
        let mut bytes = std::fs::read(path(name)).unwrap();
        let middle = bytes.len() * 3 / 4;
        bytes[middle] ^= 0x10;
        std::fs::write(path(name), &bytes).unwrap();
        assert_eq!(bench.made(&[]), [name], "a flipped bit in {name}");
    }
    let mut bytes = std::fs::read(path(FRAMES[1])).unwrap();
    let middle = bytes.len() * 3 / 4;
    bytes[middle] ^= 0x10;
    std::fs::write(path(FRAMES[1]), &bytes).unwrap();
    std::fs::remove_file(path("manifest.jsonl")).unwrap();
    let made = bench.made(&["--frames", "1-3"]);
    assert!(made.contains(&FRAMES[1].to_owned()), "a flipped bit that no manifest tells of: {made:?}");
    assert!(!made.contains(&FRAMES[0].to_owned()), "sound frames need no manifest: {made:?}");
    assert_eq!(bench.contents(), whole, "what was made again has the same bits");
    let stale = path("frames/.frame.0001.exr.elsewhere.4294967295.abc.tmp");
    std::fs::write(&stale, b"half").unwrap();
    bench.made(&[]);
    assert!(stale.exists(), "another machine may still be writing it");
    let days_ago = SystemTime::now() - Duration::from_secs(3 * 24 * 60 * 60);
    std::fs::File::options().write(true).open(&stale).unwrap().set_modified(days_ago).unwrap();
    bench.made(&[]);
    assert!(!stale.exists(), "stale temporary files are cleared");
}

#[test]
fn more_frames_keep_the_views_there_are() {
    let bench = Bench::new();
    bench.made(&["--set", "turntable.frames=2"]);
    let two = bench.contents();
    let made = bench.made(&["--set", "turntable.frames=4"]);
    assert_eq!(made.iter().filter(|name| name.starts_with("frames/")).count(), 3);
    let four = bench.contents();
    assert_eq!(four[Path::new(FRAMES[2])], two[Path::new(FRAMES[1])], "180 degrees is the same picture");
    assert_eq!(four[Path::new(FRAMES[0])], two[Path::new(FRAMES[0])]);
    assert_ne!(four[Path::new(FRAMES[1])], two[Path::new(FRAMES[1])]);
    let summary = bench.command(&["--set", "turntable.frames=2", "--explain"]).output().unwrap();
    let told = String::from_utf8_lossy(&summary.stdout).into_owned();
    assert!(told.contains("the same view is there as"), "{told}");
    assert!(told.contains("none of this turntable's frames"), "{told}");
    let shorter = bench.command(&["--set", "turntable.frames=2"]).output().unwrap();
    let told = String::from_utf8_lossy(&shorter.stderr).into_owned();
    assert!(told.contains("2 frames are none of this turntable's, from frames/frame.0003.exr on"), "{told}");
}

#[test]
fn frames_can_be_shared_out() {
    let bench = Bench::new();
    assert_eq!(
        bench.made(&["--frames", "2"]),
        ["groom.txt", "groom.hair", FRAMES[1]],
        "no sheet without all frames"
    );
    assert_eq!(bench.made(&["--frames", "1,3"]), [FRAMES[0], FRAMES[2], "sheet.png"], "now all are there");
    assert!(bench.made(&[]).is_empty());
    let other = Bench::new();
    other.made(&["--threads", "1"]);
    assert_eq!(bench.contents(), other.contents(), "shared out or not, the same bits");
}

/// Enough samples that a kill can hit a frame being rendered.
const SLOW: [&str; 2] = ["--set", "render.spp=256"];

/// Files that are there are whole: frames can be read, the rest equals that of an undisturbed run.
fn assert_whole(bench: &Bench, undisturbed: &Bench) {
    for name in FRAMES.iter().chain(&["sheet.png", "groom.txt", "groom.hair"]) {
        let path = bench.out().join(name);
        match path.extension().and_then(|e| e.to_str()) {
            _ if !path.exists() => {}
            Some("exr") => assert_eq!(pixels(&path), pixels(&undisturbed.out().join(name)), "{name}"),
            _ => assert_eq!(
                std::fs::read(&path).unwrap(),
                std::fs::read(undisturbed.out().join(name)).unwrap(),
                "{name}"
            ),
        }
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
    let undisturbed = Bench::new();
    undisturbed.made(&SLOW);
    let bench = Bench::new();
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
    assert_eq!(bench.contents(), undisturbed.contents());
}

#[test]
#[cfg(unix)]
fn an_interrupted_run_says_so_and_leaves_nothing_half_made() {
    let undisturbed = Bench::new();
    undisturbed.made(&SLOW);
    let bench = Bench::new();
    let mut child = run_until(&bench, FRAMES[0]);
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success(), "the run was over before it could be interrupted");
    assert_eq!(child.wait().unwrap().code(), Some(75), "try again");
    assert!(!bench.out().join("sheet.png").exists());
    assert_whole(&bench, &undisturbed);
    let names = bench.contents().into_keys().map(|p| p.display().to_string());
    assert_eq!(names.filter(|name| name.ends_with(".tmp")).count(), 0);
    bench.made(&SLOW);
    assert_eq!(bench.contents(), undisturbed.contents());
}

/// Files that only a frame being rendered has beside it.
fn half_done(bench: &Bench) -> Vec<String> {
    let names = bench.contents().into_keys().map(|p| p.display().to_string());
    names.filter(|name| name.ends_with(".part.exr") || name.ends_with(".tmp")).collect()
}

#[test]
fn time_limits_keep_the_work_and_the_bits() {
    let undisturbed = Bench::new();
    undisturbed.made(&SLOW);
    let bench = Bench::new();
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
    assert_eq!(bench.contents(), undisturbed.contents());
}

#[test]
#[cfg(unix)]
fn signals_show_the_frame_and_keep_it() {
    let forever = ["--set", "render.spp=1000000", "--set", "turntable.frames=1"];
    let bench = Bench::new();
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
    assert!(!pixels(&shown).is_empty());
    send("-TERM", child.id());
    assert_eq!(child.wait().unwrap().code(), Some(75));
    assert_eq!(half_done(&bench), ["frames/.frame.0001.part.exr"]);
    let again = bench.command(&forever).args(["--time-limit", "0.5"]).output().unwrap();
    let told = String::from_utf8_lossy(&again.stderr).into_owned();
    assert!(told.contains("goes on from "), "{told}");
}

#[test]
fn checkpoints_that_do_not_fit_are_dropped_with_a_word() {
    let undisturbed = Bench::new();
    undisturbed.made(&[]);
    let bench = Bench::new();
    let checkpoint = bench.out().join("frames/.frame.0001.part.exr");
    std::fs::create_dir_all(checkpoint.parent().unwrap()).unwrap();
    std::fs::write(&checkpoint, b"half").unwrap();
    let output = bench.command(&[]).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(told.contains("frames/.frame.0001.part.exr: the checkpoint is dropped"), "{told}");
    assert!(output.status.success() && !checkpoint.exists(), "{told}");
    assert_eq!(bench.contents(), undisturbed.contents());
    // A frame that is done needs none.
    std::fs::write(&checkpoint, b"half").unwrap();
    assert!(bench.made(&[]).is_empty());
    assert!(!checkpoint.exists());
}

#[test]
fn what_fails_is_named_and_the_rest_is_made() {
    let bench = Bench::new();
    let groom = "groom: {sample: {style: wavy, strands: 40, points: 6}}";
    let text = PIPELINE.replace(&format!("{groom}\n"), "").replace("columns: 3, ", "");
    let matrix =
        format!("matrix:\n  hair:\n    lost: {{groom: {{file: broken.hair}}}}\n    found: {{{groom}}}\n");
    std::fs::write(bench.folder.path().join("turn.yaml"), format!("{text}{matrix}")).unwrap();
    std::fs::write(bench.folder.path().join("broken.hair"), b"HAIR and nothing more").unwrap();
    let output = bench.command(&["--json"]).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("broken.hair") && told.contains("frames/lost/frame.0001.exr and 2 more"), "{told}");
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(summary["frames"].as_array().unwrap().len(), 3);
    assert!(bench.out().join("frames/found/frame.0003.exr").exists());
    assert!(!bench.out().join("sheet.png").exists(), "a sheet without some of its frames");
    let only = bench.command(&["--only", "hair=found", "--check"]).output().unwrap();
    assert_eq!(only.status.code(), Some(0), "{}", String::from_utf8_lossy(&only.stdout));
    let fast = bench.command(&["--fail-fast"]).output().unwrap();
    assert_eq!(fast.status.code(), Some(2));
}

#[test]
fn runs_at_once_in_one_folder_do_not_disturb_each_other() {
    let undisturbed = Bench::new();
    undisturbed.made(&[]);
    let bench = Bench::new();
    let start = |_| bench.command(&[]).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let children: Vec<_> = (0..4).map(start).collect();
    for child in children {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert_eq!(bench.contents(), undisturbed.contents());
}

#[test]
fn every_input_counts_by_its_bytes() {
    let bench = Bench::new();
    let file = |name: &str| bench.folder.path().join(name);
    let samples = end_to_end_tests::samples_dir();
    let copy = |from: &str, to: &str| std::fs::copy(samples.join(from), file(to)).unwrap();
    copy("wavy.hair", "in.hair");
    copy("head.obj", "head.obj");
    copy("studio.exr", "sky.exr");
    let text = PIPELINE
        .replace("{sample: {style: wavy, strands: 40, points: 6}}", "{file: in.hair}\nmesh: {file: head.obj}")
        .replace("{constant: [1, 0.9, 0.8]}", "{file: sky.exr}");
    std::fs::write(file("turn.yaml"), text).unwrap();
    assert_eq!(bench.made(&[]).len(), 6);
    copy("wavy.hair", "in.hair");
    assert!(bench.made(&[]).is_empty(), "the same bytes at a later time");
    let head = std::fs::read_to_string(file("head.obj")).unwrap();
    std::fs::write(file("head.obj"), format!("{head}# seen\n")).unwrap();
    let frames_and_sheet = [&FRAMES[..], &["sheet.png"]].concat();
    assert_eq!(bench.made(&[]), frames_and_sheet, "the mesh concerns frames");
    let mut sky = std::fs::read(file("sky.exr")).unwrap();
    sky.push(0);
    std::fs::write(file("sky.exr"), sky).unwrap();
    assert_eq!(bench.made(&[]), frames_and_sheet, "so does the environment");
    copy("curly.hair", "in.hair");
    assert_eq!(bench.made(&[]).len(), 6, "the groom concerns everything");
}

#[test]
fn the_sheet_holds_the_frames_and_the_report_their_figures() {
    let bench = Bench::new();
    bench.made(&[]);
    let png = std::fs::read(bench.out().join("sheet.png")).unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert_eq!((number(16), number(20)), (3 * 16 + 4 * 2, 16 + 2 * 2));
    let report = std::fs::read_to_string(bench.out().join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["schema"], "error-report/1");
    let points = report["series"][0]["points"].as_array().unwrap();
    assert_eq!(points.len(), 3);
    assert!(points.iter().all(|p| p["samples"] == 2.0 && p["seconds"].as_f64().unwrap() > 0.0));
    let page = std::fs::read_to_string(bench.out().join("report.html")).unwrap();
    assert!(page.contains("<svg") && page.contains("frame 0003"));
    assert!(
        FRAMES.iter().all(|name| {
            let bits = pixels(&bench.out().join(name));
            bits.chunks_exact(4).any(|v| f32::from_le_bytes(v.try_into().unwrap()) > 0.1)
        }),
        "a frame is black"
    );
}
