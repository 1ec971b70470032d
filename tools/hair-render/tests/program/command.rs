//! Exit codes, streams, and what it leaves on the disk.

use std::process::Command;

use crate::support::*;

#[test]
fn a_picture_its_preview_and_nothing_but_json_on_stdout() {
    let folder = folder("picture");
    let small = ["--width", "16", "--height", "12", "--spp", "2", "--json", "--explain"];
    let done = run(&folder, &[&small[..], &["-o", "a b.exr", "--png", "a.png"]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!((report["spp"].as_u64(), report["samples"].as_u64()), (Some(2), Some(16 * 12 * 2)));
    assert!(report["relative_error"].is_f64() && report["seconds"].is_f64());
    assert_eq!(names(&folder), ["a b.exr", "a.png"]);
    let exr = std::fs::read(folder.join("a b.exr")).unwrap();
    let told = b"--json --explain -o 'a b.exr' --png a.png";
    assert!(exr.windows(told.len()).any(|w| w == told), "the command as it was given");

    let quiet = run(&folder, &["--width", "4", "--height", "4", "--spp", "1", "-o", "q.exr"]);
    assert!(quiet.status.success() && quiet.stdout.is_empty());
}

#[test]
fn materials_come_from_files_and_presets() {
    let folder = folder("materials");
    let small = ["--width", "8", "--height", "8", "--spp", "1"];
    std::fs::write(folder.join("own.yaml"), "preset: human-red\nvariation: {white: 0.2}\n").unwrap();
    for (material, picture) in
        [(["--material", "own.yaml"], "own.exr"), (["--preset", "human-red"], "red.exr")]
    {
        let done = run(&folder, &[&small[..], &material, &["-o", picture]].concat());
        assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    }
    assert_eq!(names(&folder), ["own.exr", "own.yaml", "red.exr"]);
    std::fs::write(folder.join("bad.yaml"), "beta_m: 0.3\nbeta_n: 7\n").unwrap();
    for (arguments, says) in [
        (&["--material", "bad.yaml"][..], "bad.yaml:2:9: beta_n: must lie in [0.001, 1], found 7"),
        (&["--material", "none.yaml"], "none.yaml"),
        (&["--preset", "human-bron"], "human-brown"),
        (&["--preset", "human-red", "--color", "1,1,1"], "--color"),
        (&["--material", "own.yaml", "--beta-m", "0.3"], "--beta-m"),
    ] {
        let refused = run(&folder, &[&FOREVER, arguments, &["-o", "no.exr"]].concat());
        let words = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {words}");
        assert!(words.contains(says), "{arguments:?}: {words}");
    }
    let list = Command::new(env!("CARGO_BIN_EXE_hair-render")).arg("--list-presets").output().unwrap();
    assert!(String::from_utf8(list.stdout).unwrap().contains("fur-kappa-0.86: Yan et al. 2017"));
}

#[test]
fn what_cannot_be_written_is_refused_before_rendering() {
    let folder = folder("refused");
    for (output, says) in [
        (&["-o", "no/such/a.exr"][..], "no/such/a.exr"),
        (&["-o", "a.png"], ".exr"),
        (&["-o", "a.exr", "--png", "a.jpg"], ".png"),
        (&["-o", "a.exr", "--width", "0"], "width"),
        (&["-o", "a.exr", "--mesh", "none.obj"], "none.obj"),
        (&["-o", "a.exr", "--env", "none.hdr"], "none.hdr"),
        (&["-o", "a.exr", "--aovs", "glint"], "glint"),
        (&["-o", "a.exr", "--env-intensity=-1"], "--env-intensity"),
        (&["-o", "a.exr", "--env-rotate", "inf"], "--env-rotate"),
        (&["-o", "a.exr", "--exposure", "nan"], "--exposure is NaN, expected -64..=64 stops"),
        (&["-o", "a.exr", "--distance=-2"], "distance"),
        (&["-o", "a.exr", "--crop", "0.5,0.2,0,1"], "crop"),
        (&["-o", "a.exr", "--time-limit", "0"], "--time-limit"),
        (&["-o", "a.exr", "--checkpoint-every", "5"], "--checkpoint-every"),
        (&["-o", "a.exr", "--json", "--progress", "alf"], "stdout"),
        (&["-o", "a.exr", "--no-such-flag"], "--no-such-flag"),
        (&["--png", "a.png"], "--output"),
    ] {
        let refused = run(&folder, &[&FOREVER, output].concat());
        let words = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{output:?}: {words}");
        assert!(words.contains(says) && refused.stdout.is_empty(), "{output:?}: {words}");
        assert!(names(&folder).is_empty(), "{output:?}");
    }
}

#[test]
fn a_matched_colour_is_reported_with_both_errors() {
    let folder = folder("matched");
    let small =
        ["--width", "8", "--height", "8", "--spp", "2", "--max-bounces", "4", "-o", "a.exr", "--json"];
    let done = run(&folder, &[&small[..], &["--color", "0.4,0.2,0.1", "--match-color"]].concat());
    let words = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(0), "{words}");
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let found = &report["color_match"];
    assert!(found["error"].as_f64().unwrap() < found["fit_error"].as_f64().unwrap(), "{found}");
    assert!(words.contains("Chiang's fit") && report["spp"] == 2, "{words}");
    std::fs::write(folder.join("one.yaml"), "color: [0.4, 0.2, 0.1]\nalpha: 2\n").unwrap();
    let by_file = run(&folder, &[&small[..], &["--material", "one.yaml", "--match-color"]].concat());
    let again: serde_json::Value = serde_json::from_slice(&by_file.stdout).unwrap();
    assert_eq!(again["color_match"]["absorption"], found["absorption"], "the same colour, said in a file");
}

#[test]
fn what_is_not_one_colour_cannot_be_matched() {
    let folder = folder("unmatched");
    std::fs::write(folder.join("ramp.yaml"), "color_ramp: [[0, [1, 0, 0]], [1, [0, 1, 0]]]\n").unwrap();
    std::fs::write(folder.join("white.yaml"), "color: [0.4, 0.2, 0.1]\nvariation: {white: 0.2}\n").unwrap();
    for (arguments, says) in [
        (&["--match-color"][..], "groom's own colour"),
        (&["--match-color", "--melanin", "0.5,0.5"], "melanin"),
        (&["--match-color", "--absorption", "0.1"], "an absorption"),
        (&["--match-color", "--preset", "human-red"], "melanin"),
        (&["--match-color", "--material", "ramp.yaml"], "root to tip"),
        (&["--match-color", "--material", "white.yaml"], "variation"),
        (&["--match-color", "--color", "2,0,0"], "the colour of the hair is"),
    ] {
        let refused = run(&folder, &[&FOREVER, arguments, &["-o", "no.exr"]].concat());
        let words = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {words}");
        assert!(words.contains(says), "{arguments:?}: {words}");
        assert_eq!(names(&folder), ["ramp.yaml", "white.yaml"]);
    }
}
