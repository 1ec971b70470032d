//! Stages of small pipelines, frame by frame.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use hair_render::Bounds;

use super::{Stage, Store, ingredients};
use crate::expand::expand;
use crate::schema::Pipeline;
use crate::{Event, Options, Reporter, TurntableError};

/// What was said.
#[derive(Default)]
struct Heard(Mutex<Vec<String>>);

impl Reporter for Heard {
    fn event(&self, event: &Event<'_>) {
        if let Event::Warning(words) = event {
            self.0.lock().unwrap().push((*words).to_owned());
        }
    }

    fn advance(&self, _share: f64) {}
}

impl Heard {
    fn words(&self) -> Vec<String> {
        self.0.lock().unwrap().clone()
    }
}

fn samples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples")
}

/// A pipeline that says this beside what every one has to; files are those of the samples.
fn pipeline(text: &str) -> Pipeline {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("turn.yaml");
    let text = text.replace("SAMPLES", &samples().display().to_string());
    let text = format!("version: 1\nrender: {{width: 16, height: 16, spp: 1}}\n{text}");
    std::fs::write(&file, text).unwrap();
    let expanded = expand(&file, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    expanded.variants[0].pipeline.clone()
}

const STILL: &str = "groom: {sample: {strands: 20, points: 5}}\nlights: {environment: {studio: true}}\n";

/// Hair that shakes with its head.
const SHAKING: &str = "groom: {file: SAMPLES/wavy.hair, up: y, meters_per_unit: 1}\n\
    attributes: {max_strands: 40}\nlights: {environment: {constant: [1, 1, 1]}}\n\
    mesh: {file: SAMPLES/nodding_head.glb, animation: Shake}\nbind: {}\n";

fn set<'a>(pipeline: &Pipeline, heard: &'a Heard) -> Result<Stage<'a>, TurntableError> {
    Stage::set(pipeline, Path::new(""), heard, &mut Store::default())
}

/// The box about the scene of a frame, how many keys it has, and where its camera stands.
fn seen(stage: &mut Stage<'_>, number: u32) -> (Bounds, Option<usize>, glam::DVec3) {
    let view = stage.view(number).unwrap();
    (view.scene.bounds().unwrap(), view.scene.motion_keys(), view.camera.at(0.5).position())
}

#[test]
fn one_scene_serves_all_frames_of_a_still_groom_and_all_variants_that_share_it() {
    let (heard, mut store) = (Heard::default(), Store::default());
    let pipeline = pipeline(&format!("{STILL}turntable: {{frames: 4}}\n"));
    let mut stage = Stage::set(&pipeline, Path::new(""), &heard, &mut store).unwrap();
    let first: *const _ = stage.view(1).unwrap().scene;
    assert!(std::ptr::eq(first, stage.view(3).unwrap().scene));
    assert_ne!(seen(&mut stage, 1).2, seen(&mut stage, 2).2);
    let mut finer = pipeline.clone();
    finer.render.spp = 99;
    let mut other = Stage::set(&finer, Path::new(""), &heard, &mut store).unwrap();
    assert!(std::ptr::eq(first, other.view(2).unwrap().scene));
    let mut darker = pipeline.clone();
    darker.lights.environment.as_mut().unwrap().intensity = 0.5;
    let mut dark = Stage::set(&darker, Path::new(""), &heard, &mut store).unwrap();
    assert!(!std::ptr::eq(first, dark.view(2).unwrap().scene));
    assert!(heard.words().is_empty());
}

#[test]
fn bound_hair_goes_with_its_mesh_and_a_frame_is_the_same_whatever_was_before() {
    let heard = Heard::default();
    let with = |motion: &str| {
        pipeline(&format!("{SHAKING}motion: {motion}\nturntable: {{frames: 3, degrees: 0}}\n"))
    };
    let moving = with("{first: 2, step: 5}");
    let mut stage = set(&moving, &heard).unwrap();
    let all: Vec<_> = (1..=3).map(|number| seen(&mut stage, number)).collect();
    assert!(all[0].0 != all[1].0 && all[0].1 == Some(2), "{all:?}");
    assert!(all.iter().all(|(.., camera)| *camera == all[0].2), "one framing for all");
    let mut alone = set(&moving, &heard).unwrap();
    assert_eq!(seen(&mut alone, 3), all[2]);
    let mut sharp = set(&with("{first: 2, step: 5, blur: off}"), &heard).unwrap();
    assert_eq!(seen(&mut sharp, 2).1, None);
    let view = stage.view(2).unwrap();
    assert_eq!((view.frame_rate, view.exposure_seconds), (Some(24.0), Some(0.5 / 24.0)));
    assert!(heard.words().is_empty(), "{:?}", heard.words());
    let mut outside = set(&with("{first: 20, step: 10}"), &heard).unwrap();
    (1..=3).for_each(|number| drop(outside.view(number).unwrap()));
    let words = heard.words();
    assert!(
        words.len() == 1 && words[0].contains("nodding_head.glb: frame 30 is outside 0 to 24"),
        "{words:?}"
    );
}

/// A triangle that goes along x, 10 metres in 4 frames.
const PASSING: &str = "#usda 1.0\n(\n    metersPerUnit = 1\n    timeCodesPerSecond = 24\n    upAxis = \"Y\"\n)\n\
    def Mesh \"M\"\n{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 2]\n    \
    point3f[] points = [(0, 0, 0), (0, 0, 0.1), (0.1, 0, 0)]\n    \
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (10, 0, 0) }\n    \
    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";

#[test]
fn the_camera_sees_all_of_a_motion_in_all_pictures() {
    let heard = Heard::default();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("passing.usda");
    std::fs::write(&file, PASSING).unwrap();
    let cameras = |more: &str| -> Vec<hair_render::Camera> {
        let mesh = format!("mesh: {{file: '{}'}}\nmotion: {{blur: off, step: 2}}\n", file.display());
        let turn = "turntable: {frames: 3, degrees: 0}\n";
        let pipeline = pipeline(&format!("{STILL}{mesh}{turn}{more}"));
        let mut stage = set(&pipeline, &heard).unwrap();
        (1..=3).map(|number| stage.view(number).unwrap().camera.at(0.5)).collect()
    };
    let framed = cameras("");
    assert!(framed.iter().all(|camera| *camera == framed[0]));
    let (position, target) = (framed[0].position(), framed[0].target());
    assert!((target.x - 5.0).abs() < 0.2, "{target}");
    let half = 0.5 * framed[0].vertical_fov();
    for x in [0.0, 5.0, 10.0] {
        let angle = (glam::DVec3::X * x - position).angle_between(target - position);
        assert!(angle < half, "{x}: {angle}");
    }
    let placed = cameras("camera: {target: [1, 0, 0], distance: 3}\n");
    assert_eq!(placed[2].target(), glam::DVec3::X);
}

/// Frames are stale when any file is another that they were made from, and the camera's rate counts.
#[test]
fn what_a_file_names_counts_as_it_does() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let document = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":"my%20mesh.bin"}],
        "images":[{"uri":"skin.png"}]}"#;
    write("a.gltf", document);
    write("my mesh.bin", "a");
    write("skin.png", "a");
    let file = folder.path().join("a.gltf").display().to_string();
    let digest = |more: &str| {
        let pipeline = pipeline(&format!("{STILL}{}", more.replace("FILE", &file)));
        let groom = ingredients::groom(&pipeline, Path::new("")).unwrap();
        ingredients::scene(&pipeline, &groom, Path::new("")).unwrap()
    };
    let (plain, colored, camera) = (
        "mesh: {file: 'FILE'}\n",
        "mesh: {file: 'FILE', base_colors: true}\n",
        "camera: {file: {path: 'FILE'}}\n",
    );
    let all = || [plain, colored, camera].map(digest);
    let before = all();
    write("skin.png", "b");
    let painted = all();
    assert_eq!([0, 1, 2].map(|i| before[i] == painted[i]), [true, false, true]);
    write("my mesh.bin", "b");
    let rebuilt = all();
    assert_eq!([0, 1, 2].map(|i| painted[i] == rebuilt[i]), [false; 3]);
    let rate = |fps: u32| digest(&format!("{camera}motion: {{fps: {fps}}}\n"));
    assert_ne!(rate(24), rate(25));
}

#[test]
fn frames_depend_on_the_animation_where_something_moves() {
    let digests = |pipeline: &Pipeline| {
        let groom = ingredients::groom(pipeline, Path::new("")).unwrap();
        let scene = ingredients::scene(pipeline, &groom, Path::new("")).unwrap();
        (1..=3).map(|n| ingredients::frame(pipeline, &scene, n).as_str().to_owned()).collect::<Vec<_>>()
    };
    let turn = "turntable: {frames: 3, degrees: 0}\n";
    let moving = pipeline(&format!("{SHAKING}motion: {{step: 2}}\n{turn}"));
    let all = digests(&moving);
    assert!(all[0] != all[1] && all[1] != all[2]);
    let mut other = moving.clone();
    other.motion.as_mut().unwrap().first = Some(3.0);
    assert_ne!(digests(&other)[0], all[0]);
    let still = pipeline(&format!("{STILL}motion: {{step: 2}}\n{turn}"));
    let same = digests(&still);
    assert!(same[0] == same[1] && same[1] == same[2]);
    // Half the frames at twice the step are the same pictures.
    let mut half = moving.clone();
    (half.turntable.frames, half.motion.as_mut().unwrap().step) = (2, 4.0);
    assert_eq!(digests(&half)[1], digests(&moving)[2]);
    // More of the motion is framed otherwise, unless the camera has its place.
    let longer = |text: &str, frames: u32| {
        let mut pipeline = moving.clone();
        pipeline.camera = self::pipeline(&format!("{STILL}{text}")).camera;
        pipeline.turntable.frames = frames;
        digests(&pipeline)
    };
    assert_ne!(longer("", 4)[0], all[0]);
    let placed = "camera: {distance: 1, target: [0, 0, 0]}\n";
    assert_eq!(longer(placed, 4), longer(placed, 3));
}

#[test]
fn a_cornell_box_stands_about_the_subject_and_turns_with_the_light() {
    let heard = Heard::default();
    let with = |turn: &str| {
        let text = STILL.replace("environment: {studio: true}", "cornell: {room: 2}");
        pipeline(&format!("{text}turntable: {{frames: 4, turn: {turn}}}\ncamera: {{elevation: 0}}\n"))
    };
    let bare = set(&pipeline(STILL), &heard).unwrap().view(1).unwrap().scene.bounds().unwrap();
    let mut stage = set(&with("groom"), &heard).unwrap();
    let room = stage.view(1).unwrap().scene.bounds().unwrap();
    let edge = 2.0 * (bare.max - bare.min).max_element();
    assert!(((room.max - room.min).max_element() - edge).abs() < 1e-6 * edge);
    assert!((room.min.y - bare.min.y).abs() < 1e-6, "it stands on the floor");
    // A quarter turn later the camera is a quarter on, and so is the box.
    let quarter = stage.view(2).unwrap();
    let camera = quarter.camera.at(0.5);
    assert!(camera.position().x - camera.target().x > 0.5 * edge);
    assert!(heard.words().is_empty());
    let mut outside = set(&with("camera"), &heard).unwrap();
    (1..=4).for_each(|number| drop(outside.view(number).unwrap()));
    let words = heard.words();
    assert!(words.len() == 1 && words[0].contains("turn: groom"), "{words:?}");
}

#[test]
fn the_camera_may_stay_rise_or_be_that_of_a_file() {
    let heard = Heard::default();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("shot.usda");
    let text = "#usda 1.0\n(\n    metersPerUnit = 1\n    timeCodesPerSecond = 24\n    upAxis = \"Y\"\n)\n\
        def Camera \"Cam\"\n{\n    double3 xformOp:translate.timeSamples = { 1: (0, 0, 2), 5: (4, 0, 2) }\n    \
        uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";
    std::fs::write(&file, text).unwrap();
    let positions = |more: &str| -> Vec<glam::DVec3> {
        let pipeline = pipeline(&format!("{STILL}{more}"));
        let mut stage = set(&pipeline, &heard).unwrap();
        (1..=pipeline.turntable.frames).map(|number| seen(&mut stage, number).2).collect()
    };
    let fixed = positions("camera: {position: [1, 2, 3], target: [0, 0, 0]}\nturntable: {frames: 2}\n");
    assert_eq!(fixed, [glam::DVec3::new(1.0, 2.0, 3.0); 2]);
    let path = file.display();
    let filmed =
        positions(&format!("camera: {{file: {{path: '{path}', name: Cam}}}}\nturntable: {{frames: 3}}\n"));
    let expected = [0.0, 1.0, 2.0].map(|x| glam::DVec3::new(x, 0.0, 2.0));
    assert!(filmed.iter().zip(expected).all(|(a, b)| (*a - b).length() < 1e-9), "{filmed:?}");
    assert!(
        heard.words()[0].contains("the camera's picture is 1.370 as wide as high"),
        "{:?}",
        heard.words()
    );
    let rising = positions("camera: {elevation: 0, elevation_to: 60}\nturntable: {frames: 3, degrees: 0}\n");
    assert!(rising[0].y < rising[1].y && rising[1].y < rising[2].y);
    let blurred = pipeline(&format!("{STILL}camera: {{blur: true}}\nturntable: {{frames: 4}}\n"));
    let mut stage = set(&blurred, &heard).unwrap();
    let view = stage.view(2).unwrap();
    assert!(view.camera.moves() && view.exposure_seconds.is_some());
}
