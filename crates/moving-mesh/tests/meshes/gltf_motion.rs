//! Small glTF files whose motion is known exactly.

use glam::{DQuat, DVec3, Vec2, Vec3};
use moving_mesh::{AnimationChoice, MeshError, MeshOptions, MovingMesh, RestPose};
use proptest::prelude::*;

use crate::support::{Gltf, open_as};

/// Two triangles; the fourth corner is far out, where turns are seen.
const POINTS: [f32; 12] = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 2.];
const TRIANGLES: [u8; 6] = [0, 1, 2, 0, 2, 3];

fn open(file: &[u8], options: &MeshOptions) -> MovingMesh {
    open_as("a.glb", file, options).unwrap()
}

/// A document with the triangles as accessors 0 (POSITION) and 1 (indices).
fn shape() -> Gltf {
    let mut gltf = Gltf::default();
    gltf.floats("VEC3", &POINTS);
    let view = gltf.view(&TRIANGLES);
    gltf.accessor(&format!(r#""bufferView":{view},"componentType":5121,"count":6,"type":"SCALAR""#));
    gltf
}

/// One node that is moved by one curve.
fn moved(path: &str, interpolation: &str, kind: &str, times: &[f32], values: &[f32]) -> Vec<u8> {
    let mut gltf = shape();
    let (input, output) = (gltf.floats("SCALAR", times), gltf.floats(kind, values));
    gltf.file(&format!(
        r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "animations":[{{"name":"move","samplers":[{{"input":{input},"output":{output},"interpolation":"{interpolation}"}}],
        "channels":[{{"sampler":0,"target":{{"node":0,"path":"{path}"}}}}]}}]"#
    ))
}

#[test]
fn linear_steps_and_ends() {
    let keys = [0.5, 1.0, 2.0];
    let values = [0., 0., 0., 1., 0., 0., 1., 4., 0.];
    let origin = |interpolation, time| {
        let mesh =
            open(&moved("translation", interpolation, "VEC3", &keys, &values), &MeshOptions::default());
        assert_eq!(mesh.time_range(), Some((0.5, 2.0)));
        assert_eq!(mesh.frame_rate(), Some(24.0));
        assert!(mesh.moves());
        mesh.pose(time).unwrap().positions[0].to_array()
    };
    for (time, at) in [
        (-3.0, [0., 0., 0.]),
        (0.5, [0., 0., 0.]),
        (0.625, [0.25, 0., 0.]),
        (1.0, [1., 0., 0.]),
        (1.75, [1., 3., 0.]),
        (2.0, [1., 4., 0.]),
        (9.0, [1., 4., 0.]),
    ] {
        assert_eq!(origin("LINEAR", time), at, "{time}");
    }
    for (time, at) in [
        (0.0, [0., 0., 0.]),
        (0.99, [0., 0., 0.]),
        (1.0, [1., 0., 0.]),
        (1.99, [1., 0., 0.]),
        (2.0, [1., 4., 0.]),
    ] {
        assert_eq!(origin("STEP", time), at, "{time}");
    }
}

/// The spline of a cubic polynomial is the polynomial, whatever the keys.
#[test]
fn cubic_splines_are_their_polynomial() {
    let value = |t: f64| DVec3::new(t * t * t - 2.0 * t, 1.0 + t * t, 0.5 * t - t * t * t);
    let slope = |t: f64| DVec3::new(3.0 * t * t - 2.0, 2.0 * t, 0.5 - 3.0 * t * t);
    let keys = [0.0_f32, 0.5, 2.0, 2.25];
    let values: Vec<f32> = keys
        .iter()
        .flat_map(|&key| {
            let key = f64::from(key);
            [slope(key), value(key), slope(key)].into_iter().flat_map(|v| v.as_vec3().to_array())
        })
        .collect();
    let mesh = open(&moved("translation", "CUBICSPLINE", "VEC3", &keys, &values), &MeshOptions::default());
    for i in 0..=90 {
        let time = f64::from(i) * 0.025;
        let found = mesh.pose(time).unwrap().positions[0];
        assert!((found - value(time)).length() < 1e-6, "{time}: {found}");
    }
    assert_eq!(mesh.pose(7.0).unwrap().positions[0].as_vec3(), value(2.25).as_vec3());
}

#[test]
fn turns_go_the_shortest_way_at_an_even_speed() {
    let half = std::f64::consts::FRAC_1_SQRT_2 as f32;
    // The second key is the same turn by 90 degrees about z with its sign changed.
    let file = moved("rotation", "LINEAR", "VEC4", &[0.0, 2.0], &[0., 0., 0., 1., 0., 0., -half, -half]);
    let mesh = open(&file, &MeshOptions::default());
    for i in 0..=20 {
        let time = f64::from(i) * 0.1;
        let expected = DQuat::from_rotation_z(time / 2.0 * std::f64::consts::FRAC_PI_2) * DVec3::X;
        let found = mesh.pose(time).unwrap().positions[1];
        assert!((found - expected).length() < 1e-7, "{time}: {found} {expected}");
    }
}

#[test]
fn cubic_turns_are_splines_brought_to_length_1() {
    let zero = [0.0_f32; 4];
    let half = std::f64::consts::FRAC_1_SQRT_2 as f32;
    let values = [zero, [0., 0., 0., 1.], zero, zero, [half, 0., 0., half], zero].concat();
    let mesh = open(&moved("rotation", "CUBICSPLINE", "VEC4", &[0.0, 1.0], &values), &MeshOptions::default());
    let (u, half) = (0.25_f64, f64::from(half));
    let weight = 3.0 * u * u - 2.0 * u * u * u;
    let turn = DQuat::from_xyzw(half * weight, 0.0, 0.0, 1.0 - weight + half * weight).normalize();
    let found = mesh.pose(u).unwrap().positions[2];
    assert!((found - turn * DVec3::Y).length() < 1e-12, "{found}");
}

/// Two joints over each other, the second set of joints used; weights in bytes.
fn arm(gltf: &mut Gltf, root: &str) -> String {
    let normals = gltf.floats("VEC3", &[0., 0., 1.].repeat(4));
    let joints = |gltf: &mut Gltf, joints: &[u8]| {
        let view = gltf.view(joints);
        gltf.accessor(&format!(r#""bufferView":{view},"componentType":5121,"count":4,"type":"VEC4""#))
    };
    let weights = |gltf: &mut Gltf, weights: &[u8]| {
        let view = gltf.view(weights);
        gltf.accessor(&format!(
            r#""bufferView":{view},"componentType":5121,"normalized":true,"count":4,"type":"VEC4""#
        ))
    };
    let joints_0 = joints(gltf, &[0; 16]);
    let joints_1 = joints(gltf, &[1; 16]);
    let mut first = [0_u8; 16];
    let mut second = [0_u8; 16];
    // Vertex 0 hangs on the root, 1 and 3 on the tip, 2 on both in equal parts; what is not used weighs 0.
    (first[0], first[8], second[4], second[8], second[12]) = (255, 100, 255, 100, 200);
    let (weights_0, weights_1) = (weights(gltf, &first), weights(gltf, &second));
    let mut binds = [[0.0_f32; 16]; 2];
    for (place, bind) in binds.iter_mut().enumerate() {
        (bind[0], bind[5], bind[10], bind[15]) = (1., 1., 1., 1.);
        bind[13] = -(place as f32);
    }
    let binds = gltf.floats("MAT4", &binds.concat());
    let turn = (std::f64::consts::FRAC_PI_8).sin_cos();
    let (input, output) = (
        gltf.floats("SCALAR", &[0.0, 1.0]),
        gltf.floats("VEC4", &[0., 0., 0., 1., 0., 0., turn.0 as f32, turn.1 as f32]),
    );
    format!(
        r#""scenes":[{{"nodes":[0,2]}}],"scene":0,"nodes":[{{"name":"root","children":[1]{root}}},{{"name":"tip","translation":[0,1,0]}},
        {{"mesh":0,"skin":0,"translation":[5,5,5]}}],
        "meshes":[{{"name":"arm","primitives":[{{"attributes":{{"POSITION":0,"NORMAL":{normals},"JOINTS_0":{joints_0},
        "WEIGHTS_0":{weights_0},"JOINTS_1":{joints_1},"WEIGHTS_1":{weights_1}}},"indices":1}}]}}],
        "skins":[{{"joints":[0,1],"inverseBindMatrices":{binds}}}],
        "animations":[{{"name":"still","samplers":[],"channels":[]}},{{"name":"bend","samplers":[{{"input":{input},"output":{output}}}],
        "channels":[{{"sampler":0,"target":{{"node":1,"path":"rotation"}}}}]}}]"#
    )
}

fn bend() -> MeshOptions {
    MeshOptions { animation: AnimationChoice::Name("bend".into()), ..MeshOptions::default() }
}

#[test]
fn both_sets_of_joints_carry_a_vertex() {
    let mut gltf = shape();
    let members = arm(&mut gltf, "");
    let mesh = open(&gltf.file(&members), &bend());
    let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4);
    let tip = |p: DVec3| turn * (p - DVec3::Y) + DVec3::Y;
    let pose = mesh.pose(1.0).unwrap();
    let expected = [DVec3::ZERO, tip(DVec3::X), DVec3::Y, tip(DVec3::Z * 2.0)];
    for (found, expected) in pose.positions.iter().zip(expected) {
        assert!((*found - expected).length() < 1e-6, "{found} {expected}");
    }
    assert_eq!(mesh.rest().positions[1], DVec3::X, "bound as modelled");
    let skeleton = mesh.skeleton().unwrap();
    assert_eq!(skeleton.influences(2), [(0, 0.5), (1, 0.5)]);
    assert_eq!(skeleton.influences(3), [(1, 1.0)]);
    assert_eq!((skeleton.joints[1].name.as_str(), skeleton.joints[1].parent), ("tip", Some(0)));
    // What the skeleton says is what the pose is made of.
    let worlds = mesh.joint_worlds(0.3).unwrap();
    let pose = mesh.pose(0.3).unwrap();
    for (vertex, position) in pose.positions.iter().enumerate() {
        let modelled = mesh.rest().positions[vertex];
        let sum: DVec3 = skeleton
            .influences(vertex)
            .iter()
            .map(|&(joint, weight)| {
                let joint = joint as usize;
                let matrix = worlds[joint] * skeleton.joints[joint].inverse_bind;
                matrix.transform_point3(modelled) * f64::from(weight)
            })
            .sum();
        assert!((sum - *position).length() < 1e-12);
    }
}

/// A root node a million units away moves every vertex by a million units and by nothing else.
#[test]
fn a_character_far_away_keeps_its_shape() {
    let poses = ["", r#","translation":[1048576,-1048576,524288]"#].map(|root| {
        let mut gltf = shape();
        let members = arm(&mut gltf, root);
        let mesh = open(&gltf.file(&members), &bend());
        (0..=10).map(|i| mesh.pose(f64::from(i) * 0.1).unwrap().positions).collect::<Vec<_>>()
    });
    let [near, far] = poses;
    let away = DVec3::new(1_048_576.0, -1_048_576.0, 524_288.0);
    let worst = near
        .iter()
        .flatten()
        .zip(far.iter().flatten())
        .map(|(near, far)| (*far - away - *near).length())
        .fold(0.0, f64::max);
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn normals_stay_upright_on_what_is_stretched_bent_and_mirrored() {
    let mut gltf = shape();
    let normals: Vec<f32> =
        [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::ONE.normalize()].iter().flat_map(|n| n.to_array()).collect();
    let normals = gltf.floats("VEC3", &normals);
    let file = gltf.file(&format!(
        r#""nodes":[{{"mesh":0,"scale":[-2,1,0.5],"rotation":[0.5,0.5,0.5,0.5]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":{normals}}},"indices":1}}]}}]"#
    ));
    let mesh = open(&file, &MeshOptions::default());
    let normals = mesh.rest().normals.as_ref().unwrap();
    let turn = DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5);
    assert!((normals[0].as_dvec3() - turn * DVec3::Z).length() < 1e-6, "{}", normals[0]);
    let oblique = turn * DVec3::new(-0.5, 1.0, 2.0).normalize();
    assert!((normals[3].as_dvec3() - oblique).length() < 1e-6, "{}", normals[3]);
    // The triangle in x and y faced its normal before it was mirrored, and does so afterwards.
    let [a, b, c] = mesh.triangles()[0].map(|vertex| mesh.rest().positions[vertex as usize]);
    assert!((b - a).cross(c - a).dot(normals[0].as_dvec3()) > 0.0);
}

/// Target 0 moves vertex 1 alone (sparse, no values of its own), target 1 all of them; both are animated, and the
/// mesh says defaults.
#[test]
fn morph_targets_add_up() {
    let mut gltf = shape();
    let index = gltf.view(&[1]);
    let delta: Vec<u8> = [0.0_f32, 0.0, 3.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let delta = gltf.view(&delta);
    let sparse = gltf.accessor(&format!(
        r#""componentType":5126,"count":4,"type":"VEC3","sparse":{{"count":1,
        "indices":{{"bufferView":{index},"componentType":5121}},"values":{{"bufferView":{delta}}}}}"#
    ));
    let all = gltf.floats("VEC3", &[-1., 0., 0.].repeat(4));
    let normals = gltf.floats("VEC3", &[0., 0., 1.].repeat(4));
    let tilts = gltf.floats("VEC3", &[0., 1., 0.].repeat(4));
    let input = gltf.floats("SCALAR", &[0.0, 1.0]);
    let output = gltf.floats("SCALAR", &[0.0, 1.0, 1.0, 0.5]);
    let members = format!(
        r#""nodes":[{{"mesh":0}}],"meshes":[{{"weights":[0.25,2],"primitives":[
        {{"attributes":{{"POSITION":0,"NORMAL":{normals}}},"indices":1,
        "targets":[{{"POSITION":{sparse}}},{{"POSITION":{all},"NORMAL":{tilts}}}]}}]}}],
        "animations":[{{"samplers":[{{"input":{input},"output":{output}}}],
        "channels":[{{"sampler":0,"target":{{"node":0,"path":"weights"}}}}]}}]"#
    );
    let mesh = open(&gltf.file(&members), &MeshOptions::default());
    assert_eq!(mesh.rest().positions[1], DVec3::new(-1.0, 0.0, 0.75));
    assert_eq!(mesh.pose(0.5).unwrap().positions[1], DVec3::new(0.25, 0.0, 1.5));
    assert_eq!(mesh.pose(1.0).unwrap().positions[0], DVec3::new(-0.5, 0.0, 0.0));
    let normal = mesh.pose(0.0).unwrap().normals.unwrap()[2];
    assert!((normal - Vec3::new(0.0, 1.0, 1.0).normalize()).length() < 1e-6, "{normal}");
    let still = MeshOptions { animation: AnimationChoice::None, ..MeshOptions::default() };
    let still = open(&gltf.file(&members), &still);
    assert_eq!(still.pose(0.5).unwrap(), *still.rest());
    assert!(!still.moves() && still.time_range().is_none());
    // Too few weights for the keys and targets.
    let short = members.replace(&format!(r#""output":{output}"#), &format!(r#""output":{input}"#));
    let error = open_as("a.glb", &gltf.file(&short), &MeshOptions::default()).unwrap_err().to_string();
    assert!(error.contains("animations[0].samplers[0]: 2 numbers for 2 keys, expected 2 a key"), "{error}");
}

#[test]
fn animations_are_chosen_by_name_and_number() {
    let mut gltf = shape();
    let members = arm(&mut gltf, "");
    let file = gltf.file(&members);
    let end = |animation| {
        let mesh = open_as("a.glb", &file, &MeshOptions { animation, ..MeshOptions::default() })?;
        Ok::<_, MeshError>(mesh.pose(1.0).unwrap().positions[1].y)
    };
    assert!(end(AnimationChoice::Index(1)).unwrap() > 0.5);
    assert_eq!(end(AnimationChoice::Index(1)).unwrap(), end(AnimationChoice::Name("bend".into())).unwrap());
    assert!(end(AnimationChoice::First).unwrap().abs() < 1e-12, "the first holds still");
    let told = |choice| end(choice).unwrap_err().to_string();
    assert!(
        told(AnimationChoice::Name("run".into()))
            .ends_with(r#"no animation "run"; it has 0 "still", 1 "bend""#)
    );
    assert!(told(AnimationChoice::Index(2)).contains("no animation number 2"));
}

#[test]
fn a_pose_is_made_without_taking_memory() {
    let mut gltf = shape();
    let members = arm(&mut gltf, "");
    let mesh = open(&gltf.file(&members), &bend());
    let mut pose = mesh.pose(0.0).unwrap();
    let (positions, normals) = (pose.positions.as_ptr(), pose.normals.as_ref().unwrap().as_ptr());
    mesh.pose_into(0.7, &mut pose).unwrap();
    assert_eq!(pose, mesh.pose(0.7).unwrap());
    assert_eq!((positions, normals), (pose.positions.as_ptr(), pose.normals.as_ref().unwrap().as_ptr()));
}

#[test]
fn options_out_of_range_are_told() {
    let file = moved("scale", "LINEAR", "VEC3", &[0.0], &[1., 1., 1.]);
    let told = |options: MeshOptions| open_as("a.glb", &file, &options).unwrap_err().to_string();
    let plain = MeshOptions::default;
    assert_eq!(
        told(MeshOptions { frame_rate: Some(0.0), ..plain() }),
        "frame rate 0: expected a number above 0"
    );
    assert!(told(MeshOptions { step: Some(f64::NAN), ..plain() }).starts_with("step NaN"));
    assert!(told(MeshOptions { frames: Some((3.0, 2.0)), ..plain() }).starts_with("last frame 2"));
    assert!(
        told(MeshOptions { rest: RestPose::Time(f64::INFINITY), ..plain() }).starts_with("rest time inf")
    );
    let mesh = open(&file, &plain());
    assert!(mesh.pose(f64::NAN).unwrap_err().to_string().starts_with("time NaN"));
    assert!(mesh.joint_worlds(f64::NAN).is_err());
}

#[test]
fn keys_that_are_wrong_are_told() {
    let told = |times: &[f32], values: &[f32]| {
        let file = moved("translation", "LINEAR", "VEC3", times, values);
        open_as("a.glb", &file, &MeshOptions::default()).unwrap_err().to_string()
    };
    let two = [0.0; 6];
    assert!(told(&[0.0, f32::NAN], &two).contains("animations[0].samplers[0]: key 1 is at time NaN"));
    assert!(told(&[1.0, 0.0], &two).contains("key 1 is at 0 s after key 0 at 1 s"));
    assert!(told(&[0.0], &two).contains("6 numbers for 1 keys, expected 3 a key"));
    assert!(told(&[0.0, 1.0], &[0., 0., 0., 0., f32::INFINITY, 0.]).contains("key 1 holds inf"));
}

#[test]
fn texture_coordinates_go_up_and_parts_have_their_materials() {
    let mut gltf = shape();
    let uvs = gltf.floats("VEC2", &[0., 0., 1., 0., 0., 1., 0.25, 0.75]);
    let picture = {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let image = image::RgbImage::from_fn(2, 1, |x, _| image::Rgb([255 * x as u8, 0, 0]));
        image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        gltf.view(bytes.get_ref())
    };
    let file = gltf.file(&format!(
        r#""nodes":[{{"mesh":0}}],"meshes":[{{"name":"two","primitives":[
        {{"attributes":{{"POSITION":0}},"indices":1}},
        {{"attributes":{{"POSITION":0,"TEXCOORD_1":{uvs}}},"indices":1,"material":0}},
        {{"attributes":{{"POSITION":0}},"indices":1,"material":1}}]}}],
        "materials":[{{"name":"skin","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0.25,1],"baseColorTexture":{{"index":0,"texCoord":1}}}}}},
        {{"name":"lost","pbrMetallicRoughness":{{"baseColorTexture":{{"index":1}}}}}}],
        "textures":[{{"source":0}},{{"source":1}}],"images":[{{"bufferView":{picture}}},{{"uri":"lost.png"}}]"#
    ));
    let mesh = open(&file, &MeshOptions::default());
    let [bare, skin, lost] = mesh.parts() else { panic!("{:?}", mesh.parts()) };
    assert_eq!((bare.material.as_deref(), bare.has_uvs, bare.triangles.clone()), (None, false, 0..2));
    assert!(bare.texture().unwrap().is_none() && bare.base_color == Vec3::ONE);
    assert_eq!((skin.material.as_deref(), skin.has_uvs, skin.triangles.clone()), (Some("skin"), true, 2..4));
    assert_eq!(skin.base_color, Vec3::new(1.0, 0.5, 0.25));
    let texture = skin.texture().unwrap().unwrap();
    assert_eq!((texture.width, texture.height, texture.pixels), (2, 1, vec![Vec3::ZERO, Vec3::X]));
    let uvs = mesh.uvs().unwrap();
    assert_eq!((uvs[3], uvs[4], uvs[7]), (Vec2::ZERO, Vec2::new(0.0, 1.0), Vec2::new(0.25, 0.25)));
    // A picture that is not there is no reason to refuse the mesh.
    assert!(matches!(lost.texture(), Err(MeshError::Io { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn animated_files_that_were_bent_are_read_or_refused(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        time in -1.0..2.0,
    ) {
        let mut gltf = shape();
        let members = arm(&mut gltf, "");
        let mut file = gltf.file(&members);
        for (at, value) in changes {
            let at = at.index(file.len());
            file[at] = value;
        }
        if let Ok(mesh) = open_as("a.glb", &file, &bend()) {
            let _ = (mesh.pose(time), mesh.joint_worlds(time));
        }
    }
}
