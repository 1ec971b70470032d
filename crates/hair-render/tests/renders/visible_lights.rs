//! Area lights before the camera.

use crate::common::*;
use glam::{DVec3, Vec3};
use hair_render::*;
use moving_mesh::TriangleMesh;

const RADIANCE: Vec3 = Vec3::new(17.0, 12.0, 4.0);

/// A lamp at the origin that shines along +z, 1 m wide and half as high.
fn lamp(two_sided: bool) -> AreaLight {
    let lamp = AreaLight::facing(DVec3::ZERO, DVec3::Z, 1.0, 0.5, RADIANCE).unwrap();
    AreaLight { two_sided, visible_camera: true, ..lamp }
}

/// What a camera sees that looks at the origin from `from`, 2 m high there and wide.
fn seen(lights: Vec<AreaLight>, meshes: Vec<MeshObject>, from: DVec3) -> Frame {
    let scene = Scene::build(SceneDescription { lights, meshes, ..Default::default() }).unwrap();
    let camera = Camera::look_at(from, DVec3::ZERO, DVec3::Y, 2.0 * (1.0 / from.length()).atan()).unwrap();
    shoot(&scene, &camera, &RenderSettings { aovs: AovSet::all(), ..settings(40, 64) })
}

/// A square of 2 m about the z axis at `z`.
fn wall(z: f32) -> MeshObject {
    let positions = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Vec3::new(x, y, z));
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    MeshObject::still(
        TriangleMesh { positions: positions.to_vec(), triangles, normals: None },
        Vec3::splat(0.5),
    )
}

/// It is as large as it is, as bright as it shines, and covers what is behind it; nothing noisy about it.
#[test]
fn a_lamp_is_seen_as_it_shines() {
    let alone = seen(vec![lamp(false)], vec![], DVec3::Z * 4.0);
    for (beauty, &alpha) in alone.beauty.iter().zip(&alone.alpha) {
        assert!((*beauty - RADIANCE * alpha).abs().max_element() <= 1e-5, "{beauty} at alpha {alpha}");
    }
    assert_eq!(alone.pass(Aov::Background).unwrap(), alone.beauty);
    // A pixel is 5 cm wide: 1 x 0.5 m are 200 of them.
    let covered: f32 = alone.alpha.iter().sum();
    assert!((covered - 200.0).abs() < 1.0, "{covered}");
    assert_eq!(alone.alpha[20 * 40 + 20], 1.0);
    // Seen from the side it is narrower, by its cosine and a little for being nearer and farther.
    let side = seen(vec![lamp(false)], vec![], DVec3::new(60f64.to_radians().sin(), 0.0, 0.5) * 400.0);
    let covered: f32 = side.alpha.iter().sum();
    assert!((covered - 100.0).abs() < 1.0, "{covered}");
}

#[test]
fn only_sides_that_shine_are_seen_and_nothing_in_front_is_hidden() {
    let lit = |frame: &Frame| frame.pass(Aov::Background).unwrap().iter().any(|light| *light != Vec3::ZERO);
    assert!(!lit(&seen(vec![lamp(false)], vec![], DVec3::NEG_Z * 4.0)), "its back");
    assert!(lit(&seen(vec![lamp(true)], vec![], DVec3::NEG_Z * 4.0)));
    assert!(!lit(&seen(vec![AreaLight { visible_camera: false, ..lamp(false) }], vec![], DVec3::Z * 4.0)));
    assert!(!lit(&seen(vec![lamp(false)], vec![wall(1.0)], DVec3::Z * 4.0)), "a wall before it");
    assert!(lit(&seen(vec![lamp(false)], vec![wall(-1.0)], DVec3::Z * 4.0)));
    // Of two, the nearer one.
    let near = AreaLight { center: DVec3::Z, radiance: Vec3::X, ..lamp(false) };
    let both = seen(vec![lamp(false), near], vec![], DVec3::Z * 4.0);
    assert_eq!(both.beauty[20 * 40 + 20], Vec3::X);
}

/// What a lamp lights is the same whether the camera sees it or not, to the bit: no light is counted twice.
#[test]
fn a_lamp_that_is_seen_lights_nothing_more() {
    let place = DVec3::new(0.3, 1.9, 0.4);
    let light = AreaLight::facing(place, DVec3::Y * 0.5, 0.6, 0.4, Vec3::splat(9.0)).unwrap();
    let picture = |visible_camera, background| {
        let scene = Scene::build(SceneDescription {
            hair: vec![hair(tuft(60, 0.03), blond())],
            meshes: vec![wall(-1.0)],
            environment: Some(white()),
            lights: vec![AreaLight { visible_camera, ..light }],
            ..Default::default()
        })
        .unwrap();
        let camera = Camera::look_at(DVec3::new(0.4, -0.6, 4.0), DVec3::Y * 0.7, DVec3::Y, 0.9).unwrap();
        shoot(&scene, &camera, &RenderSettings { background, aovs: AovSet::all(), ..settings(32, 8) })
    };
    for background in [Background::Transparent, Background::Visible] {
        let (unseen, seen) = (picture(false, background), picture(true, background));
        let lamp =
            |i: usize| seen.pass(Aov::Background).unwrap()[i] != unseen.pass(Aov::Background).unwrap()[i];
        let count = (0..unseen.beauty.len()).filter(|&i| lamp(i)).count();
        assert!((5..200).contains(&count), "{count} pixels of the lamp");
        for i in (0..unseen.beauty.len()).filter(|&i| !lamp(i)) {
            assert_eq!((seen.beauty[i], seen.alpha[i]), (unseen.beauty[i], unseen.alpha[i]));
        }
    }
}
