//! Frames, shutters and cameras that move.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::*;

const SMALL: [&str; 7] = ["--width", "12", "--height", "12", "--spp", "2", "--json"];

/// Two strands that go up: from frame 1 to frame 3 by two units a frame, at 10 frames a second.
fn moving(folder: &Path, velocities: bool) -> PathBuf {
    let points = |up: i32| {
        let at = |x: i32, y: i32| format!("({x}, {}, 0)", y + up);
        [at(0, 0), at(0, 1), at(1, 0), at(1, 1)].join(", ")
    };
    let velocities = if velocities {
        "vector3f[] velocities = [(0, 20, 0), (0, 20, 0), (0, 20, 0), (0, 20, 0)]"
    } else {
        ""
    };
    let text = format!(
        r#"#usda 1.0
(
    endTimeCode = 3
    metersPerUnit = 1
    startTimeCode = 1
    timeCodesPerSecond = 10
    upAxis = "Y"
)

def BasisCurves "hair"
{{
    int[] curveVertexCounts = [2, 2]
    point3f[] points.timeSamples = {{
        1: [{}],
        3: [{}],
    }}
    uniform token type = "linear"
    {velocities}
    float[] widths = [0.2] (
        interpolation = "constant"
    )
}}
"#,
        points(0),
        points(4)
    );
    let path = folder.join("moving.usda");
    std::fs::write(&path, text).unwrap();
    path
}

/// The report of a picture of `groom`.
fn report(groom: &Path, folder: &Path, arguments: &[&str]) -> Value {
    let arguments = [&SMALL[..], &["-o", "a.exr"], arguments].concat();
    let done = command_on(groom, folder, &arguments).output().unwrap();
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    serde_json::from_slice(&done.stdout).unwrap()
}

#[test]
fn a_frame_of_a_moving_groom_is_blurred_and_says_so() {
    let folder = folder("blurred");
    let groom = moving(&folder, false);
    let told = report(&groom, &folder, &["--frame", "2", "--shutter", "0.5", "--shutter-shape", "triangle"]);
    let motion = &told["motion"];
    assert_eq!(
        (motion["shutter_open"].as_f64(), motion["shutter_close"].as_f64()),
        (Some(-0.25), Some(0.25))
    );
    assert_eq!((motion["keys"].as_u64(), motion["shutter_shape"].as_str()), (Some(2), Some("triangle")));
    assert_eq!((told["frame"].as_f64(), told["frame_rate"].as_f64()), (Some(2.0), Some(10.0)));
    assert_eq!(told["exposure_seconds"].as_f64(), Some(0.05));
    assert!(told["blur"]["scene_bytes"].as_u64() > Some(0), "{told}");
    let exr = std::fs::read(folder.join("a.exr")).unwrap();
    for words in [&b"-0.25:0.25 triangle"[..], b"motionKeys", b"expTime", b"framesPerSecond"] {
        assert!(exr.windows(words.len()).any(|w| w == words), "{}", String::from_utf8_lossy(words));
    }
    let five = report(&groom, &folder, &["--frame", "2", "--motion-samples", "5"]);
    assert_eq!(five["motion"]["keys"].as_u64(), Some(5));
    // Beyond its last frame the groom stands as it does there.
    for still in [&["--frame", "2", "--blur", "off"][..], &["--shutter", "0.1:0.1"], &["--frame", "40"]] {
        let told = report(&groom, &folder, still);
        assert!(told["motion"].is_null() && told["blur"].is_null(), "{still:?}: {told}");
    }
}

#[test]
fn velocities_blur_where_a_file_has_them() {
    let folder = folder("velocities");
    let groom = moving(&folder, true);
    let options = ["--frame", "2", "--max-bounces", "1", "--motion-samples", "2", "--distance", "9"];
    let pixels = |more: &[&str]| {
        report(
            &groom,
            &folder,
            &[&options[..], &["--look-at", "0.5,2.5,0", "--png", "a.png"], more].concat(),
        );
        std::fs::read(folder.join("a.png")).unwrap()
    };
    // At a steady speed the velocities lead where the positions are: the same picture, bit for bit.
    let by_default = pixels(&[]);
    assert!(by_default == pixels(&["--blur", "velocities"]));
    assert!(by_default == pixels(&["--blur", "positions"]));
    assert!(by_default != pixels(&["--blur", "off"]));
    // A frame of the file stays one, whatever the picture's rate.
    assert!(by_default == pixels(&["--fps", "5"]));
    assert!(by_default == pixels(&["--fps", "5", "--blur", "positions"]));
}

/// Before its first and after its last frame a groom stands, also by velocities, and the user hears of it.
#[test]
fn frames_that_are_not_there_are_told_and_not_blurred() {
    let folder = folder("outside");
    let groom = moving(&folder, true);
    for (frame, outside) in [("40", true), ("0.5", true), ("1", false), ("3", false)] {
        let arguments = [&SMALL[..], &["-o", "a.exr", "--frame", frame]].concat();
        let done = command_on(&groom, &folder, &arguments).output().unwrap();
        let told: Value = serde_json::from_slice(&done.stdout).unwrap();
        assert_eq!(told["motion"].is_null(), outside, "{frame}: {told}");
        let words = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(words.contains(&format!("frame {frame} is outside 1 to 3")), outside, "{words}");
    }
    let head = sample("nodding_head.glb").display().to_string();
    let arguments = [&SMALL[..], &["-o", "a.exr", "--frame", "2000", "--mesh", &head]].concat();
    let done = command_on(&sample("straight.hair"), &folder, &arguments).output().unwrap();
    let words = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(words.contains("nodding_head.glb: frame 2000 is outside"), "{words}");
}

#[test]
fn meshes_move_beside_a_groom_that_does_not() {
    let folder = folder("mesh");
    let head = sample("nodding_head.glb").display().to_string();
    let groom = sample("straight.hair");
    let with = |more: &[&str]| report(&groom, &folder, &[&["--mesh", &head][..], more].concat());
    assert!(with(&[])["motion"].is_null(), "no frame: as the file stands");
    let nods = with(&["--frame", "4", "--mesh-animation", "Nod"]);
    assert_eq!((nods["motion"]["keys"].as_u64(), nods["frame_rate"].as_f64()), (Some(2), Some(24.0)));
    assert_eq!(
        with(&["--frame", "4", "--mesh-animation", "1", "--motion-samples", "3"])["motion"]["keys"],
        3
    );
}

#[test]
fn a_camera_turns_while_the_shutter_is_open() {
    let folder = folder("camera");
    let groom = sample("straight.hair");
    let turns = report(&groom, &folder, &["--azimuth", "10", "--azimuth-to", "20", "--fov-to", "25"]);
    assert_eq!((turns["motion"]["camera_keys"].as_u64(), turns["motion"]["keys"].as_u64()), (Some(2), None));
    let goes = report(&groom, &folder, &["--from", "0,0,1", "--from-to", "0.1,0,1"]);
    assert_eq!(goes["motion"]["camera_keys"].as_u64(), Some(2));
    assert!(report(&groom, &folder, &["--azimuth", "10", "--azimuth-to", "10"])["motion"].is_null());
}

#[test]
fn what_cannot_be_blurred_is_refused_with_what_can() {
    let folder = folder("unblurred");
    let groom = moving(&folder, false);
    let head = sample("nodding_head.glb").display().to_string();
    for (arguments, says) in [
        (&["--blur", "velocities"][..], "has no velocities; expected positions"),
        (&["--blur", "accelerations"], "has no velocities and accelerations; expected positions"),
        (&["--shutter", "0.5:0.25"], "shutter closing is 0.25, expected the opening or later"),
        (&["--shutter", "a"], "OPEN:CLOSE"),
        (&["--shutter-shape", "oval"], "shutter shape is oval, expected box"),
        (&["--motion-samples", "1"], "2..=1025"),
        (&["--fps", "0"], "frame rate is 0"),
        (&["--frame", "nan"], "--frame is NaN, expected a finite number"),
        (&["--blur", "off", "--azimuth-to", "3"], "--azimuth-to"),
        (&["--shutter", "0", "--azimuth-to", "3"], "a shutter of 0:0 leaves no time for --azimuth-to"),
        (&["--from-to", "1,2,3"], "--from"),
        (&["--from", "0,0,9", "--azimuth-to", "3"], "--azimuth-to"),
        (&["--mesh", &head, "--mesh-animation", "Jump"], "Jump"),
    ] {
        let arguments = [&FOREVER[..], &["-o", "no.exr"], arguments].concat();
        let refused = command_on(&groom, &folder, &arguments).output().unwrap();
        let words = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {words}");
        assert!(words.contains(says), "{arguments:?}: {words}");
    }
    let still = command(&folder, &["-o", "no.exr", "--blur", "positions"]).output().unwrap();
    let words = String::from_utf8_lossy(&still.stderr).into_owned();
    assert!(still.status.code() == Some(2) && words.contains("expected off: nothing in it moves"), "{words}");
    assert_eq!(names(&folder), ["moving.usda"]);
}

#[test]
fn what_does_not_move_is_left_out() {
    let folder = folder("left_out");
    let arguments =
        ["--width", "4", "--height", "4", "--spp", "1", "--shutter", "1", "-o", "a.exr", "--explain"];
    let told = String::from_utf8(run(&folder, &arguments).stderr).unwrap();
    for what in ["motion in the tree", "a lens for each sample", "times of samples"] {
        assert!(told.contains(&format!("left out: {what}")), "{told}");
    }
    let groom = moving(&folder, false);
    let done = command_on(&groom, &folder, &[&arguments[..], &["--frame", "2"]].concat()).output().unwrap();
    let told = String::from_utf8(done.stderr).unwrap();
    assert!(!told.contains("motion in the tree") && !told.contains("times of samples"), "{told}");
}
