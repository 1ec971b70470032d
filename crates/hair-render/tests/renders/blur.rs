//! Motion blur: what is where, for how long.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use groom::{Attribute, Groom, UpAxis, names};
use hair_render::*;
use moving_mesh::TriangleMesh;

use crate::common::*;

/// One straight strand of radius 0.5 along `along` through `at`.
fn rod(at: Vec3, along: Vec3, radius: f32) -> Groom {
    let mut groom = Groom::new(vec![0, 2], vec![at - along * 50.0, at + along * 50.0]).unwrap();
    groom.set_attribute(names::RADIUS, Attribute::constant_float(radius)).unwrap();
    groom
}

fn through(shape: ShutterShape) -> Shutter {
    Shutter::new(-0.25, 0.25, shape).unwrap()
}

fn build(hair: Vec<HairObject>, shutter: Shutter) -> Scene {
    Scene::build(SceneDescription { hair, environment: Some(white()), shutter, ..Default::default() })
        .unwrap()
}

/// The light let in until `t`, 0..1, of a shape.
fn let_in(shape: &ShutterShape, t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    match shape {
        ShutterShape::Triangle if t < 0.5 => 2.0 * t * t,
        ShutterShape::Triangle => 1.0 - 2.0 * (1.0 - t) * (1.0 - t),
        ShutterShape::Cosine => t - (2.0 * PI * t).sin() / (2.0 * PI),
        _ => t,
    }
}

/// A pixel is covered for as long as the strand that sweeps over it takes to pass.
#[test]
fn a_sweeping_strand_covers_each_pixel_for_its_time() {
    const WIDTH: u32 = 40;
    // From far away, a pixel is one unit wide.
    let camera = Camera::look_at(DVec3::Z * 4000.0, DVec3::ZERO, DVec3::Y, 1.0 / 4000.0).unwrap();
    let radius = 2.5;
    let (from, to) = (-12.0, 10.0);
    for shape in [ShutterShape::Box, ShutterShape::Triangle, ShutterShape::Cosine] {
        let groom = rod(Vec3::ZERO, Vec3::Y, radius);
        let at = |x: f32| groom.positions().iter().map(|&p| p + Vec3::X * x).collect();
        let motion = Motion::keys(vec![at(from), at(to)]).unwrap();
        let scene =
            build(vec![HairObject { motion, ..hair(groom.clone(), blond()) }], through(shape.clone()));
        // The scene is centred on the sweep; so is nothing else here.
        assert!((scene.center().x + 1.0).abs() < 1e-5);
        let settings = RenderSettings {
            width: WIDTH,
            height: 1,
            spp: 1024,
            filter_radius: 1e-3,
            max_bounces: 0,
            ..Default::default()
        };
        let frame = shoot(&scene, &camera, &settings);
        let passes = |x: f64, edge: f64| (x + edge - f64::from(from)) / f64::from(to - from);
        for (x, alpha) in (0..WIDTH).map(|i| f64::from(i) + 0.5 - 0.5 * f64::from(WIDTH)).zip(&frame.alpha) {
            let r = f64::from(radius);
            let expected = let_in(&shape, passes(x, r)) - let_in(&shape, passes(x, -r));
            assert!((f64::from(*alpha) - expected).abs() < 3e-3, "{shape} at {x}: {alpha}, not {expected}");
        }
        assert!(frame.alpha.iter().any(|&a| a > 0.2) && frame.alpha.iter().all(|&a| a < 0.8));
    }
}

/// A still scene has no moments: whatever the shutter, and however many keys say so.
#[test]
fn a_still_scene_is_the_same_whatever_the_shutter() {
    let floor = TriangleMesh {
        positions: vec![Vec3::new(-3.0, 0.0, -3.0), Vec3::new(0.0, 0.0, 4.0), Vec3::new(3.0, 0.0, -3.0)],
        triangles: vec![[0, 1, 2]],
        normals: Some(vec![Vec3::Y; 3]),
    };
    let tuft = tuft(60, 0.02);
    let picture = |shutter, keys: usize| {
        let same = |key: &[Vec3]| Motion::keys(vec![key.to_vec(); keys]).unwrap();
        let motion = if keys > 0 { same(tuft.positions()) } else { Motion::STILL };
        let hair = HairObject { motion, ..hair(tuft.clone(), blond()) };
        let (motion, turning) =
            if keys > 0 { (same(&floor.positions), same(&[Vec3::Y; 3])) } else { Default::default() };
        let mesh = MeshObject { motion, turning, ..MeshObject::still(floor.clone(), Vec3::splat(0.5)) };
        let description = SceneDescription {
            hair: vec![hair],
            meshes: vec![mesh],
            environment: Some(Environment::studio(32).unwrap()),
            shutter,
            ..Default::default()
        };
        let scene = Scene::build(description).unwrap();
        let camera = MovingCamera::new(vec![front(&scene); keys.max(1)]).unwrap();
        let frame = render_moving(&scene, &camera, &settings(20, 4), &Silent).unwrap();
        assert_eq!((frame.report.motion.clone(), scene.motion_keys()), (None, None));
        (frame.beauty, frame.alpha, scene.tracing_statistics().bytes)
    };
    let plain = picture(Shutter::default(), 0);
    for (shutter, keys) in [
        (through(ShutterShape::Triangle), 0),
        (Shutter::new(-3.0, 5.0, ShutterShape::Cosine).unwrap(), 1),
        (through(ShutterShape::Box), 3),
    ] {
        assert!(picture(shutter.clone(), keys) == plain, "{shutter}, {keys} keys");
    }
}

/// Straight lines between keys cut the corner of an arc; by a quarter as much for twice the keys.
#[test]
fn more_keys_follow_the_arc() {
    let mut groom = Groom::new(vec![0, 2], vec![Vec3::new(0.7, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)]).unwrap();
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.05)).unwrap();
    let camera = Camera::orbit(DVec3::ZERO, 60.0, 0.0, PI / 2.0, 0.04).unwrap();
    let picture = |keys| {
        let scene = build(vec![spinning(groom.clone(), blond(), 1.2, keys)], Shutter::default());
        let report = shoot(&scene, &camera, &RenderSettings { max_bounces: 0, ..settings(48, 512) });
        assert_eq!(report.report.motion.as_ref().unwrap().keys, Some(keys));
        report.alpha
    };
    let arc = picture(129);
    let off = |keys| -> f64 {
        picture(keys).iter().zip(&arc).map(|(a, b)| f64::from(a - b).abs()).sum::<f64>()
            / arc.iter().map(|&a| f64::from(a)).sum::<f64>()
    };
    let errors = [2, 3, 5, 9].map(off);
    println!("relative to the arc: {errors:?}");
    assert!(errors[0] > 0.2, "{errors:?}");
    for pair in errors[1..].windows(2) {
        assert!((3.0..5.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// A ball that spins about its own axis shows the same face all the time, if its normals turn with it.
#[test]
fn normals_turn_with_their_mesh() {
    let ball = crate::surfaces::ball(12, true);
    let light =
        AreaLight::facing(DVec3::new(30.0, 0.0, 30.0), DVec3::ZERO, 5.0, 5.0, Vec3::splat(60.0)).unwrap();
    let picture = |turn: f64, with_normals: bool| {
        let mut object = MeshObject::still(ball.clone(), Vec3::ONE);
        if turn != 0.0 {
            object.motion = spin(&ball.positions, turn, 33);
        }
        if with_normals {
            object.turning = spin(ball.normals.as_ref().unwrap(), turn, 33);
        }
        let scene = Scene::build(SceneDescription {
            meshes: vec![object],
            lights: vec![light],
            ..Default::default()
        });
        let camera = Camera::orbit(DVec3::ZERO, 100.0, 0.0, 0.0, 0.012).unwrap();
        shoot(&scene.unwrap(), &camera, &settings(24, 64))
    };
    let still = picture(0.0, false);
    let error = |frame: &Frame| {
        let off: f64 =
            frame.beauty.iter().zip(&still.beauty).map(|(a, b)| f64::from((*a - *b).x).abs()).sum();
        off / still.beauty.iter().map(|b| f64::from(b.x)).sum::<f64>()
    };
    let (with, without) = (error(&picture(1.5, true)), error(&picture(1.5, false)));
    println!("with normals {with}, without {without}");
    assert!(with < 0.02 && without > 3.0 * with);
}

/// A camera that goes round a groom sees what a camera that stands sees of a groom that turns.
#[test]
fn a_turning_camera_is_a_turning_groom() {
    let tuft = tuft(80, 0.03);
    let orbit = |azimuth| Camera::orbit(DVec3::Y * 0.7, 5.0, azimuth, 0.2, 0.5).unwrap();
    let turn = 0.4;
    let still = build(vec![hair(tuft.clone(), blond())], through(ShutterShape::Triangle));
    let camera = MovingCamera::new(vec![orbit(-0.5 * turn), orbit(0.5 * turn)]).unwrap();
    let around = render_moving(&still, &camera, &settings(32, 256), &Silent).unwrap();
    let report = around.report.motion.as_ref().unwrap();
    assert_eq!((report.keys, report.camera_keys, report.shutter_shape.as_str()), (None, Some(2), "triangle"));
    let turning = build(vec![spinning(tuft, blond(), -turn, 17)], through(ShutterShape::Triangle));
    let standing = shoot(&turning, &orbit(0.0), &settings(32, 256));
    let worst = around.alpha.iter().zip(&standing.alpha).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst < 0.02, "coverage differs by {worst}");
    let off = rel_mse(&around, &standing);
    assert!(off < 3.0 * around.report.rel_mse.unwrap(), "{off} {:?}", around.report.rel_mse);
}

/// A million metres away the blur is what it is here.
#[test]
fn far_away_motion_is_like_here() {
    let picture = |origin: DVec3| {
        let mut groom = tuft(60, 0.02);
        groom.up_axis = UpAxis::Z;
        groom.meters_per_unit = 0.5;
        let object = HairObject { origin, ..spinning(groom, blond(), 0.5, 5) };
        let scene = build(vec![object], Shutter::default());
        (shoot(&scene, &front(&scene), &settings(24, 16)), scene.bounds().unwrap())
    };
    let (here, near) = picture(DVec3::ZERO);
    let offset = DVec3::new(1e6, -3e6, 2e6);
    let (there, far) = picture(offset);
    let moved = far.center() - near.center();
    assert!((moved - DVec3::new(5e5, 1e6, 1.5e6)).length() < 1e-6, "{moved}");
    let covers: f32 = here.alpha.iter().zip(&there.alpha).map(|(a, b)| (a - b).abs()).sum();
    assert!(covers < 1e-3 * here.alpha.iter().sum::<f32>(), "{covers}");
}

#[test]
fn bounds_hold_the_whole_way() {
    let groom = rod(Vec3::ZERO, Vec3::Y, 0.1);
    let motion = Motion::velocities(groom.positions(), &[Vec3::X * 20.0; 2], [-0.25, 0.5]).unwrap();
    let scene = build(vec![HairObject { motion, ..hair(groom, blond()) }], Shutter::default());
    let bounds = scene.bounds().unwrap();
    assert_eq!((bounds.min.x, bounds.max.x), (-5.0, 10.0));
}

/// In an instant nothing moves: what says it does is a mistake, not a blur without length.
#[test]
fn an_instant_leaves_no_time_to_move() {
    let instant = || Shutter::new(0.1, 0.1, ShutterShape::Box).unwrap();
    let groom = rod(Vec3::ZERO, Vec3::Y, 0.1);
    let motion = Motion::velocities(groom.positions(), &[Vec3::X; 2], [-0.25, 0.5]).unwrap();
    let moving = vec![HairObject { motion, ..hair(groom.clone(), blond()) }];
    let built = Scene::build(SceneDescription { hair: moving, shutter: instant(), ..Default::default() });
    let refused = "shutter is 0.1:0.1, expected a closing after the opening, for what moves";
    assert_eq!(built.unwrap_err().to_string(), refused);
    let still = build(vec![hair(groom, blond())], instant());
    let orbit = |azimuth| Camera::orbit(DVec3::ZERO, 5.0, azimuth, 0.0, 0.5).unwrap();
    let shot = |to| {
        let camera = MovingCamera::new(vec![orbit(0.0), orbit(to)]).unwrap();
        render_moving(&still, &camera, &settings(4, 1), &Silent)
    };
    assert_eq!(shot(0.1).unwrap_err().to_string(), refused);
    assert!(shot(0.0).is_ok());
}

#[test]
fn motion_of_something_else_is_refused() {
    let wrong = Motion::keys(vec![vec![Vec3::ZERO; 3]; 2]).unwrap();
    let object = HairObject { motion: wrong.clone(), ..hair(rod(Vec3::ZERO, Vec3::Y, 0.1), blond()) };
    let built = Scene::build(SceneDescription { hair: vec![object], ..Default::default() });
    let told = built.unwrap_err().to_string();
    assert_eq!(told, "motion of hair is of 3 points, expected as many as there are to move");
    let mesh = crate::surfaces::ball(3, true);
    for object in [
        MeshObject { motion: wrong.clone(), ..MeshObject::still(mesh.clone(), Vec3::ONE) },
        MeshObject { turning: wrong, ..MeshObject::still(mesh.clone(), Vec3::ONE) },
        MeshObject { origin: DVec3::NAN, ..MeshObject::still(mesh, Vec3::ONE) },
    ] {
        assert!(Scene::build(SceneDescription { meshes: vec![object], ..Default::default() }).is_err());
    }
}
