//! Cameras of glTF files and USD stages; USD's beside GfCamera of usd-core.

use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use glam::{DQuat, DVec3};
use moving_mesh::{AnimationChoice, CameraChoice, CameraFile, CameraOptions, CameraPose, MeshError};

use crate::support::{Gltf, glb, skipped};

fn open_with(name: &str, bytes: &[u8], options: &CameraOptions) -> Result<CameraFile, MeshError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    CameraFile::open(&path, options)
}

fn open(name: &str, bytes: &[u8], camera: CameraChoice) -> Result<CameraFile, MeshError> {
    open_with(name, bytes, &CameraOptions { camera, ..CameraOptions::default() })
}

fn named(name: &str) -> CameraChoice {
    CameraChoice::Name(name.to_owned())
}

/// An arm that turns by 90 degrees about y in two seconds from second 1 on, bears a camera, and another camera that
/// stands. The first animation moves neither.
fn gltf() -> Vec<u8> {
    let half = FRAC_1_SQRT_2 as f32;
    let mut gltf = Gltf::default();
    let times = gltf.floats("SCALAR", &[1.0, 3.0]);
    let turns = gltf.floats("VEC4", &[0., 0., 0., 1., 0., half, 0., half]);
    let ways = gltf.floats("VEC3", &[0., 0., 0., 1., 1., 1.]);
    gltf.file(&format!(
        r#""scene":0,"scenes":[{{"nodes":[0,2,3]}}],
        "nodes":[{{"name":"Arm","children":[1],"scale":[2,2,2]}},
            {{"name":"Turning","camera":0,"translation":[0,0,5]}},
            {{"name":"Standing","camera":1,"translation":[1e6,2,0]}},
            {{"name":"Ball"}},{{"name":"Outside","camera":0}}],
        "cameras":[{{"name":"Lens","type":"perspective","perspective":{{"yfov":0.5,"znear":0.1,"aspectRatio":1.5}}}},
            {{"type":"perspective","perspective":{{"yfov":1.0,"znear":0.1}}}}],
        "animations":[
            {{"name":"bounce","samplers":[{{"input":{times},"output":{ways}}}],
              "channels":[{{"sampler":0,"target":{{"node":3,"path":"translation"}}}}]}},
            {{"name":"swing","samplers":[{{"input":{times},"output":{turns}}}],
              "channels":[{{"sampler":0,"target":{{"node":0,"path":"rotation"}}}}]}}]"#
    ))
}

#[test]
fn a_gltf_camera_goes_with_its_nodes() {
    let camera = open("a.glb", &gltf(), CameraChoice::First).unwrap();
    assert_eq!(camera.names(), ["Turning", "Standing"]);
    assert_eq!(
        (camera.name(), camera.time_range(), camera.frame_rate()),
        ("Turning", Some((1.0, 3.0)), Some(24.0))
    );
    for (time, degrees) in [(0.0, 0.0), (1.0, 0.0), (1.5, 22.5), (2.0, 45.0), (3.0, 90.0), (9.0, 90.0_f64)] {
        let CameraPose { world, vertical_fov, aspect } = camera.at(time).unwrap();
        let turn = DQuat::from_rotation_y(degrees.to_radians());
        let pose = camera.at(time).unwrap();
        // The arm's scale moves the camera out and leaves its view alone.
        assert!((pose.position() - turn * DVec3::Z * 10.0).length() < 1e-6, "{time}: {world}");
        assert!((pose.forward() + turn * DVec3::Z).length() < 1e-7, "{time}");
        assert!((pose.up() - DVec3::Y).length() < 1e-7, "{time}");
        assert_eq!((vertical_fov, aspect), (0.5, Some(1.5)));
    }
    assert!(camera.at(f64::NAN).unwrap_err().to_string().contains("finite"));
}

#[test]
fn cameras_are_chosen_by_name_and_number_and_others_refused() {
    let file = gltf();
    let name = |choice| open("a.glb", &file, choice).unwrap().name().to_owned();
    assert_eq!(name(named("Standing")), "Standing");
    assert_eq!(name(CameraChoice::Index(1)), "Standing");
    assert_eq!(name(named("Lens")), "Turning", "the camera's own name");
    let standing = open("a.glb", &file, named("Standing")).unwrap();
    assert_eq!(standing.time_range(), None);
    assert_eq!(standing.at(2.0).unwrap().position(), DVec3::new(1e6, 2.0, 0.0));
    assert_eq!(standing.at(2.0).unwrap().aspect, None);
    let told = open("a.glb", &file, named("Outside")).unwrap_err().to_string();
    assert!(told.ends_with(r#"no camera "Outside"; it has 0 "Turning", 1 "Standing""#), "{told}");
    let told = open("a.glb", &file, CameraChoice::Index(2)).unwrap_err();
    assert!(matches!(&told, MeshError::NoCamera { asked, .. } if asked == " number 2"), "{told}");
    let told = open("a.obj", &file, CameraChoice::First).unwrap_err();
    assert!(matches!(told, MeshError::Unsupported { .. }), "{told}");
}

#[test]
fn the_animation_of_a_camera_can_be_named() {
    let file = gltf();
    let range = |animation| {
        let options = CameraOptions { animation, ..CameraOptions::default() };
        open_with("a.glb", &file, &options).map(|camera| camera.time_range())
    };
    assert_eq!(range(AnimationChoice::First).unwrap(), Some((1.0, 3.0)));
    assert_eq!(range(AnimationChoice::Name("swing".into())).unwrap(), Some((1.0, 3.0)));
    assert_eq!(range(AnimationChoice::Index(0)).unwrap(), None, "it moves the ball");
    assert_eq!(range(AnimationChoice::None).unwrap(), None);
    assert!(matches!(range(AnimationChoice::Name("jump".into())), Err(MeshError::NoAnimation { .. })));
}

/// A glTF file of one camera.
fn lens(camera: &str) -> Result<CameraPose, MeshError> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"camera":0}}],"cameras":[{camera}]}}"#
    );
    open("a.glb", &glb(json.as_bytes(), &[]), CameraChoice::First)?.at(0.0)
}

#[test]
fn gltf_cameras_that_show_nothing_are_refused() {
    assert!(lens(r#"{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1}}"#).is_ok());
    let told = lens(r#"{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":0.1}}"#);
    assert!(matches!(told, Err(MeshError::Unsupported { .. })), "{told:?}");
    for broken in [
        r#"{"type":"perspective"}"#,
        r#"{"type":"perspective","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":0.1}}"#,
        r#"{"type":"fisheye","perspective":{"yfov":0.7,"znear":0.1}}"#,
        r#"{"type":"perspective","perspective":{"yfov":0,"znear":0.1}}"#,
        r#"{"type":"perspective","perspective":{"yfov":3.2,"znear":0.1}}"#,
    ] {
        assert!(matches!(lens(broken), Err(MeshError::Invalid { .. })), "{broken}: {:?}", lens(broken));
    }
    let none = glb(br#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]}"#, &[]);
    let told = open("a.glb", &none, CameraChoice::First).unwrap_err().to_string();
    assert!(told.ends_with("no camera; it has none"), "{told}");
}

/// A stage with a camera of these members, below a transform.
fn stage(members: &str) -> String {
    format!(
        r#"#usda 1.0
(
    metersPerUnit = 0.01
    timeCodesPerSecond = 10
    upAxis = "Z"
)
def Xform "Rig"
{{
    double3 xformOp:translate.timeSamples = {{ 0: (0, 0, 0), 20: (0, 0, 200) }}
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Camera "Cam"
    {{
        {members}
    }}
}}
def Camera "Other"
{{
}}
"#
    )
}

fn usd(members: &str) -> Result<CameraFile, MeshError> {
    open("a.usda", stage(members).as_bytes(), CameraChoice::First)
}

#[test]
fn a_usd_camera_is_in_metres_with_y_up() {
    let lens = "float focalLength = 25\n float horizontalAperture = 36\n float verticalAperture.timeSamples = { 0: 24, 20: 12 }";
    let camera = usd(lens).unwrap();
    assert_eq!(camera.names(), ["/Rig/Cam", "/Other"]);
    assert_eq!((camera.time_range(), camera.frame_rate()), (Some((0.0, 2.0)), Some(10.0)));
    let pose = camera.at(1.0).unwrap();
    // One metre up the stage's z; the camera looks along its own -z, which is down.
    assert!((pose.position() - DVec3::Y).length() < 1e-12, "{pose:?}");
    assert!(
        (pose.forward() + DVec3::Y).length() < 1e-12 && (pose.up() + DVec3::Z).length() < 1e-12,
        "{pose:?}"
    );
    assert!((pose.vertical_fov - 2.0 * (18.0_f64 / 50.0).atan()).abs() < 1e-12);
    assert_eq!(pose.aspect, Some(2.0));
    assert_eq!(camera.at(99.0).unwrap(), camera.at(2.0).unwrap());
    // What UsdGeomCamera says where the file does not.
    let plain = open("a.usda", stage("").as_bytes(), named("Other")).unwrap();
    assert_eq!(plain.time_range(), None);
    let pose = plain.at(5.0).unwrap();
    assert!((pose.vertical_fov - 2.0 * (15.2908_f64 / 100.0).atan()).abs() < 1e-12);
}

#[test]
fn one_sample_lies_over_what_stands_without_it() {
    let place = "double3 xformOp:translate = (0, 0, 0)\n double3 xformOp:translate.timeSamples = { 5: (0, 0, 300) }\n \
        uniform token[] xformOpOrder = [\"xformOp:translate\"]\n float focalLength = 50\n \
        float focalLength.timeSamples = { 5: 25 }";
    let still = stage(place).replace("0: (0, 0, 0), 20: (0, 0, 200)", "0: (0, 0, 0)");
    let open = |animation| {
        let options = CameraOptions { animation, ..CameraOptions::default() };
        open_with("a.usda", still.as_bytes(), &options).unwrap()
    };
    let sampled = open(AnimationChoice::First);
    for time in [0.0, 0.5, 9.0] {
        let pose = sampled.at(time).unwrap();
        assert!((pose.position() - DVec3::Y * 3.0).length() < 1e-12, "{time}: {pose:?}");
        assert!((pose.vertical_fov - 2.0 * (15.2908_f64 / 50.0).atan()).abs() < 1e-12, "{time}: {pose:?}");
    }
    assert_eq!(open(AnimationChoice::None).at(0.5).unwrap().position(), DVec3::ZERO);
}

#[test]
fn usd_cameras_that_cannot_be_shown_are_refused() {
    let is_unsupported = |members| matches!(usd(members), Err(MeshError::Unsupported { .. }));
    assert!(is_unsupported("token projection = \"orthographic\""));
    assert!(is_unsupported("float horizontalApertureOffset = 1"));
    assert!(is_unsupported("float verticalApertureOffset.timeSamples = { 0: 0, 1: 2 }"));
    assert!(usd("float verticalApertureOffset = 0\n token projection = \"perspective\"").is_ok());
    assert!(matches!(usd("token projection = \"fisheye\""), Err(MeshError::Invalid { .. })));
    for broken in ["float focalLength = 0", "float verticalAperture = -1", "float focalLength = inf"] {
        let told = usd(broken).unwrap().at(0.0).unwrap_err().to_string();
        assert!(told.contains("camera \"/Rig/Cam\""), "{told}");
    }
    let flat = "double3 xformOp:scale = (1, 1, 0)\n uniform token[] xformOpOrder = [\"xformOp:scale\"]";
    assert!(matches!(usd(flat).unwrap().at(0.0), Err(MeshError::Invalid { .. })));
}

#[test]
fn what_composition_could_change_is_not_guessed() {
    let with = |text: &str, choice| open("a.usda", text.as_bytes(), choice);
    let elsewhere = stage("").replace("def Camera \"Other\"", "def \"Set\" (references = @set.usda@)");
    // The rig's own camera is whole whatever the set is.
    assert!(with(&elsewhere, named("Cam")).is_ok());
    let told = with(&elsewhere, named("Other")).unwrap_err();
    assert!(matches!(told, MeshError::Unsupported { .. }), "{told}");
    assert!(told.to_string().contains("a camera \"Other\" that comes by composition"), "{told}");
    let below = stage("").replace("def Xform \"Rig\"", "def Xform \"Rig\" (references = @rig.usda@)");
    assert!(matches!(with(&below, named("Cam")), Err(MeshError::Unsupported { .. })));
    assert!(with(&below, named("Other")).is_ok());
    let layered = stage("").replace("upAxis = \"Z\"", "upAxis = \"Z\"\n    subLayers = [@under.usda@]");
    assert!(matches!(with(&layered, named("Other")), Err(MeshError::Unsupported { .. })));
}

/// Prints, for every camera and time, place, direction, up and vertical field of view as GfCamera has them.
const GF_CAMERA: &str = r#"
import sys
from pxr import Gf, Usd, UsdGeom

stage = Usd.Stage.Open(sys.argv[1])
for prim in stage.Traverse():
    if prim.IsA(UsdGeom.Camera):
        for time in map(float, sys.argv[2:]):
            camera = UsdGeom.Camera(prim).GetCamera(time)
            frustum = camera.frustum
            vectors = frustum.GetPosition(), frustum.ComputeViewDirection(), frustum.ComputeUpVector()
            fov = camera.GetFieldOfView(Gf.Camera.FOVVertical)
            print(prim.GetPath(), time, *(x for v in vectors for x in v), fov)
"#;

/// Numbers that look random and are the same each time.
struct Lots(u64);

impl Lots {
    fn next(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn triple(&mut self, low: f64, high: f64) -> String {
        format!("({}, {}, {})", self.next(low, high), self.next(low, high), self.next(low, high))
    }
}

/// Cameras below rigs, each with other ops that move.
fn rigs(z_up: bool) -> String {
    let mut lots = Lots(7);
    let axis = if z_up { "Z" } else { "Y" };
    let mut text = format!(
        "#usda 1.0\n(\n    metersPerUnit = 0.01\n    timeCodesPerSecond = 24\n    upAxis = \"{axis}\"\n)\n"
    );
    for i in 0..8 {
        let turn = ["XYZ", "ZYX", "YXZ", "XZY"][i % 4];
        let far = if i == 5 { 1e8 } else { 100.0 };
        write!(
            text,
            r#"def Xform "Rig{i}"
{{
    double3 xformOp:translate.timeSamples = {{ 0: {}, 12: {}, 24: {} }}
    float3 xformOp:rotate{turn}.timeSamples = {{ 3: {}, 20: {} }}
    double3 xformOp:scale = {}
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotate{turn}", "xformOp:scale"]
    def Camera "Cam"
    {{
        double3 xformOp:translate = {}
        float xformOp:rotateX.timeSamples = {{ 0: {}, 24: {} }}
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
        float focalLength.timeSamples = {{ 0: {}, 24: {} }}
        float verticalAperture = {}
    }}
}}
"#,
            lots.triple(-far, far),
            lots.triple(-far, far),
            lots.triple(-far, far),
            lots.triple(-180.0, 180.0),
            lots.triple(-180.0, 180.0),
            if i % 2 == 0 { "(3, 3, 3)".to_owned() } else { "(1, 1, 1)".to_owned() },
            lots.triple(-50.0, 50.0),
            lots.next(-80.0, 80.0),
            lots.next(-80.0, 80.0),
            lots.next(10.0, 90.0),
            lots.next(10.0, 90.0),
            lots.next(5.0, 30.0),
        )
        .unwrap();
    }
    text
}

fn python() -> Option<PathBuf> {
    let inside = if cfg!(windows) { "target/venv/Scripts/python.exe" } else { "target/venv/bin/python" };
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(inside);
    if python.is_file() {
        return Some(python);
    }
    skipped("usd-core is not in target/venv; GfCamera judges no camera");
    None
}

#[test]
fn usd_cameras_are_where_gf_camera_has_them() {
    let Some(python) = python() else { return };
    let times = [-5.0, 0.0, 1.5, 12.0, 17.25, 24.0, 40.0];
    for z_up in [false, true] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rigs.usda");
        fs::write(&path, rigs(z_up)).unwrap();
        let words = times.map(|time: f64| time.to_string());
        let run = Command::new(&python).args(["-c", GF_CAMERA]).arg(&path).args(&words).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let mut judged = 0;
        for line in String::from_utf8_lossy(&run.stdout).lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let n: Vec<f64> = words[1..].iter().map(|word| word.parse().unwrap()).collect();
            let options = CameraOptions { camera: named(words[0]), ..CameraOptions::default() };
            let pose = CameraFile::open(&path, &options).unwrap().at(n[0] / 24.0).unwrap();
            let turned = |i: usize| {
                if z_up {
                    DVec3::new(n[i], n[i + 2], -n[i + 1])
                } else {
                    DVec3::new(n[i], n[i + 1], n[i + 2])
                }
            };
            let place = turned(1) * 0.01;
            // usd-core blends turns in single precision.
            assert!((pose.position() - place).length() <= 1e-6 + 1e-12 * place.length(), "{line} {pose:?}");
            assert!((pose.forward() - turned(4)).length() < 1e-6, "{line} {pose:?}");
            assert!((pose.up() - turned(7)).length() < 1e-6, "{line} {pose:?}");
            assert!((pose.vertical_fov.to_degrees() - n[10]).abs() < 1e-4, "{line} {pose:?}");
            judged += 1;
        }
        assert_eq!(judged, 8 * times.len());
    }
}
