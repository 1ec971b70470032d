//! Skinned glTF files written as UsdSkel, whose skinning is then usd-core's own.

use std::fmt::Write;

use glam::DMat4;
use moving_mesh::{AnimationChoice, MeshOptions, MovingMesh, Skeleton};

use crate::support::{corners, data, open_as_or_skip, size};

/// Frames a second, and how many are compared.
const RATE: f64 = 24.0;
const FRAMES: i32 = 24;

fn list<T>(items: impl IntoIterator<Item = T>, word: impl Fn(T) -> String) -> String {
    let words: Vec<String> = items.into_iter().map(word).collect();
    format!("[{}]", words.join(", "))
}

/// USD's rows are our columns.
fn matrix(matrix: DMat4) -> String {
    let rows =
        matrix.to_cols_array_2d().map(|row| format!("({}, {}, {}, {})", row[0], row[1], row[2], row[3]));
    format!("({})", rows.join(", "))
}

/// Joints as USD names them, by their paths.
fn paths(skeleton: &Skeleton) -> Vec<String> {
    let mut paths: Vec<String> = Vec::new();
    for (number, joint) in skeleton.joints.iter().enumerate() {
        let above = joint.parent.map(|parent| format!("{}/", paths[parent])).unwrap_or_default();
        paths.push(format!("{above}j{number}"));
    }
    paths
}

fn locals(skeleton: &Skeleton, worlds: &[DMat4]) -> Vec<DMat4> {
    let above = |parent: Option<usize>| parent.map_or(DMat4::IDENTITY, |parent| worlds[parent].inverse());
    skeleton.joints.iter().zip(worlds).map(|(joint, world)| above(joint.parent) * *world).collect()
}

/// The stage of a mesh of one skin, all of it skinned: its bind pose, its joints at every frame.
fn skel(mesh: &MovingMesh) -> String {
    let skeleton = mesh.skeleton().unwrap();
    let joints = list(paths(skeleton), |path| format!("\"{path}\""));
    let bind = list(&skeleton.joints, |joint| matrix(joint.inverse_bind.inverse()));
    let rest = list(locals(skeleton, &mesh.joint_worlds(0.0).unwrap()), matrix);
    let most = (0..mesh.vertex_count()).map(|v| skeleton.influences(v).len()).max().unwrap();
    let (mut numbers, mut weights) = (Vec::new(), Vec::new());
    for vertex in 0..mesh.vertex_count() {
        for place in 0..most {
            let (joint, weight) = skeleton.influences(vertex).get(place).copied().unwrap_or((0, 0.0));
            numbers.push(joint);
            weights.push(weight);
        }
    }
    let mut samples = [String::new(), String::new(), String::new()];
    for frame in 0..=FRAMES {
        let worlds = mesh.joint_worlds(f64::from(frame) / RATE).unwrap();
        let parts = locals(skeleton, &worlds).into_iter().map(|local| local.to_scale_rotation_translation());
        let parts: Vec<_> = parts.collect();
        let [translations, rotations, scales] = &mut samples;
        let moved = list(&parts, |(_, _, t)| format!("({}, {}, {})", t.x, t.y, t.z));
        let turned = list(&parts, |(_, q, _)| format!("({}, {}, {}, {})", q.w, q.x, q.y, q.z));
        let scaled = list(&parts, |(s, ..)| format!("({}, {}, {})", s.x, s.y, s.z));
        writeln!(translations, "{frame}: {moved},").unwrap();
        writeln!(rotations, "{frame}: {turned},").unwrap();
        writeln!(scales, "{frame}: {scaled},").unwrap();
    }
    let [translations, rotations, scales] = samples;
    let points = list(&mesh.rest().positions, |p| format!("({}, {}, {})", p.x, p.y, p.z));
    let counts = list(mesh.triangles(), |_| "3".into());
    let indices = list(mesh.triangles().iter().flatten(), ToString::to_string);
    let (numbers, weights) = (list(numbers, |n| n.to_string()), list(weights, |w| w.to_string()));
    format!(
        r#"#usda 1.0
(
    startTimeCode = 0
    endTimeCode = {FRAMES}
    timeCodesPerSecond = {RATE}
    metersPerUnit = 1
    upAxis = "Y"
)
def SkelRoot "Root" (prepend apiSchemas = ["SkelBindingAPI"])
{{
    rel skel:skeleton = </Root/Skeleton>
    def Skeleton "Skeleton" (prepend apiSchemas = ["SkelBindingAPI"])
    {{
        rel skel:animationSource = </Root/Skeleton/Motion>
        uniform token[] joints = {joints}
        uniform matrix4d[] bindTransforms = {bind}
        uniform matrix4d[] restTransforms = {rest}
        def SkelAnimation "Motion"
        {{
            uniform token[] joints = {joints}
            float3[] translations.timeSamples = {{ {translations} }}
            quatf[] rotations.timeSamples = {{ {rotations} }}
            half3[] scales.timeSamples = {{ {scales} }}
        }}
    }}
    def Mesh "Mesh" (prepend apiSchemas = ["SkelBindingAPI"])
    {{
        int[] faceVertexCounts = {counts}
        int[] faceVertexIndices = {indices}
        point3f[] points = {points}
        int[] primvars:skel:jointIndices = {numbers} (
            elementSize = {most}
            interpolation = "vertex"
        )
        float[] primvars:skel:jointWeights = {weights} (
            elementSize = {most}
            interpolation = "vertex"
        )
    }}
}}
"#
    )
}

/// What is in the glTF file and what usd-core makes of the same skin agree, at frames within what `f32` points and
/// turns hold. Both have Y up and metres.
#[test]
fn usd_core_skins_as_we_do() {
    for (file, animation) in [("RiggedSimple.glb", 0), ("Fox.glb", 2)] {
        let Some(path) = data("meshes").map(|folder| folder.join(file)) else { return };
        let chosen = MeshOptions { animation: AnimationChoice::Index(animation), ..MeshOptions::default() };
        let gltf = MovingMesh::open(path, &chosen).unwrap();
        let Some(usd) = open_as_or_skip("skel.usda", skel(&gltf).as_bytes(), &MeshOptions::default()) else {
            return;
        };
        assert_eq!(usd.rest().positions, gltf.rest().positions, "the bind pose");
        let worst = (0..=FRAMES)
            .map(|frame| {
                let poses = [&gltf, &usd].map(|mesh| mesh.pose(f64::from(frame) / RATE).unwrap());
                let pairs = corners(&gltf, &poses[0]).zip(corners(&usd, &poses[1]));
                pairs.map(|(a, b)| (a - b).length()).fold(0.0, f64::max) / size(&poses[0])
            })
            .fold(0.0, f64::max);
        println!("{file}: {worst:.1e} of the model's size from usd-core's skinning");
        assert!(worst < 1e-5, "{file}: {worst:e}");
    }
}

/// The `.usdz` is of another edition than the `.glb`: 160 points to 960, one bend of two seconds to one of 6.7. Both
/// are the cylinder of the same size, and bend back to where they started.
#[test]
fn the_package_bends() {
    let (Some(glb), Some(usdz)) = (data("meshes/RiggedSimple.glb"), data("usd/RiggedSimple.usdz")) else {
        return;
    };
    let glb = MovingMesh::open(glb, &MeshOptions::default()).unwrap();
    let Some(usd) = open_as_or_skip("a.usdz", &std::fs::read(usdz).unwrap(), &MeshOptions::default()) else {
        return;
    };
    assert_eq!((usd.is_z_up(), usd.meters_per_unit(), usd.frame_rate()), (false, 1.0, Some(24.0)));
    let height = |mesh: &MovingMesh| {
        let (low, high) = mesh
            .rest()
            .positions
            .iter()
            .fold((f64::MAX, f64::MIN), |(low, high), p| (p.y.min(low), p.y.max(high)));
        high - low
    };
    assert!((height(&usd) / height(&glb) - 1.0).abs() < 0.05, "{} {}", height(&usd), height(&glb));
    let (start, end) = usd.time_range().unwrap();
    let tip = |time: f64| usd.pose(time).unwrap().positions.iter().map(|p| p.x).fold(f64::MIN, f64::max);
    assert!(tip(start) < 1.001 && tip((start + end) / 2.0) > 2.0 && tip(end) < 1.01);
}
