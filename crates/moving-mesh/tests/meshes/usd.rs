//! USD layers, natively and through usd-core.

use glam::{DVec3, Vec2, Vec3};
use moving_mesh::{AnimationChoice, MeshError, MeshOptions, MovingMesh, Pose, RestPose};
use proptest::prelude::*;
use usd_core::{UsdCore, UsdCoreError};

use crate::support::{corners, data, open_as, open_as_or_skip, size};

/// A square and a triangle below a transform that moves, the square in time samples and left-handed.
const STAGE: &str = r#"#usda 1.0
(
    metersPerUnit = 0.1
    timeCodesPerSecond = 10
    upAxis = "Z"
)
def Xform "Root"
{
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 10: (0, 0, 5) }
    float xformOp:rotateZ = 90
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
    def Mesh "Square"
    {
        uniform token orientation = "leftHanded"
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 9), (1, 0, 9), (1, 1, 9), (0, 1, 9)]
        point3f[] points.timeSamples = {
            2: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
            4: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 8)],
        }
        normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 1, 0)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
        rel material:binding = </Looks/Skin>
    }
    def Mesh "Fan"
    {
        int[] faceVertexCounts = [3, 3]
        int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        normal3f[] primvars:normals = [(0, 0, 1)] (interpolation = "constant")
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (0.5, 0.5)] (interpolation = "faceVarying")
        int[] primvars:st:indices = [0, 1, 2, 0, 1, 2]
        double3 xformOp:scale = (1, 1, -1)
        uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:scale"]
        def GeomSubset "Second"
        {
            uniform token familyName = "materialBind"
            int[] indices = [1]
            rel material:binding = </Looks/Skin>
        }
    }
    def Mesh "Helper"
    {
        uniform token purpose = "guide"
    }
}
def Scope "Looks"
{
    def Material "Skin"
    {
        token outputs:surface.connect = </Looks/Skin/Shader.outputs:surface>
        def Shader "Shader"
        {
            color3f inputs:diffuseColor = (0.5, 0.25, 0.125)
            token outputs:surface
        }
    }
}
"#;

fn stage(text: &str) -> Result<MovingMesh, MeshError> {
    open_as("stage.usda", text.as_bytes(), &MeshOptions::default())
}

#[test]
fn points_and_transforms_are_linear_between_samples() {
    let mesh = stage(STAGE).unwrap();
    assert_eq!((mesh.is_z_up(), mesh.meters_per_unit(), mesh.frame_rate()), (true, 0.1, Some(10.0)));
    assert_eq!(mesh.time_range(), Some((0.0, 1.0)));
    // Time code 3: half of the points' way, three tenths of the transform's; turned by 90 degrees about z.
    let pose = mesh.pose(0.3).unwrap();
    let expected = [[0., 0., 1.5], [0., 1., 1.5], [-1., 1., 1.5], [-1., 0., 5.5]];
    for (found, expected) in pose.positions.iter().zip(expected) {
        assert!((*found - DVec3::from(expected)).length() < 1e-6, "{found} {expected:?}");
    }
    // Before and after the samples they are held.
    assert!((mesh.pose(-1.0).unwrap().positions[3] - DVec3::new(-1.0, 0.0, 0.0)).length() < 1e-12);
    assert!((mesh.pose(9.0).unwrap().positions[3] - DVec3::new(-1.0, 0.0, 13.0)).length() < 1e-12);
    let normals = pose.normals.unwrap();
    assert!((normals[3] - Vec3::new(-1.0, 0.0, 0.0)).length() < 1e-6, "{}", normals[3]);
    // At no time in particular.
    assert_eq!(mesh.rest().positions[0].z, 9.0);
}

#[test]
fn faces_are_fans_that_face_outwards() {
    let mesh = stage(STAGE).unwrap();
    // A left-handed square; a fan that a mirroring transform turns round.
    assert_eq!(mesh.triangles()[..2], [[0, 2, 1], [0, 3, 2]]);
    let [a, b, c] = mesh.triangles()[2].map(|vertex| mesh.rest().positions[vertex as usize]);
    assert!((b - a).cross(c - a).z < 0.0);
    let fan = &mesh.rest().normals.as_ref().unwrap()[4..];
    assert!(fan.iter().all(|normal| (*normal + Vec3::Z).length() < 1e-6), "{fan:?}");
}

#[test]
fn a_point_with_two_texture_coordinates_is_two_vertices() {
    let mesh = stage(STAGE).unwrap();
    let (uvs, rest) = (mesh.uvs().unwrap(), mesh.rest());
    assert_eq!(uvs[..4], [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]);
    // Point 0 has one coordinate in both faces, point 2 one in each.
    assert_eq!(mesh.vertex_count(), 4 + 5);
    let at = |triangle: usize, corner: usize| mesh.triangles()[triangle][corner] as usize;
    let second = |triangle: usize| {
        (0..3)
            .map(|corner| at(triangle, corner))
            .find(|&v| rest.positions[v] == DVec3::new(1.0, 1.0, 0.0))
            .unwrap()
    };
    let (first, second) = (second(2), second(3));
    assert_ne!(first, second);
    assert_eq!((uvs[first], uvs[second]), (Vec2::splat(0.5), Vec2::X));
    let pose = mesh.pose(0.123).unwrap();
    assert_eq!(pose.positions[first], pose.positions[second]);
}

#[test]
fn parts_have_the_materials_bound_to_them() {
    let mesh = stage(STAGE).unwrap();
    let parts: Vec<_> = mesh
        .parts()
        .iter()
        .map(|part| (part.name.as_str(), part.material.as_deref(), part.triangles.clone()))
        .collect();
    assert_eq!(
        parts,
        [("Square", Some("Skin"), 0..2), ("Fan", None, 2..3), ("Fan/Second", Some("Skin"), 3..4)]
    );
    assert_eq!(mesh.parts()[0].base_color, Vec3::new(0.5, 0.25, 0.125));
}

#[test]
fn a_mesh_that_becomes_another_is_told_with_its_time() {
    let told = |from: &str, to: &str, time: f64| {
        let text = STAGE.replace(from, to);
        assert_ne!(text, STAGE);
        match stage(&text).and_then(|mesh| mesh.pose(time)) {
            Ok(_) => panic!("{to}"),
            Err(error) => error.to_string(),
        }
    };
    let error = told("(0, 1, 8)]", "(0, 1, 8), (0, 0, 0)]", 0.3);
    assert!(
        error.contains("/Root/Square: points at time code 4: 5 points, expected the 4 of the first"),
        "{error}"
    );
    let samples = "int[] faceVertexIndices.timeSamples = { 0: [0, 1, 2, 3], 7: [0, 1, 3, 2] }";
    let error = told("int[] faceVertexIndices = [0, 1, 2, 3]", samples, 0.0);
    assert!(error.contains("/Root/Square: faceVertexIndices at time code 7"), "{error}");
    let error = told("int[] faceVertexCounts = [4]", "int[] faceVertexCounts = [3]", 0.0);
    assert!(error.contains("/Root/Square: faceVertexCounts: 3 corners in all, expected the 4"), "{error}");
    let error = told("[0, 1, 2, 3]", "[0, 1, 2, -3]", 0.0);
    assert!(error.contains("faceVertexIndices: index -3 at 3"), "{error}");
    let error = told("indices = [1]", "indices = [2]", 0.0);
    assert!(error.contains("/Root/Fan: Second.indices: face 2, expected 0 to below the 2 faces"), "{error}");
}

/// Pixar's own results. Their layers are read natively, ours go through the bake.
#[test]
fn skinning_and_blend_shapes_are_pixars() {
    let Some(folder) = data("usd/bakeskinning") else { return };
    for name in ["lbs", "blendshapes"] {
        let theirs =
            MovingMesh::open(folder.join(format!("{name}.baked.usda")), &MeshOptions::default()).unwrap();
        let ours = std::fs::read(folder.join(format!("{name}.usda"))).unwrap();
        let Some(ours) = open_as_or_skip("ours.usda", &ours, &MeshOptions::default()) else { return };
        assert_eq!(ours.triangles().len(), theirs.triangles().len());
        let rate = ours.frame_rate().unwrap();
        let (first, last) = theirs.time_range().unwrap();
        let frames = (first * rate).round() as i32..=(last * rate).round() as i32;
        let worst = frames
            .map(|frame| {
                let time = f64::from(frame) / rate;
                let poses = [&ours, &theirs].map(|mesh| mesh.pose(time).unwrap());
                let pairs = corners(&ours, &poses[0]).zip(corners(&theirs, &poses[1]));
                pairs.map(|(a, b)| (a - b).length()).fold(0.0, f64::max) / size(&poses[1])
            })
            .fold(0.0, f64::max);
        println!("{name}: {worst:.1e} of the model's size from Pixar's");
        assert!(worst < 1e-5, "{name}: {worst:e}");
    }
}

#[test]
fn what_is_missing_is_said() {
    let text = STAGE.replace("def Xform \"Root\"", "def Xform \"Root\" (references = @other.usda@)");
    match stage(&text) {
        Err(MeshError::UsdCore { source: UsdCoreError::Missing { .. }, .. }) => {}
        Err(error) => assert!(UsdCore::find().is_ok(), "{error}"),
        Ok(mesh) => assert!(UsdCore::find().is_ok() && mesh.vertex_count() > 0),
    }
    let error = stage("#usda 1.0\ndef Xform \"Root\"\n{\n}\n").unwrap_err().to_string();
    assert!(error.contains("no Mesh prim"), "{error}");
}

#[test]
fn rest_poses_of_a_stage() {
    let open = |rest, animation| {
        open_as("a.usda", STAGE.as_bytes(), &MeshOptions { rest, animation, ..MeshOptions::default() })
            .unwrap()
    };
    let at = |mesh: &MovingMesh| mesh.rest().positions[3];
    let mesh = open(RestPose::Time(0.3), AnimationChoice::First);
    assert_eq!(*mesh.rest(), mesh.pose(0.3).unwrap());
    assert_eq!(
        at(&open(RestPose::Nodes, AnimationChoice::First)),
        at(&open(RestPose::Bind, AnimationChoice::First))
    );
    let still = open(RestPose::Bind, AnimationChoice::None);
    assert_eq!(still.pose(0.3).unwrap(), *still.rest());
    assert!(!still.moves());
}

/// The stage with an arc that changes nothing, for usd-core to bake, and a proxy.
#[test]
fn a_baked_stage_is_the_one_that_is_read_natively() {
    let composed = STAGE
        .replace("def Xform \"Root\"", "class \"_none\" { }\ndef Xform \"Root\" (inherits = </_none>)")
        .replace("\"guide\"", "\"proxy\"");
    let native = stage(STAGE).unwrap();
    let same = |a: &Pose, b: &Pose| {
        let normals = a.normals.iter().flatten().zip(b.normals.iter().flatten());
        let worst = a.positions.iter().zip(&b.positions).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
        assert_eq!((a.positions.len(), a.normals.is_some()), (b.positions.len(), b.normals.is_some()));
        assert!(worst < 1e-6 && normals.into_iter().all(|(a, b)| (*a - *b).length() < 1e-6), "{worst}");
    };
    for (frames, rest) in [
        (None, RestPose::Bind),
        (Some((5.0, 8.0)), RestPose::Bind),
        (Some((5.0, 8.0)), RestPose::Time(0.25)),
        (Some((-0.5, 3.25)), RestPose::Time(0.75)),
        (Some((-0.5, 3.25)), RestPose::Nodes),
    ] {
        let options = MeshOptions { frames, rest, step: Some(0.5), ..MeshOptions::default() };
        let Some(baked) = open_as_or_skip("a.usda", composed.as_bytes(), &options) else { return };
        let told = open_as("a.usda", STAGE.as_bytes(), &options).unwrap();
        same(baked.rest(), told.rest());
        let (first, last) = frames.unwrap_or((0.0, 10.0));
        for time in [first, last].map(|frame| frame / 10.0) {
            same(&baked.pose(time).unwrap(), &native.pose(time).unwrap());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn stages_that_were_bent_are_read_or_refused(
        changes in prop::collection::vec((any::<prop::sample::Index>(), "[-0-9a-z,()\\[\\] ]{1,3}"), 1..4),
        time in -1.0..2.0,
    ) {
        let mut bytes = STAGE.as_bytes().to_vec();
        for (at, text) in changes {
            let at = at.index(bytes.len() - text.len());
            bytes[at..at + text.len()].copy_from_slice(text.as_bytes());
        }
        // A stage that refers to others is usd-core's.
        let composed = ["references", "payload", "clips", "SkelRoot"]
            .iter()
            .any(|word| bytes.windows(word.len()).any(|found| found == word.as_bytes()));
        if !composed && let Ok(mesh) = open_as("a.usda", &bytes, &MeshOptions::default()) {
            let _ = mesh.pose(time);
        }
    }
}
