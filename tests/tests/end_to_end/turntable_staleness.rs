//! What is made again, what is left alone, and what is told of it.

use std::path::Path;
use std::time::{Duration, SystemTime};

use crate::turntable_bench::{Content, FRAMES, SMALL, assert_same, content, contents, small};

#[test]
fn only_what_changed_is_made_again() {
    let bench = small();
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
    let bench = small();
    bench.made(&[]);
    let whole = contents(&bench.out());
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
    assert_same(&contents(&bench.out()), &whole);
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
    let bench = small();
    bench.made(&["--set", "turntable.frames=2"]);
    let two = contents(&bench.out());
    let made = bench.made(&["--set", "turntable.frames=4"]);
    assert_eq!(made.iter().filter(|name| name.starts_with("frames/")).count(), 3);
    let four = contents(&bench.out());
    let is_same = |one: usize, other: usize| four[Path::new(FRAMES[one])] == two[Path::new(FRAMES[other])];
    assert!(is_same(2, 1), "180 degrees is the same picture");
    assert!(is_same(0, 0) && !is_same(1, 1));
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
    let bench = small();
    let words = |output: &std::process::Output| String::from_utf8_lossy(&output.stderr).into_owned();
    let outputs = bench.command(&["--steps", "outputs"]).output().unwrap();
    assert!(outputs.status.success(), "{}", words(&outputs));
    assert!(words(&outputs).contains("sheet.png: left out, 3 frames it is made of"), "{}", words(&outputs));
    let report = std::fs::read_to_string(bench.out().join("report.json")).unwrap();
    assert!(report.contains("0 of 3 are there"), "{report}");
    let second = bench.command(&["--frames", "2"]).output().unwrap();
    assert!(words(&second).contains("sheet.png: left out, 2 frames it is made of"), "{}", words(&second));
    assert!(bench.out().join(FRAMES[1]).exists() && !bench.out().join("sheet.png").exists());
    assert_eq!(bench.made(&["--frames", "1,3"]), [FRAMES[0], FRAMES[2], "sheet.png"], "now all are there");
    assert!(bench.made(&[]).is_empty());
    let other = small();
    other.made(&["--threads", "1"]);
    assert_same(&contents(&bench.out()), &contents(&other.out()));
}

#[test]
fn what_fails_is_named_and_the_rest_is_made() {
    let bench = small();
    let groom = "groom: {sample: {style: wavy, strands: 40, points: 6}}";
    let text = SMALL.replace(&format!("{groom}\n"), "").replace("columns: 3, ", "");
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
    let told = bench.command(&["--progress", "openjd"]).output().unwrap().stdout;
    let told = String::from_utf8_lossy(&told).into_owned();
    assert!(told.contains("openjd_fail: ") && !told.contains("nan"), "{told}");
    let fast = bench.command(&["--fail-fast"]).output().unwrap();
    assert_eq!(fast.status.code(), Some(2));
}

#[test]
fn every_input_counts_by_its_bytes() {
    let bench = small();
    let file = |name: &str| bench.folder.path().join(name);
    let samples = end_to_end_tests::samples_dir();
    let copy = |from: &str, to: &str| std::fs::copy(samples.join(from), file(to)).unwrap();
    copy("wavy.hair", "in.hair");
    copy("head.obj", "head.obj");
    copy("studio.exr", "sky.exr");
    let text = SMALL
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
    let bench = small();
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
            let Content::Frame { pixels, .. } = content(&bench.out().join(name)).unwrap() else {
                return false;
            };
            pixels.chunks_exact(4).any(|v| f32::from_le_bytes(v.try_into().unwrap()) > 0.1)
        }),
        "a frame is black"
    );
}
