//! Strands that move, as other programs see them: usd-core, the Khronos validator and Blender.

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{say_skipped, validators, workspace};
use glam::{DMat4, DQuat, DVec3, EulerRot, Vec3};
use groom::{Attribute, Groom, UpAxis, names};
use groom_formats::{
    FormatError, Frame, Influences, Mesh, MotionOptions, ReadOptions, Rig, RigFrame, RigJoint, Warning,
    WriteOptions, read_moving, write_animation, write_rigged,
};
use serde_json::{Value, json};
use usd_core::{BakeOptions, UsdCore};

/// Units per second.
const SPEED: f64 = 3.0;
const USD: [&str; 3] = ["usda", "usdc", "usdz"];

/// Two strands along y and one along z.
fn groom(up_axis: UpAxis) -> Groom {
    let strand = |x: f32, along: Vec3| (0..3).map(move |i| Vec3::X * x + along * i as f32);
    let points = strand(0.0, Vec3::Y).chain(strand(0.25, Vec3::Y)).chain(strand(0.5, Vec3::Z));
    let mut groom = Groom::new(vec![0, 3, 6, 9], points.collect()).unwrap();
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.02)).unwrap();
    (groom.up_axis, groom.meters_per_unit) = (up_axis, 1.0);
    groom
}

/// Along +x: SPEED units a second, and `gain` more every second.
fn along_x(groom: &Groom, times: &[f64], rate: f64, gain: f64) -> Vec<Frame> {
    let frame = |&time: &f64| {
        let seconds = time / rate;
        let by = SPEED * seconds + 0.5 * gain * seconds * seconds;
        let positions = groom.positions().iter().map(|p| (p.as_dvec3() + DVec3::X * by).as_vec3()).collect();
        let each = |vector: DVec3| vec![vector.as_vec3(); groom.point_count()];
        let velocities = Some(each(DVec3::X * (SPEED + gain * seconds)));
        let accelerations = (gain != 0.0).then(|| each(DVec3::X * gain));
        Frame { time, positions, velocities, accelerations }
    };
    times.iter().map(frame).collect()
}

fn animate(groom: &Groom, frames: &[Frame], motion: &MotionOptions, path: &Path) {
    let mut given = frames.iter().cloned().map(Ok);
    write_animation(groom, &mut given, motion, path, &WriteOptions::default()).unwrap();
}

#[test]
fn velocities_are_units_per_second_wherever_time_codes_are() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groom = groom(UpAxis::Y);
    for rate in [24.0, 30.0, 60.0] {
        for gain in [0.0, 12.0] {
            let path = folder.path().join("a.usdc");
            let frames = along_x(&groom, &[10.0, 11.0], rate, gain);
            animate(&groom, &frames, &MotionOptions::at_rate(rate), &path);
            // Behind the last sample there is nothing to mix: only velocities get there.
            let asked = [(10.0, 10.0), (10.25, 10.0), (10.75, 10.0), (11.5, 11.0), (14.0, 11.0), (9.5, 10.0)];
            let pairs = asked.map(|(time, base)| format!("{time}:{base}"));
            let script = workspace().join("tests/validators/usd_motion.py");
            let run = Command::new(&python).arg(script).arg(&path).args(pairs).output().unwrap();
            assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
            let found: Vec<Vec<f32>> = serde_json::from_slice(&run.stdout).unwrap();
            for ((time, base), found) in asked.iter().zip(&found) {
                let seconds = time / rate;
                let by = SPEED * seconds + 0.5 * gain * seconds * seconds;
                for (found, still) in found.chunks(3).zip(groom.positions()) {
                    let expected = still.as_dvec3() + DVec3::X * by;
                    let found = Vec3::from_slice(found).as_dvec3();
                    let told =
                        format!("{rate} a second, from {base} to {time}: {found}, expected {expected}");
                    assert!(found.distance(expected) < 1e-5, "{told}");
                }
            }
        }
    }
}

/// Joints that turn, move and grow; the third is mirrored.
fn world(place: usize, time: f64) -> DMat4 {
    let local = |place: usize| {
        let k = place as f64 + 1.0;
        let turn = DQuat::from_euler(EulerRot::XYZ, 0.4 * time * k, 0.2 * k, -0.9 * time);
        // Halves hold these to the bit.
        let scale = if place == 2 { DVec3::new(-1.0, 1.5, 2.0) } else { DVec3::splat(1.0 + 0.25 * time) };
        DMat4::from_scale_rotation_translation(scale, turn, DVec3::new(k, time, -0.5))
    };
    if place == 1 { local(0) * local(1) } else { local(place) }
}

fn rig(origin: DVec3) -> Rig {
    let joint = |place: usize| RigJoint {
        name: ["hip", "a neck", "7"][place].to_owned(),
        parent: (place == 1).then_some(0),
        inverse_bind: (DMat4::from_translation(origin) * world(place, 0.0)).inverse(),
    };
    let influences = [vec![(0, 1.0)], vec![(0, 0.25), (1, 0.5), (2, 0.25)], vec![(2, 0.125), (1, 0.875)]];
    Rig {
        joints: (0..3).map(joint).collect(),
        influences: influences.iter().map(|all| Influences::strongest(all).unwrap()).collect(),
    }
}

fn rig_frames(times: &[f64], origin: DVec3) -> Vec<RigFrame> {
    let placed = |place, time| DMat4::from_translation(origin) * world(place, time);
    let frame = |&time: &f64| RigFrame { time, joints: (0..3).map(|place| placed(place, time)).collect() };
    times.iter().map(frame).collect()
}

/// The same motion as positions, measured from `origin`.
fn skinned(groom: &Groom, rig: &Rig, frames: &[RigFrame], origin: DVec3) -> Vec<Frame> {
    let frame = |frame: &RigFrame| {
        let strands = groom.strands().zip(&rig.influences);
        let positions = strands.flat_map(|(points, influences)| {
            points.iter().map(move |point| {
                let each = influences.iter().map(|(joint, weight)| {
                    let matrix = frame.joints[joint] * rig.joints[joint].inverse_bind;
                    matrix.transform_point3(point.as_dvec3() + origin) * f64::from(weight)
                });
                (each.sum::<DVec3>() - origin).as_vec3()
            })
        });
        Frame { time: frame.time, positions: positions.collect(), ..Frame::default() }
    };
    frames.iter().map(frame).collect()
}

fn write_rig(
    groom: &Groom,
    rig: &Rig,
    frames: &[RigFrame],
    motion: &MotionOptions,
    path: &Path,
    options: &WriteOptions,
) -> Vec<Warning> {
    let mut given = frames.iter().cloned().map(Ok::<_, FormatError>);
    write_rigged(groom, rig, &mut given, motion, path, options).unwrap()
}

#[test]
fn usd_core_skins_strands_to_where_their_animation_is() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let usd = UsdCore::find().unwrap();
    let (times, rate) = ([0.0, 1.0, 2.0, 3.0], 30.0);
    let mut written: Vec<PathBuf> = Vec::new();
    for (number, origin) in [DVec3::ZERO, DVec3::new(1e6, -2.5, 3e5)].into_iter().enumerate() {
        for up_axis in [UpAxis::Y, UpAxis::Z] {
            let groom = groom(up_axis);
            let (rig, frames) = (rig(origin), rig_frames(&times, origin));
            let motion = MotionOptions { origin, ..MotionOptions::at_rate(rate) };
            let expected = skinned(&groom, &rig, &frames, origin);
            let size = expected.iter().flat_map(|f| &f.positions).fold(0.0_f32, |a, p| a.max(p.length()));
            let name =
                |kind: &str, ending: &str| folder.path().join(format!("{kind}{number}{up_axis:?}.{ending}"));
            let moving = name("moving", "usdc");
            animate(&groom, &expected, &motion, &moving);
            for ending in USD {
                let path = name("rigged", ending);
                let warnings = write_rig(&groom, &rig, &frames, &motion, &path, &WriteOptions::default());
                assert_eq!(warnings, []);
                let baked = name("baked", "usdc");
                usd.bake(
                    &path,
                    &baked,
                    BakeOptions { frames: Some((0.0, 3.0)), step: Some(0.5), ..BakeOptions::default() },
                )
                .unwrap();
                let (baked, moving) =
                    [&baked, &moving].map(|path| read_moving(path, &ReadOptions::default()).unwrap()).into();
                for frame in &expected {
                    let (a, b) = (baked.at(frame.time).unwrap(), moving.at(frame.time).unwrap());
                    assert_eq!(a.positions.len(), groom.point_count());
                    // Far away, both are rounded to the floats there are.
                    let tolerance = 1e-6 * size + 1.2e-7 * origin.length() as f32;
                    for (a, b) in a.positions.iter().zip(&b.positions) {
                        assert!(a.distance(*b) <= tolerance, "{ending}, {}: {a}, expected {b}", frame.time);
                    }
                }
                written.push(path);
            }
            written.push(moving);
        }
    }
    let check = workspace().join("tools/usd/check.py");
    let run = Command::new(&python).arg(check).args(&written).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stdout));
}

/// Skins and morph targets, every way to write them.
fn gltf_files(folder: &Path) -> Vec<PathBuf> {
    let groom = groom(UpAxis::Z);
    let plain = WriteOptions::default;
    let times = [0.0, 1.0, 2.5];
    let mut written = Vec::new();
    for (number, origin) in [DVec3::ZERO, DVec3::new(1e6, -2.5, 3e5)].into_iter().enumerate() {
        let motion = MotionOptions { origin, ..MotionOptions::at_rate(24.0) };
        let frames = rig_frames(&times, origin);
        for (way, options) in [
            ("lines", plain()),
            ("all", WriteOptions { all_attributes: true, ..plain() }),
            ("12 bits", WriteOptions { quantize: Some(12), ..plain() }),
            ("tubes", WriteOptions { mesh: Some(Mesh::Tubes { sides: 3 }), ..plain() }),
            ("ribbons, 16 bits", WriteOptions { mesh: Some(Mesh::Ribbons), quantize: Some(16), ..plain() }),
        ] {
            let path =
                folder.join(format!("skin{number} {way}.{}", if number == 0 { "glb" } else { "gltf" }));
            write_rig(&groom, &rig(origin), &frames, &motion, &path, &options);
            written.push(path);
        }
        for count in [1, 2, 7] {
            let times: Vec<f64> = (0..count).map(f64::from).collect();
            let path =
                folder.join(format!("morph{number} {count}.{}", if count == 2 { "gltf" } else { "glb" }));
            animate(&groom, &along_x(&groom, &times, 24.0, 0.0), &motion, &path);
            written.push(path);
        }
    }
    // More joints than a byte counts.
    let mut many = rig(DVec3::ZERO);
    let more =
        (3..300).map(|i| RigJoint { name: format!("j{i}"), parent: Some(i - 1), ..many.joints[0].clone() });
    many.joints.extend(more.collect::<Vec<_>>());
    many.influences[0] = Influences::strongest(&[(299, 0.5), (0, 0.5)]).unwrap();
    let mut frames = rig_frames(&times, DVec3::ZERO);
    for frame in &mut frames {
        frame.joints.resize(300, frame.joints[0]);
    }
    let path = folder.join("many.glb");
    write_rig(&groom, &many, &frames, &MotionOptions::at_rate(24.0), &path, &plain());
    written.push(path);
    written
}

#[test]
fn skins_and_morph_targets_pass_the_khronos_validator() {
    let (Some(modules), Some(node)) = (validators::gltf(), validators::node()) else { return };
    let folder = tempfile::tempdir().unwrap();
    let written = gltf_files(folder.path());
    let script = workspace().join("tests/validators/check_gltf.mjs");
    let run = Command::new(node).arg(script).arg("--modules").arg(modules).args(&written).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(0), "{said}");
    // Hints are told too, and there should be none.
    // Tubes and ribbons have coordinates for textures of others.
    let told = said.lines().filter(|line| line.starts_with("  ") && !line.contains("TEXCOORD_0"));
    let told: Vec<&str> = told.collect();
    assert!(told.iter().all(|line| !line.contains(" hint ") && !line.contains(" info ")), "{told:#?}");
}

/// Metres, z up, as Blender has it.
fn in_blender(groom: &Groom, positions: &[Vec3]) -> Vec<f32> {
    positions.iter().flat_map(|p| groom.up_axis.rotate(*p, UpAxis::Z).to_array()).collect()
}

fn question(path: &Path, fps: u32, groom: &Groom, frames: &[Frame], tolerance: f64) -> Value {
    let frames: serde_json::Map<String, Value> = frames
        .iter()
        .map(|frame| (frame.time.to_string(), json!(in_blender(groom, &frame.positions))))
        .collect();
    json!({ "path": path, "fps": fps, "frames": frames, "velocity": null, "tolerance": tolerance, "blur": null })
}

/// What Blender 5.0 does, as the tests hold it: of USD curves, `velocities` become the attribute `velocity` as they are
/// (per second, in the axes of the prim), and Cycles blurs by them over a frame of the scene's rate. A time code is a
/// frame, whatever its rate. Of Alembic curves velocities are not read, and seconds become frames of the scene's rate.
#[test]
fn blender_moves_strands_as_they_should_and_blurs_them_by_their_velocities() {
    let Some(python) = std::env::var_os("GROOMKIT_BLENDER_PYTHON").map(PathBuf::from) else {
        say_skipped("Blender does not judge motion; set GROOMKIT_BLENDER_PYTHON to a Python that has bpy");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let mut questions = Vec::new();
    for rate in [24_u32, 30, 60] {
        for up_axis in [UpAxis::Y, UpAxis::Z] {
            let groom = groom(up_axis);
            let frames = along_x(&groom, &[0.0, 1.0, 2.0, 3.0], rate.into(), 0.0);
            let path = folder.path().join(format!("{rate}{up_axis:?}.usdc"));
            animate(&groom, &frames, &MotionOptions::at_rate(rate.into()), &path);
            let mut usd = question(&path, rate, &groom, &frames, 1e-6);
            usd["velocity"] = json!([SPEED, 0.0, 0.0]);
            questions.push(usd);
        }
        // Alembic says no axis; Blender takes y up.
        let groom = groom(UpAxis::Y);
        let frames = along_x(&groom, &[0.0, 1.0, 2.0, 3.0], rate.into(), 0.0);
        let path = folder.path().join(format!("{rate}.abc"));
        let motion =
            MotionOptions { origin: DVec3::new(2.0, 3.0, 5.0), ..MotionOptions::at_rate(rate.into()) };
        animate(&groom, &frames, &motion, &path);
        let mut placed = frames.clone();
        placed.iter_mut().flat_map(|f| &mut f.positions).for_each(|p| *p += Vec3::new(2.0, 3.0, 5.0));
        questions.push(question(&path, rate, &groom, &placed, 1e-5));
        // Frame 1 of glTF is 1 / fps seconds in.
        let path = folder.path().join(format!("morph{rate}.glb"));
        animate(&groom, &frames, &MotionOptions::at_rate(rate.into()), &path);
        questions.push(question(&path, rate, &groom, &frames, 1e-5));
        let times = [0.0, 1.0, 2.0];
        let (mut rig, joints) = (rig(DVec3::ZERO), rig_frames(&times, DVec3::ZERO));
        // Blender's bones hold no scale and no mirror where they are at rest: what follows the third is wrong there.
        for (influences, all) in
            rig.influences[1..].iter_mut().zip([[(0, 0.25), (1, 0.75)], [(0, 0.5), (1, 0.5)]])
        {
            *influences = Influences::strongest(&all).unwrap();
        }
        let path = folder.path().join(format!("skin{rate}.glb"));
        write_rig(
            &groom,
            &rig,
            &joints,
            &MotionOptions::at_rate(rate.into()),
            &path,
            &WriteOptions::default(),
        );
        let expected = skinned(&groom, &rig, &joints, DVec3::ZERO);
        questions.push(question(&path, rate, &groom, &expected, 1e-4));
    }
    // 72 units a second are 3 a frame of 24, whichever way the shutter is centred.
    let mut groom = groom(UpAxis::Z);
    groom.positions_mut().iter_mut().for_each(|p| p.x = 0.0);
    let path = folder.path().join("blur.usdc");
    let frame = |time: f64| Frame {
        time,
        positions: groom.positions().to_vec(),
        velocities: Some(vec![Vec3::X * 72.0; 9]),
        accelerations: None,
    };
    animate(&groom, &[frame(0.0), frame(1.0)], &MotionOptions::at_rate(24.0), &path);
    let mut blur = question(&path, 24, &groom, &[], 0.0);
    blur["blur"] = json!([1, 3.04]);
    questions.push(blur);
    let asked = folder.path().join("questions.json");
    std::fs::write(&asked, json!(questions).to_string()).unwrap();
    let script = workspace().join("tests/blender/motion.py");
    let run = Command::new(python).arg(script).arg(asked).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(0), "{said}");
}
