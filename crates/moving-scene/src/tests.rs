//! Strands and meshes at frames whose answers are known.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use glam::{DVec3, Vec3};
use groom::Groom;
use hair_render::{Blur, Shutter, ShutterShape};

use crate::{Bindings, BoundGroom, Carried, Exposure, FilmedMesh, MeshAsked, MovingSceneError};

/// A triangle in the plane y = 0, and where it goes.
const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [3.0, 0.0, 0.0]];

/// A stage at 10 frames a second, of a triangle at frames from 0 on.
fn stage(folder: &Path, place: DVec3, frames: &[[[f64; 3]; 3]]) -> std::path::PathBuf {
    let mut samples = String::new();
    for (frame, points) in frames.iter().enumerate() {
        let points = points.map(|[x, y, z]| format!("({x}, {y}, {z})")).join(", ");
        writeln!(samples, "            {frame}: [{points}],").unwrap();
    }
    let text = format!(
        "#usda 1.0\n(\n    metersPerUnit = 1\n    timeCodesPerSecond = 10\n    upAxis = \"Y\"\n)\n\
         def Mesh \"M\"\n{{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 2]\n    \
         double3 xformOp:translate = ({}, {}, {})\n    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n    \
         point3f[] points = [{}]\n    point3f[] points.timeSamples = {{\n{samples}    }}\n}}\n",
        place.x,
        place.y,
        place.z,
        FLAT.map(|[x, y, z]| format!("({x}, {y}, {z})")).join(", "),
    );
    let path = folder.join("m.usda");
    fs::write(&path, text).unwrap();
    path
}

fn exposure(blur: Option<Blur>) -> Exposure {
    let shutter = Shutter::new(-0.5, 0.5, ShutterShape::Box).unwrap();
    Exposure { shutter, blur, ..Exposure::default() }
}

/// A strand of height 1 on the triangle, bound, at a frame.
fn carried(
    place: DVec3,
    frames: &[[[f64; 3]; 3]],
    bindings: Bindings,
    frame: f64,
    blur: Option<Blur>,
) -> Carried {
    let folder = tempfile::tempdir().unwrap();
    let path = stage(folder.path(), place, frames);
    let exposure = exposure(blur);
    let asked = MeshAsked { moves: true, keys: 2, ..MeshAsked::default() };
    let mesh = FilmedMesh::open(&path, &asked, &exposure).unwrap();
    let root = (place + DVec3::new(1.0, 0.0, 1.0)).as_vec3();
    let groom = Groom::new(vec![0, 2], vec![root, root + Vec3::Y]).unwrap();
    let (bound, _) = BoundGroom::bind(groom, &mesh, bindings).unwrap();
    bound.at(&mesh, frame, &exposure, 10.0).unwrap()
}

/// The triangle moved along x, frame by frame.
fn along_x(places: &[f64]) -> Vec<[[f64; 3]; 3]> {
    places.iter().map(|x| FLAT.map(|[a, b, c]| [a + x, b, c])).collect()
}

fn near(found: Vec3, expected: [f32; 3]) {
    assert!((found - Vec3::from_array(expected)).length() < 1e-5, "{found}, expected {expected:?}");
}

#[test]
fn strands_go_where_their_triangle_goes_at_every_key() {
    let still = |blur| carried(DVec3::ZERO, &along_x(&[0.0, 1.0, 2.0, 3.0]), Bindings::default(), 2.0, blur);
    let sharp = still(Some(Blur::Off));
    assert_eq!(sharp.motion.key_count(), 0);
    near(sharp.groom.positions()[0], [3.0, 0.0, 1.0]);
    for blur in [None, Some(Blur::Positions), Some(Blur::Velocities), Some(Blur::Accelerations)] {
        let blurred = still(blur);
        let keys = blurred.motion.positions();
        near(keys[0][1], [2.5, 1.0, 1.0]);
        near(keys[keys.len() - 1][1], [3.5, 1.0, 1.0]);
        assert!(!blurred.jumped);
    }
}

#[test]
fn a_character_far_away_keeps_the_shape_of_its_strands() {
    let place = DVec3::new(1e6, 0.0, -1e6);
    let far = carried(place, &along_x(&[0.0, 0.25]), Bindings::default(), 0.0, None);
    assert!((far.origin - place).length() < 4.0, "{}", far.origin);
    let segment = far.groom.positions()[1] - far.groom.positions()[0];
    near(segment, [0.0, 1.0, 0.0]);
    let way = far.motion.positions()[1][0] - far.motion.positions()[0][0];
    near(way, [0.125, 0.0, 0.0]);
    let close = carried(DVec3::ZERO, &along_x(&[0.0, 0.25]), Bindings::default(), 0.0, None);
    assert_eq!(close.origin, DVec3::ZERO);
}

/// The mesh turns by 90 degrees, then collapses: its strands keep the turn, whichever frame was asked for first.
#[test]
fn on_a_collapsed_triangle_strands_stay_as_they_were_in_the_frame_before() {
    let turned = FLAT.map(|[x, y, z]| [y, x, z]).map(|[x, y, z]| [-x, y, z]);
    let collapsed = [[0.0; 3]; 3];
    let frames = [FLAT, turned, collapsed, collapsed];
    let at = |frame| {
        let carried = carried(DVec3::ZERO, &frames, Bindings::default(), frame, Some(Blur::Off));
        carried.groom.positions()[1] - carried.groom.positions()[0]
    };
    near(at(0.0), [0.0, 1.0, 0.0]);
    let before = at(1.0);
    assert!(before.y.abs() < 1e-5 && (before.length() - 1.0).abs() < 1e-5, "{before}");
    near(at(2.0), before.to_array());
    near(at(3.0), before.to_array());
}

#[test]
fn what_jumps_is_not_blurred() {
    let frames = along_x(&[0.0, 0.0, 100.0, 100.0]);
    let teleport = Bindings { teleport: Some(5.0), ..Bindings::default() };
    for blur in [None, Some(Blur::Velocities)] {
        let jumped = carried(DVec3::ZERO, &frames, teleport, 2.0, blur);
        assert!(jumped.jumped && !jumped.motion.moves(), "{blur:?} {:?}", jumped.motion);
        near(jumped.groom.positions()[0] + jumped.origin.as_vec3(), [101.0, 0.0, 1.0]);
    }
    let smeared = carried(DVec3::ZERO, &frames, Bindings::default(), 2.0, None);
    assert!(!smeared.jumped && smeared.motion.moves());
    // A frame away nothing jumps.
    assert!(!carried(DVec3::ZERO, &frames, teleport, 0.0, None).jumped);
}

#[test]
fn frames_outside_the_animation_stand_and_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = stage(folder.path(), DVec3::ZERO, &along_x(&[0.0, 1.0, 2.0]));
    let asked = MeshAsked { moves: true, keys: 2, ..MeshAsked::default() };
    let mesh = FilmedMesh::open(&path, &asked, &exposure(None)).unwrap();
    assert_eq!(mesh.frames(10.0), Some((0.0, 2.0)));
    assert_eq!(mesh.outside(1.0, 10.0), None);
    let told = mesh.outside(9.0, 10.0).unwrap();
    assert!(told.ends_with("m.usda: frame 9 is outside 0 to 2; it stands as at the nearest"), "{told}");
    let object = mesh.object(Some(9.0), &exposure(None), 10.0, Vec3::ONE).unwrap();
    assert!(!object.motion.moves());
}

#[test]
fn a_limit_that_leaves_nothing_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = stage(folder.path(), DVec3::ZERO, &along_x(&[0.0, 1.0]));
    let mesh = FilmedMesh::open(&path, &MeshAsked::default(), &exposure(None)).unwrap();
    let groom = Groom::new(vec![0, 2], vec![Vec3::splat(50.0), Vec3::splat(51.0)]).unwrap();
    let drop = Bindings { limit: Some(1.0), beyond: groom_binding::Beyond::Drop, ..Bindings::default() };
    let told = BoundGroom::bind(groom.clone(), &mesh, drop).unwrap_err();
    assert!(matches!(told, MovingSceneError::NothingBound { strands: 1, .. }), "{told}");
    let (_, words) = BoundGroom::bind(groom, &mesh, Bindings::default()).unwrap();
    assert!(words[0].contains("off the mesh"), "{words:?}");
    // No strands are no fault.
    let none = Groom::new(vec![0], Vec::new()).unwrap();
    let (bound, words) = BoundGroom::bind(none, &mesh, Bindings::default()).unwrap();
    assert_eq!(bound.at(&mesh, 0.0, &exposure(None), 10.0).unwrap().groom.strand_count(), 0);
    assert!(words.is_empty(), "{words:?}");
}
