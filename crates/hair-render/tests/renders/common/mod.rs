//! Small scenes and comparisons the tests share.
#![allow(missing_docs)]

use glam::{DMat3, DVec3, Vec3};
use groom::{Attribute, Groom, names};
use hair_render::*;

/// A tuft: `count` strands of 9 points from a disc of radius 0.5, bending outwards, 1.5 high.
pub fn tuft(count: u32, radius: f32) -> Groom {
    let mut offsets = vec![0];
    let mut positions = Vec::new();
    for strand in 0..count {
        let angle = strand as f32 * 2.399_963;
        let distance = 0.5 * ((strand as f32 + 0.5) / count as f32).sqrt();
        let out = Vec3::new(angle.cos(), 0.0, angle.sin());
        for point in 0..9 {
            let t = point as f32 / 8.0;
            positions.push(
                out * distance * (1.0 + 1.2 * t * t) + Vec3::Y * (1.5 * t * (1.0 - 0.3 * t * distance)),
            );
        }
        offsets.push(positions.len() as u32);
    }
    let mut groom = Groom::new(offsets, positions).unwrap();
    groom.set_attribute(names::RADIUS, Attribute::constant_float(radius)).unwrap();
    groom
}

pub fn hair(groom: Groom, color: HairColor) -> HairObject {
    let fibre = Material { color, ..Default::default() };
    HairObject::still(groom, HairMaterial { fibre, ..Default::default() })
}

pub fn blond() -> HairColor {
    HairColor::Absorption(Vec3::new(0.06, 0.10, 0.20))
}

pub fn white() -> Environment {
    Environment::constant(Vec3::ONE).unwrap()
}

pub fn scene(hair: Vec<HairObject>, environment: Option<Environment>, lights: Vec<AreaLight>) -> Scene {
    Scene::build(SceneDescription { hair, environment, lights, ..Default::default() }).unwrap()
}

pub fn front(scene: &Scene) -> Camera {
    Camera::fit(scene.bounds(), 0.3, 0.2, 0.5, 1.0).unwrap()
}

pub fn settings(size: u32, spp: u32) -> RenderSettings {
    RenderSettings { width: size, height: size, spp, ..Default::default() }
}

pub fn shoot(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Frame {
    let frame = render(scene, camera, settings, &Silent).unwrap();
    assert_eq!(frame.report.rejected_samples, 0);
    frame
}

/// Sum of the beauty over the sum of alpha: mean radiance of what is covered.
pub fn mean(frame: &Frame) -> DVec3 {
    let alpha: f64 = frame.alpha.iter().map(|&a| f64::from(a)).sum();
    frame.beauty.iter().map(|b| b.as_dvec3()).sum::<DVec3>() / alpha
}

pub fn rel_mse(frame: &Frame, reference: &Frame) -> f64 {
    let covered: Vec<usize> = (0..frame.alpha.len()).filter(|&i| frame.alpha[i] > 0.0).collect();
    let error = |&i: &usize| {
        let (x, r) = (frame.beauty[i].as_dvec3(), reference.beauty[i].as_dvec3());
        let d = x - r;
        (d * d / (r * r + 0.01)).element_sum() / 3.0
    };
    covered.iter().map(error).sum::<f64>() / covered.len() as f64
}

/// Mean radiance over eight seeds, and the standard error of that mean.
pub fn spread(scene: &Scene, settings: &RenderSettings) -> (f64, f64) {
    let means =
        (0..8).map(|seed| mean(&shoot(scene, &front(scene), &RenderSettings { seed, ..settings.clone() })).x);
    let means: Vec<f64> = means.collect();
    let mean = means.iter().sum::<f64>() / 8.0;
    let variance = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / 7.0;
    (mean, (variance / 8.0).sqrt())
}

/// Positions turned by `turn` radians about the up axis.
pub fn turned(positions: &[Vec3], turn: f64) -> Vec<Vec3> {
    let turn = DMat3::from_rotation_y(turn);
    positions.iter().map(|p| (turn * p.as_dvec3()).as_vec3()).collect()
}

/// The motion of points that turn from `-0.5 turn` to `0.5 turn` radians about the up axis.
pub fn spin(positions: &[Vec3], turn: f64, keys: usize) -> Motion {
    let share = |key: usize| key as f64 / (keys - 1) as f64 - 0.5;
    Motion::keys((0..keys).map(|key| turned(positions, turn * share(key))).collect()).unwrap()
}

/// Hair that turns by `turn` radians about the up axis while the shutter is open.
pub fn spinning(groom: Groom, color: HairColor, turn: f64, keys: usize) -> HairObject {
    let motion = spin(groom.positions(), turn, keys);
    HairObject { motion, ..hair(groom, color) }
}
