//! What a turntable makes of finished frames: previews, sheet, films, page; and `turntable comp`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{program, run, say_skipped, workspace};
use serde_json::Value;

const PIPELINE: &str = "\
version: 1
groom: {sample: {style: straight, strands: 80, points: 6, seed: 1}}
lights: {environment: {constant: [1, 1, 1]}}
turntable: {frames: 2}
render: {width: 33, height: 27, spp: 2, max_bounces: 4, aovs: [R, TT, TRT, residual, scattered]}
tone: {frames: true, background: [0.18, 0.18, 0.18]}
matrix: {look: {a: {}, b: {material: {beta_m: 0.6}}}}
sheet: {captions: [variant, frame, error, seconds]}
video: [{file: turn.mp4, fps: 2}, {file: turn.mov, fps: 2}]
page: {}
";

/// A pipeline in a folder of its own.
struct Turntable {
    folder: tempfile::TempDir,
}

impl Turntable {
    fn new() -> Turntable {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("look.yaml"), PIPELINE).unwrap();
        Turntable { folder }
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join("out").join(name)
    }

    fn run(&self, arguments: &[&str], ffmpeg: &Path) -> Output {
        let mut command = Command::new(program("turntable"));
        command.arg(self.folder.path().join("look.yaml")).args(["--json", "--out"]).arg(self.at(""));
        command.args(arguments).env("FFMPEG", ffmpeg).output().unwrap()
    }

    /// What a run made, sorted.
    fn made(&self, arguments: &[&str], ffmpeg: &Path) -> Vec<String> {
        let output = self.run(arguments, ffmpeg);
        assert!(output.status.success(), "{}", words(&output));
        let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
        let made = summary["made"].as_array().unwrap().iter();
        let mut made: Vec<String> = made.map(|path| path.as_str().unwrap().replace('\\', "/")).collect();
        made.sort();
        made
    }
}

fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The machine's ffmpeg, or the one that `cargo xtask setup` installs.
fn ffmpeg() -> Option<PathBuf> {
    let answers = |program: &Path| Command::new(program).arg("-version").output().is_ok();
    let installed = || {
        let script = "import imageio_ffmpeg; print(imageio_ffmpeg.get_ffmpeg_exe())";
        let python = workspace().join("target/venv/bin/python");
        let output = Command::new(python).args(["-c", script]).output().ok()?;
        Some(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim())).filter(|found| answers(found))
    };
    let found = Some(PathBuf::from("ffmpeg")).filter(|found| answers(found)).or_else(installed);
    if found.is_none() {
        say_skipped("no ffmpeg in PATH or in target/venv (cargo xtask setup)");
    }
    found
}

#[test]
fn without_ffmpeg_films_are_left_out_aloud_and_required_ones_are_missed() {
    let turntable = Turntable::new();
    let nowhere = Path::new("/nowhere/ffmpeg");
    let output = turntable.run(&[], nowhere);
    assert!(output.status.success(), "{}", words(&output));
    assert!(words(&output).contains("turn.mp4: left out, there is no ffmpeg"), "{}", words(&output));
    for there in ["sheet.png", "index.html", "frames/a/frame.0001.png", "frames/b/frame.0002.exr"] {
        assert!(turntable.at(there).is_file(), "{there}");
    }
    assert!(!turntable.at("a/turn.mp4").exists());
    let page = std::fs::read_to_string(turntable.at("index.html")).unwrap();
    for part in ["4 frames", "material.beta_m", "relative error against seconds", "\"passes\":[\"R\""] {
        assert!(page.contains(part), "no {part} on the page");
    }

    let text = PIPELINE.replace("fps: 2}]", "fps: 2, required: true}]");
    std::fs::write(turntable.folder.path().join("look.yaml"), text).unwrap();
    let output = turntable.run(&[], nowhere);
    assert_eq!(output.status.code(), Some(2), "{}", words(&output));
    assert!(words(&output).contains("turn.mov") && words(&output).contains("ffmpeg"), "{}", words(&output));
}

#[test]
fn what_is_shown_is_made_again_with_how_it_is_shown_and_frames_are_not() {
    let Some(ffmpeg) = ffmpeg() else { return };
    let turntable = Turntable::new();
    let first = turntable.made(&[], &ffmpeg);
    for there in ["a/turn.mov", "a/turn.mp4", "b/turn.mov", "b/turn.mp4", "index.html", "sheet.png"] {
        assert!(first.iter().any(|made| made == there), "{there}: {first:?}");
    }
    assert_eq!(turntable.made(&[], &ffmpeg), [""; 0], "all is up to date");

    let weighed = turntable.made(&["--set", "comp.weights.TT=3"], &ffmpeg);
    assert!(weighed.iter().all(|made| !made.ends_with(".exr")), "{weighed:?}");
    assert_eq!(weighed.len(), 4 + 1 + 4 + 1, "previews, sheet, films, page: {weighed:?}");
    // Back again, the same bytes come out.
    let sheet = std::fs::read(turntable.at("sheet.png")).unwrap();
    turntable.made(&[], &ffmpeg);
    assert_ne!(std::fs::read(turntable.at("sheet.png")).unwrap(), sheet);
    turntable.made(&["--set", "comp.weights.TT=3"], &ffmpeg);
    assert_eq!(std::fs::read(turntable.at("sheet.png")).unwrap(), sheet);

    let slower = turntable.made(&["--set", "comp.weights.TT=3", "--set", "page.size=32"], &ffmpeg);
    assert_eq!(slower, ["index.html"]);
}

#[test]
fn comp_says_what_previews_show_and_keeps_numbers() {
    let turntable = Turntable::new();
    turntable.made(&["--set", "comp.weights.TT=3"], Path::new("/nowhere/ffmpeg"));
    let frames: Vec<PathBuf> = (1..=2).map(|n| turntable.at(&format!("frames/b/frame.000{n}.exr"))).collect();
    let frames: Vec<&str> = frames.iter().map(|path| path.to_str().unwrap()).collect();
    let comp = |arguments: &[&str], out: &str| {
        let out = turntable.at(out);
        let all = [&["comp"], &frames[..], arguments, &["-o", out.to_str().unwrap()]].concat();
        run("turntable", &all)
    };
    let output = comp(&["--weight", "tt=3", "--background", "0.18,0.18,0.18", "--json"], "c.####.png");
    assert!(output.status.success(), "{}", words(&output));
    for number in ["0001", "0002"] {
        let own = std::fs::read(turntable.at(&format!("c.{number}.png"))).unwrap();
        let preview = std::fs::read(turntable.at(&format!("frames/b/frame.{number}.png"))).unwrap();
        assert!(own == preview, "frame {number}: comp and the preview show the same");
    }
    let done: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(done[0]["passes_off_by"].as_f64().unwrap() < 1e-6, "the passes add up: {done}");

    // Light that was taken out is gone, and what comes out is a frame again whose passes add up.
    assert!(comp(&["--weight", "TT=0,R=2"], "d.##.exr").status.success());
    let again = turntable.at("d.01.exr");
    let out = turntable.at("e.png");
    let output = run("turntable", &["comp", again.to_str().unwrap(), "--json", "-o", out.to_str().unwrap()]);
    let done: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(done[0]["passes_off_by"].as_f64().unwrap() < 1e-6, "{done}");

    for (arguments, out, said) in [
        (&["--weight", "surface=2"][..], "f.#.png", "no pass `surface`"),
        (&["--weight", "TTT=2"], "f.#.png", "no pass is called `TTT`"),
        (&[], "f.png", "####"),
        (&[], "frames/b/frame.####.exr", "written over"),
        (&["--background", "#12"], "f.#.png", "#rrggbb"),
        (&["--exposure", "1e9"], "f.#.png", "-64..=64"),
        (&["--curve", "clip"], "f.#.exr", "--curve is for a .png"),
        (&["--fit", "whole"], "f.#.png", "--background"),
        (&[], "f.#.jpg", ".exr or .png"),
    ] {
        let output = comp(arguments, out);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(words(&output).contains(said), "{arguments:?}: {}", words(&output));
    }
}
