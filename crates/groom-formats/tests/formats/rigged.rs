//! Grooms that follow joints, and frames as morph targets: what a glTF file says is worked out here, number by number.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

use std::path::Path;

use glam::{DMat4, DQuat, DVec3, EulerRot, Mat4, Quat, Vec3};
use groom::{Groom, UpAxis};
use groom_formats::{
    Format, FormatError, Frame, Influences, Mesh, MotionOptions, ReadOptions, Rig, RigFrame, RigJoint,
    Warning, WriteOptions, read, write_animation, write_rigged,
};
use proptest::prelude::*;
use serde_json::Value;

/// A `.glb` that is open.
struct Glb {
    json: Value,
    bytes: Vec<u8>,
}

impl Glb {
    fn open(path: &Path) -> Glb {
        let file = std::fs::read(path).unwrap();
        let len = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&file[20..20 + len]).unwrap();
        assert_eq!(u32::from_le_bytes(file[8..12].try_into().unwrap()) as usize, file.len());
        Glb { json, bytes: file[28 + len..].to_vec() }
    }

    /// An accessor's values, `width` numbers each.
    fn accessor(&self, index: &Value) -> Vec<Vec<f32>> {
        let accessor = &self.json["accessors"][index.as_u64().unwrap() as usize];
        let view = &self.json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            other => panic!("{other}"),
        };
        let kind = accessor["componentType"].as_u64().unwrap();
        let size = match kind {
            5121 => 1,
            5123 => 2,
            _ => 4,
        };
        let stride = view["byteStride"].as_u64().map_or(width * size, |stride| stride as usize);
        let start = view["byteOffset"].as_u64().unwrap_or(0) + accessor["byteOffset"].as_u64().unwrap_or(0);
        let number = |bytes: &[u8]| match (kind, accessor["normalized"].as_bool() == Some(true)) {
            (5121, _) => f32::from(bytes[0]),
            (5123, false) => f32::from(u16::from_le_bytes(bytes.try_into().unwrap())),
            (5123, true) => f32::from(u16::from_le_bytes(bytes.try_into().unwrap())) / 65535.0,
            _ => f32::from_le_bytes(bytes.try_into().unwrap()),
        };
        let value = |at: usize| {
            let at = start as usize + at * stride;
            (0..width).map(|i| number(&self.bytes[at + i * size..at + (i + 1) * size])).collect()
        };
        (0..accessor["count"].as_u64().unwrap() as usize).map(value).collect()
    }

    /// A property of a node at key `key`: animated, or as the node has it.
    fn property(&self, node: usize, path: &str, key: usize, otherwise: &[f32]) -> Vec<f32> {
        let animation = &self.json["animations"][0];
        let channels = animation["channels"].as_array().into_iter().flatten();
        for channel in channels {
            if channel["target"]["node"] == node && channel["target"]["path"] == path {
                let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
                assert_eq!(sampler["interpolation"].as_str().unwrap_or("LINEAR"), "LINEAR");
                let values = self.accessor(&sampler["output"]);
                if path == "weights" {
                    let targets = values.len() / self.accessor(&sampler["input"]).len();
                    return values[key * targets..(key + 1) * targets].concat();
                }
                return values[key].clone();
            }
        }
        let said = self.json["nodes"][node][path].as_array();
        said.map_or(otherwise.to_vec(), |v| v.iter().map(|v| v.as_f64().unwrap() as f32).collect())
    }

    fn local(&self, node: usize, key: usize) -> DMat4 {
        let three = |path, otherwise| {
            let v = self.property(node, path, key, &[otherwise; 3]);
            Vec3::from_slice(&v).as_dvec3()
        };
        let turn = Quat::from_slice(&self.property(node, "rotation", key, &[0.0, 0.0, 0.0, 1.0])).as_dquat();
        DMat4::from_scale_rotation_translation(
            three("scale", 1.0),
            turn.normalize(),
            three("translation", 0.0),
        )
    }

    fn world(&self, node: usize, key: usize) -> DMat4 {
        let nodes = self.json["nodes"].as_array().unwrap();
        let is_child = |other: &Value| {
            other["children"].as_array().is_some_and(|children| children.iter().any(|child| *child == node))
        };
        let parent = nodes.iter().position(is_child);
        parent.map_or(DMat4::IDENTITY, |parent| self.world(parent, key)) * self.local(node, key)
    }

    /// Where the vertices are at key `key`.
    fn vertices(&self, key: usize) -> Vec<DVec3> {
        let primitive = &self.json["meshes"][0]["primitives"][0];
        let attribute = |name: &str| self.accessor(&primitive["attributes"][name]);
        let points: Vec<DVec3> =
            attribute("POSITION").iter().map(|v| Vec3::from_slice(v).as_dvec3()).collect();
        let node = self.json["nodes"].as_array().unwrap().iter().position(|n| n["mesh"] == 0).unwrap();
        if let Some(skin) = self.json["skins"].get(0) {
            let inverse_binds = self.accessor(&skin["inverseBindMatrices"]);
            let joints = skin["joints"].as_array().unwrap().iter().zip(inverse_binds);
            let matrices: Vec<DMat4> = joints
                .map(|(joint, bind)| {
                    let bind = Mat4::from_cols_array(&bind.try_into().unwrap());
                    self.world(joint.as_u64().unwrap() as usize, key) * bind.as_dmat4()
                })
                .collect();
            let (joints, weights) = (attribute("JOINTS_0"), attribute("WEIGHTS_0"));
            let skinned = points.iter().zip(joints.iter().zip(&weights)).map(|(p, (joints, weights))| {
                let each = joints.iter().zip(weights);
                each.map(|(&j, &w)| matrices[j as usize].transform_point3(*p) * f64::from(w)).sum()
            });
            return skinned.collect();
        }
        let weights = self.property(node, "weights", key, &[]);
        let mut moved = points;
        for (target, weight) in primitive["targets"].as_array().into_iter().flatten().zip(weights) {
            for (point, by) in moved.iter_mut().zip(self.accessor(&target["POSITION"])) {
                *point += Vec3::from_slice(&by).as_dvec3() * f64::from(weight);
            }
        }
        let world = self.world(node, key);
        moved.iter().map(|point| world.transform_point3(*point)).collect()
    }
}

/// Strands of 3, 1, 4 and 2 points, z up, in centimetres.
fn groom() -> Groom {
    let points = (0..10).map(|i| Vec3::new(i as f32 * 0.37, (i * i) as f32 * 0.11, 1.0 - i as f32 / 3.0));
    let mut groom = Groom::new(vec![0, 3, 4, 8, 10], points.collect()).unwrap();
    (groom.up_axis, groom.meters_per_unit) = (UpAxis::Z, 0.01);
    groom
}

/// A chain of three joints and one that stands alone, bound where they are at time 0.
fn rig(origin: DVec3) -> Rig {
    let joint = |name: &str, parent, place| RigJoint {
        name: name.to_owned(),
        parent,
        inverse_bind: world(place, 0.0, origin).inverse(),
    };
    let joints = vec![
        joint("hip", None, 0),
        joint("a neck", Some(0), 1),
        joint("a-neck", Some(1), 2),
        joint("2", None, 3),
    ];
    let influences = [
        vec![(0, 1.0)],
        vec![(3, 1.0)],
        vec![(1, 0.25), (2, 0.5), (0, 0.25)],
        vec![(3, 0.1), (2, 0.3), (0, 0.2), (1, 0.4)],
    ];
    let influences = influences.iter().map(|all| Influences::strongest(all).unwrap()).collect();
    Rig { joints, influences }
}

/// Where joint `place` is at a time: turned, moved, scaled; the last is mirrored.
fn world(place: usize, time: f64, origin: DVec3) -> DMat4 {
    let local = |place: usize| {
        let k = place as f64 + 1.0;
        let turn = DQuat::from_euler(EulerRot::XYZ, 0.3 * time * k, 0.2 * k, -1.1 * time);
        let scale = if place == 3 { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::splat(1.0 + 0.5 * time) };
        let scale = if place == 1 { DVec3::new(2.0, 0.5, 1.0) } else { scale };
        DMat4::from_scale_rotation_translation(scale, turn, DVec3::new(k, time * k, -0.5))
    };
    let chain = match place {
        // Its own parent does not scale unevenly, so that nothing shears.
        1 => local(0) * local(1),
        2 => local(0) * DMat4::from_translation(DVec3::X) * DMat4::from_rotation_z(0.1 * time),
        other => local(other),
    };
    DMat4::from_translation(origin) * chain
}

fn frames(times: &[f64], origin: DVec3) -> Vec<RigFrame> {
    let frame =
        |&time: &f64| RigFrame { time, joints: (0..4).map(|place| world(place, time, origin)).collect() };
    times.iter().map(frame).collect()
}

/// Linear blend skinning, point by point of the strands that can be drawn.
fn skinned(groom: &Groom, rig: &Rig, frame: &RigFrame, origin: DVec3) -> Vec<DVec3> {
    let mut all = Vec::new();
    for (points, influences) in groom.strands().zip(&rig.influences).filter(|(points, _)| points.len() > 1) {
        for point in points {
            let point = point.as_dvec3() + origin;
            let each = influences.iter().map(|(joint, weight)| {
                let matrix = frame.joints[joint] * rig.joints[joint].inverse_bind;
                matrix.transform_point3(point) * f64::from(weight)
            });
            all.push(each.sum::<DVec3>() - origin);
        }
    }
    all
}

/// Y up, metres.
fn in_gltf(point: DVec3) -> DVec3 {
    DVec3::new(point.x, point.z, -point.y) * 0.01
}

fn give(frames: &[RigFrame]) -> impl Iterator<Item = Result<RigFrame, FormatError>> + use<> {
    Vec::from(frames).into_iter().map(Ok)
}

fn assert_near(found: &[DVec3], expected: &[DVec3], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (place, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!(a.distance(*b) <= tolerance, "{what}: point {place} is at {a}, expected {b}");
    }
}

#[test]
fn a_skin_puts_every_point_where_the_joints_do() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let groom = groom();
    let times = [0.0, 1.0, 2.5, 7.0];
    for origin in [DVec3::ZERO, DVec3::new(1e6, -3.0, 2e5)] {
        // Joint 2 hangs from joint 1, which scales unevenly: as a child of joint 0 it shears nothing.
        let mut rig = rig(origin);
        rig.joints[2].parent = Some(0);
        let frames = frames(&times, origin);
        let motion = MotionOptions { origin, ..MotionOptions::at_rate(30.0) };
        for (options, each) in [
            (WriteOptions::default(), 1),
            (WriteOptions { quantize: Some(16), ..WriteOptions::default() }, 1),
            (WriteOptions { quantize: Some(20), ..WriteOptions::default() }, 1),
            (WriteOptions { mesh: Some(Mesh::Tubes { sides: 4 }), ..WriteOptions::default() }, 4),
        ] {
            let warnings = write_rigged(&groom, &rig, &mut give(&frames), &motion, &path, &options).unwrap();
            let others = |w: &&Warning| {
                !matches!(w, Warning::OnePointStrandsLeftOut { .. } | Warning::PositionsRounded { .. })
            };
            assert_eq!(warnings.iter().find(others), None);
            let glb = Glb::open(&path);
            let input = &glb.json["animations"][0]["samplers"][0]["input"];
            let seconds: Vec<f32> = glb.accessor(input).concat();
            assert_eq!(seconds, times.map(|time| (time / 30.0) as f32));
            for (key, frame) in frames.iter().enumerate() {
                let expected: Vec<DVec3> =
                    skinned(&groom, &rig, frame, origin).into_iter().map(in_gltf).collect();
                // Readers add the origin in 32 bits; the strands' shape is what counts.
                let placed = in_gltf(origin).as_vec3().as_dvec3();
                let vertices = glb.vertices(key);
                let middles =
                    vertices.chunks(each).map(|ring| ring.iter().sum::<DVec3>() / each as f64 - placed);
                let tolerance = if options.quantize == Some(16) { 1e-5 } else { 1e-6 };
                assert_near(
                    &middles.collect::<Vec<_>>(),
                    &expected,
                    tolerance,
                    &format!("key {key}, {options:?}"),
                );
            }
        }
    }
}

#[test]
fn a_shear_is_told_with_its_size_and_children_do_not_add_to_it() {
    let folder = tempfile::tempdir().unwrap();
    let groom = groom();
    let rig = rig(DVec3::ZERO);
    let frames = frames(&[0.0, 1.0], DVec3::ZERO);
    for ending in ["glb", "usda"] {
        let path = folder.path().join(format!("a.{ending}"));
        let motion = MotionOptions::at_rate(24.0);
        let warnings =
            write_rigged(&groom, &rig, &mut give(&frames), &motion, &path, &WriteOptions::default()).unwrap();
        let Some(Warning::JointsApproximated { joint, part, .. }) = warnings.last() else {
            panic!("{warnings:?}")
        };
        assert_eq!(joint, "a-neck", "the child of one that scales unevenly");
        assert!((0.001..10.0).contains(part), "{part}");
        assert!(warnings.last().unwrap().to_string().contains("the strands of `a-neck` are off by up to"));
    }
}

#[test]
fn what_does_not_move_has_no_keys() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gltf");
    let mut frames = frames(&[0.0, 1.0], DVec3::ZERO);
    frames[1].joints = frames[0].joints.clone();
    let motion = MotionOptions::at_rate(24.0);
    let rig = Rig { joints: rig(DVec3::ZERO).joints, ..rig(DVec3::ZERO) };
    write_rigged(&groom(), &rig, &mut give(&frames), &motion, &path, &WriteOptions::default()).unwrap();
    let json: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(json["animations"], Value::Null);
    assert_eq!(json["skins"][0]["joints"].as_array().unwrap().len(), 4);
    assert!(path.with_extension("bin").is_file());
}

#[test]
fn rigs_that_move_nothing_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let (groom, good) = (groom(), rig(DVec3::ZERO));
    let moving = frames(&[0.0, 1.0], DVec3::ZERO);
    let rigged = |change: &dyn Fn(&mut Rig)| {
        let mut rig = good.clone();
        change(&mut rig);
        (rig, moving.clone())
    };
    let framed = |change: &dyn Fn(&mut Vec<RigFrame>)| {
        let mut frames = moving.clone();
        change(&mut frames);
        (good.clone(), frames)
    };
    let cases = [
        (rigged(&|rig| rig.joints.clear()), "joints: found none"),
        (rigged(&|rig| rig.joints[1].parent = Some(1)), "parent of joint 1 (`a neck`): found joint 1"),
        (rigged(&|rig| rig.joints[0].inverse_bind = DMat4::ZERO), "inverse bind matrix of joint 0 (`hip`)"),
        (
            rigged(&|rig| rig.joints[0].inverse_bind = DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0))),
            "found a determinant of 0, expected a matrix that has an inverse",
        ),
        (rigged(&|rig| rig.influences.truncate(3)), "influences: found 3, expected 4, one a strand"),
        (
            rigged(&|rig| rig.influences[2].joints[0] = 4),
            "influences of strand 2: found joint 4, expected 0 to 3",
        ),
        (rigged(&|rig| rig.influences[2].joints = [1; 4]), "influences of strand 2: found joint 1 twice"),
        (rigged(&|rig| rig.influences[0].weights[0] = 0.5), "found weights that sum to 0.5"),
        (rigged(&|rig| rig.influences[0].weights[1] = f32::NAN), "found a weight of NaN"),
        (framed(&|frames| frames.clear()), "frames: found none"),
        (framed(&|frames| frames[1].time = 0.0), "time of frame 1: found 0, expected more than 0"),
        (framed(&|frames| frames[1].time = f64::NAN), "time of frame 1: found NaN"),
        (framed(&|frames| frames[1].joints.truncate(2)), "joints of frame 1: found 2, expected 4"),
        (
            framed(&|frames| frames[0].joints[2].w_axis.x = f64::INFINITY),
            "joint 2 of frame 0: found a number",
        ),
    ];
    for ending in ["usdc", "glb"] {
        let path = folder.path().join(format!("a.{ending}"));
        std::fs::write(&path, "old").unwrap();
        for ((rig, frames), words) in &cases {
            let motion = MotionOptions::at_rate(24.0);
            let error =
                write_rigged(&groom, rig, &mut give(frames), &motion, &path, &WriteOptions::default());
            let told = error.unwrap_err().to_string();
            assert!(told.contains(words), "{told}: {words}");
            assert_eq!(std::fs::read(&path).unwrap(), b"old");
        }
    }
    let refused = |path: &str, times: &[f64], rate: f64| {
        let motion = MotionOptions::at_rate(rate);
        let mut frames = give(&frames(times, DVec3::ZERO));
        write_rigged(&groom, &good, &mut frames, &motion, &folder.path().join(path), &WriteOptions::default())
            .unwrap_err()
            .to_string()
    };
    assert!(refused("a.abc", &[0.0], 24.0).contains("expected one of .usda"));
    assert!(refused("a.glb", &[-1.0], 24.0).contains("time of frame 0: found -1"));
    assert!(refused("a.glb", &[1e9, 1e9 + 1.0], 24.0).contains("in the 32 bits that glTF has"));
    assert!(refused("a.glb", &[1.0], 0.0).contains("frame rate: found 0"));
}

#[test]
fn joints_that_floats_cannot_hold_are_refused_by_name_even_if_no_strand_follows_them() {
    let folder = tempfile::tempdir().unwrap();
    let (groom, mut rig) = (groom(), rig(DVec3::ZERO));
    rig.joints.push(RigJoint { name: "free".to_owned(), parent: None, inverse_bind: DMat4::IDENTITY });
    let refused = |rig: &Rig, last: DMat4, ending: &str| {
        let mut frames = frames(&[0.0, 1.0], DVec3::ZERO);
        frames[0].joints.push(DMat4::IDENTITY);
        frames[1].joints.push(last);
        let path = folder.path().join(format!("a.{ending}"));
        let motion = MotionOptions::at_rate(24.0);
        let written = write_rigged(&groom, rig, &mut give(&frames), &motion, &path, &WriteOptions::default());
        assert_eq!(path.exists(), written.is_ok());
        written.err().map(|error| error.to_string()).unwrap_or_default()
    };
    for ending in ["usda", "glb"] {
        let far = DMat4::from_translation(DVec3::new(0.0, 1e41, 0.0));
        let error = refused(&rig, far, ending);
        let place = "joint 4 (`free`) of frame 1: found a translation of [0,";
        assert!(error.contains(place) && error.contains("inf"), "{error}");
        assert!(refused(&rig, DMat4::from_scale(DVec3::splat(60_000.0)), ending).is_empty());
    }
    let error = refused(&rig, DMat4::from_scale(DVec3::splat(70_000.0)), "usdc");
    assert!(error.contains("joint 4 (`free`) of frame 1") && error.contains("up to 65504"), "{error}");
    rig.joints[4].inverse_bind = DMat4::from_translation(DVec3::X * 1e45);
    let error = refused(&rig, DMat4::IDENTITY, "gltf");
    assert!(error.contains("inverse bind matrix of joint 4 (`free`)"), "{error}");
}

#[test]
fn readers_say_that_they_follow_neither_joints_nor_morph_targets() {
    let folder = tempfile::tempdir().unwrap();
    let (groom, rig) = (groom(), rig(DVec3::ZERO));
    let motion = MotionOptions::at_rate(24.0);
    let told = |path: &Path| {
        let loaded = read(path, &ReadOptions::default()).unwrap();
        let names: Vec<String> = loaded.groom.attributes().map(|(name, _)| name.to_owned()).collect();
        assert!(names.iter().all(|name| !name.contains("skel")), "{names:?}");
        let warnings = loaded.warnings.iter().map(ToString::to_string);
        warnings.filter(|warning| warning.contains("as modelled")).collect::<Vec<_>>().join("|")
    };
    for ending in ["usda", "usdc", "glb", "gltf"] {
        let path = folder.path().join(format!("a.{ending}"));
        let frames = frames(&[0.0, 1.0], DVec3::ZERO);
        write_rigged(&groom, &rig, &mut give(&frames), &motion, &path, &WriteOptions::default()).unwrap();
        let expected = "joints of the file move the strands";
        assert!(told(&path).starts_with(expected) && !told(&path).contains('|'), "{}", told(&path));
        assert_eq!(told(&path).contains("tools/usd/bake.py"), ending.starts_with("usd"));
    }
    let path = folder.path().join("a.glb");
    let frame = |f: u32| Frame {
        time: f64::from(f),
        positions: groom.positions().iter().map(|p| *p * f as f32).collect(),
        ..Frame::default()
    };
    let mut given = (1..3).map(|f| Ok(frame(f)));
    write_animation(&groom, &mut given, &motion, &path, &WriteOptions::default()).unwrap();
    assert!(told(&path).starts_with("morph targets of the file"), "{}", told(&path));
}

#[test]
fn a_groom_that_is_all_in_one_place_loses_no_shape() {
    let folder = tempfile::tempdir().unwrap();
    let groom = Groom::new(vec![0, 2], vec![Vec3::new(0.1, 0.2, 0.3); 2]).unwrap();
    let joint = RigJoint { name: "a".to_owned(), parent: None, inverse_bind: DMat4::IDENTITY };
    let influences = vec![Influences { joints: [0; 4], weights: [1.0, 0.0, 0.0, 0.0] }];
    let rig = Rig { joints: vec![joint], influences };
    let at = DMat4::from_rotation_translation(DQuat::from_rotation_z(0.7), DVec3::new(100.1, 1.0 / 3.0, 0.0));
    let frame = RigFrame { time: 0.0, joints: vec![at] };
    let motion = MotionOptions::at_rate(24.0);
    let path = folder.path().join("a.usda");
    let warnings =
        write_rigged(&groom, &rig, &mut give(&[frame]), &motion, &path, &WriteOptions::default()).unwrap();
    assert!(
        warnings.iter().all(|warning| !matches!(warning, Warning::JointsApproximated { .. })),
        "{warnings:?}"
    );
}

#[test]
fn morph_targets_are_the_frames() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let groom = groom();
    let origin = DVec3::new(5e5, 1.0, -2.0);
    for count in [1, 2, 6] {
        let frame = |f: u32| Frame {
            time: f64::from(f) * 0.5,
            positions: groom
                .positions()
                .iter()
                .map(|p| *p + Vec3::new((p.x + f as f32).sin(), f as f32, 0.0))
                .collect(),
            ..Frame::default()
        };
        let frames: Vec<Frame> = (0..count).map(frame).collect();
        let motion = MotionOptions { origin, ..MotionOptions::at_rate(24.0) };
        let mut given = frames.iter().cloned().map(Ok);
        write_animation(&groom, &mut given, &motion, &path, &WriteOptions::default()).unwrap();
        let glb = Glb::open(&path);
        assert_eq!(glb.json["animations"].is_null(), count == 1);
        for (key, frame) in frames.iter().enumerate() {
            let drawn = groom.strands().enumerate().filter(|(_, points)| points.len() > 1);
            let expected = drawn.flat_map(|(strand, _)| frame.positions[groom.strand_range(strand)].iter());
            let expected: Vec<DVec3> = expected.map(|p| in_gltf(p.as_dvec3())).collect();
            let placed = in_gltf(origin).as_vec3().as_dvec3();
            let found: Vec<DVec3> = glb.vertices(key).into_iter().map(|v| v - placed).collect();
            assert_near(&found, &expected, 1e-7, &format!("key {key} of {count}"));
        }
    }
}

#[test]
fn morphs_that_cannot_be_are_refused_and_many_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    std::fs::write(&path, "old").unwrap();
    let groom = groom();
    let animate = |count: u32, options: &WriteOptions| {
        let frame = |f: u32| Frame {
            time: f64::from(f),
            positions: groom.positions().to_vec(),
            velocities: Some(vec![Vec3::X; 10]),
            ..Frame::default()
        };
        let mut frames = (0..count).map(|f| Ok(frame(f)));
        write_animation(&groom, &mut frames, &MotionOptions::at_rate(24.0), &path, options)
    };
    let plain = WriteOptions::default();
    for (count, options, words) in [
        (2, WriteOptions { mesh: Some(Mesh::Ribbons), ..plain.clone() }, "no frames for tubes and ribbons"),
        (2, WriteOptions { quantize: Some(12), ..plain.clone() }, "no frames of rounded positions"),
        (0, plain.clone(), "frames: found none"),
        (2000, plain.clone(), "frames, as morph targets, are more than"),
    ] {
        let told = animate(count, &options).unwrap_err().to_string();
        assert!(told.contains(words), "{told}");
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
    }
    let warnings = animate(100, &plain).unwrap();
    let velocity = Warning::AttributeLeftOut { format: Format::Glb, name: "velocity".into() };
    assert!(warnings.contains(&velocity), "{warnings:?}");
    let many = Warning::ManyMorphTargets { format: Format::Glb, targets: 99, bytes: 99 * 9 * 12 };
    assert!(warnings.contains(&many), "{warnings:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_rigid_motion_is_held(
        numbers in proptest::collection::vec(-4.0_f64..4.0, 36),
        mirrored in any::<bool>(),
        scale in 0.01_f64..100.0,
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glb");
        let groom = groom();
        let place = |n: &[f64]| {
            let turn = DQuat::from_euler(EulerRot::XYZ, n[0], n[1], n[2]);
            let scale = DVec3::splat(scale * if mirrored { -1.0 } else { 1.0 });
            DMat4::from_scale_rotation_translation(scale, turn, DVec3::from_slice(&n[3..6]))
        };
        let worlds: Vec<DMat4> = numbers.chunks(6).map(place).collect();
        let joint = |i: usize| RigJoint {
            name: String::new(),
            parent: i.checked_sub(1),
            inverse_bind: worlds[i].inverse(),
        };
        let rig = Rig { joints: (0..3).map(joint).collect(), influences: vec![Influences::strongest(&[(2, 0.7), (0, 0.3)]).unwrap(); 4] };
        let moving = [
            RigFrame { time: 0.0, joints: worlds[..3].to_vec() },
            RigFrame { time: 1.0, joints: worlds[3..].to_vec() },
        ];
        let motion = MotionOptions::at_rate(24.0);
        write_rigged(&groom, &rig, &mut give(&moving), &motion, &path, &WriteOptions::default()).unwrap();
        let glb = Glb::open(&path);
        for (key, frame) in moving.iter().enumerate() {
            let expected: Vec<DVec3> = skinned(&groom, &rig, frame, DVec3::ZERO).into_iter().map(in_gltf).collect();
            let size = expected.iter().fold(0.1, |a: f64, p| a.max(p.length()));
            for (a, b) in glb.vertices(key).iter().zip(&expected) {
                prop_assert!(a.distance(*b) <= 2e-5 * size.max(0.1 / scale), "{} {}", a, b);
            }
        }
    }
}
