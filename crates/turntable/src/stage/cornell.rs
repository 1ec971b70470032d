//! A Cornell box about what stands in it.
//!
//! Proportions after the measured box (Cornell University Program of Computer Graphics, "The Cornell Box: Data",
//! 1998: a room of 556 x 549 x 559 mm, a light of 130 x 105 mm in its ceiling), here a cube; colours are those of that
//! box in linear Rec. 709 as the Computer Graphics Archive (M. McGuire, 2017, `CornellBox-Original`) has them.

use glam::{DMat3, DVec3, Vec3};
use hair_render::{AreaLight, Bounds, MeshObject};
use moving_mesh::TriangleMesh;

use crate::schema::CornellBox;

const WHITE: Vec3 = Vec3::new(0.725, 0.71, 0.68);
const RED: Vec3 = Vec3::new(0.63, 0.065, 0.05);
const GREEN: Vec3 = Vec3::new(0.14, 0.45, 0.091);
/// What the light sends out.
const RADIANCE: Vec3 = Vec3::new(17.0, 12.0, 4.0);
/// Its size as parts of the room's.
const LIGHT: [f64; 2] = [130.0 / 556.0, 105.0 / 559.0];
/// How far it hangs below the ceiling, as a part of the room's size: light that starts in the ceiling itself would be
/// caught by it.
const BELOW: f64 = 1e-3;

/// A room: a cube whose open side looks along +z, before it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Room {
    /// Its middle, in world metres.
    pub center: DVec3,
    pub edge: f64,
}

impl Room {
    /// A room about what stands on its floor; a cube of a metre about nothing.
    pub fn about(subject: Option<Bounds>, settings: &CornellBox) -> Room {
        let Some(Bounds { min, max }) = subject else { return Room { center: DVec3::ZERO, edge: 1.0 } };
        let largest = (max - min).max_element();
        let edge = settings.room * if largest > 0.0 { largest } else { 1.0 };
        let middle = 0.5 * (min + max);
        Room { center: DVec3::new(middle.x, min.y + 0.5 * edge, middle.z), edge }
    }

    /// Its walls, turned about its upright axis by `azimuth` radians.
    pub fn walls(&self, azimuth: f64) -> Vec<MeshObject> {
        let (l, r) = (-1.0_f32, 1.0_f32);
        let corner = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        let white = [
            // Floor, ceiling, back; all look inwards.
            [corner(l, l, r), corner(r, l, r), corner(r, l, l), corner(l, l, l)],
            [corner(l, r, l), corner(r, r, l), corner(r, r, r), corner(l, r, r)],
            [corner(l, l, l), corner(r, l, l), corner(r, r, l), corner(l, r, l)],
        ];
        let left = [[corner(l, l, r), corner(l, l, l), corner(l, r, l), corner(l, r, r)]];
        let right = [[corner(r, l, l), corner(r, l, r), corner(r, r, r), corner(r, r, l)]];
        let turn = DMat3::from_rotation_y(azimuth).as_mat3() * (0.5 * self.edge) as f32;
        let wall = |quads: &[[Vec3; 4]], albedo| {
            let positions = quads.iter().flatten().map(|&corner| turn * corner).collect();
            let first = (0..quads.len() as u32).map(|quad| 4 * quad);
            let triangles = first.flat_map(|i| [[i, i + 1, i + 2], [i, i + 2, i + 3]]).collect();
            let mesh = TriangleMesh { positions, triangles, normals: None };
            MeshObject { origin: self.center, ..MeshObject::still(mesh, albedo) }
        };
        vec![wall(&white, WHITE), wall(&left, RED), wall(&right, GREEN)]
    }

    /// The light in its ceiling, turned with it.
    pub fn light(&self, settings: &CornellBox, azimuth: f64) -> AreaLight {
        let turn = DMat3::from_rotation_y(azimuth).as_mat3();
        let [width, depth] = LIGHT.map(|part| (part * self.edge) as f32);
        AreaLight {
            center: self.center + DVec3::Y * (self.edge * (0.5 - BELOW)),
            // Their cross product points down.
            edge_u: turn * (Vec3::X * width),
            edge_v: turn * (Vec3::Z * depth),
            radiance: RADIANCE * settings.intensity,
            two_sided: false,
            visible_camera: settings.visible_camera,
        }
    }

    /// How far from its middle a camera stands that sees its whole open side and nothing beside it; `aspect` is width
    /// over height.
    pub fn distance(&self, vertical_fov: f64, aspect: f64) -> f64 {
        let half = (0.5 * vertical_fov).tan() * aspect.min(1.0);
        0.5 * self.edge * (1.0 + 1.02 / half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: Bounds = Bounds { min: DVec3::new(1e6, 2.0, -0.5), max: DVec3::new(1e6 + 1.0, 4.0, 0.5) };

    #[test]
    fn the_subject_stands_on_the_floor_within_the_walls() {
        let room = Room::about(Some(HEAD), &CornellBox::default());
        assert_eq!(room, Room { center: DVec3::new(1e6 + 0.5, 3.8, 0.0), edge: 3.6 });
        assert_eq!(Room::about(None, &CornellBox::default()).edge, 1.0);
        let point = Bounds { min: DVec3::ONE, max: DVec3::ONE };
        assert_eq!(Room::about(Some(point), &CornellBox::default()).edge, 1.8);
    }

    #[test]
    fn walls_look_inwards_red_is_left_and_the_light_looks_down() {
        let room = Room { center: DVec3::ZERO, edge: 2.0 };
        let walls = room.walls(0.0);
        for MeshObject { mesh, .. } in &walls {
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
                assert!((b - a).cross(c - a).dot(a) < 0.0, "{a} {b} {c}");
            }
        }
        let middle = |wall: &MeshObject| wall.mesh.positions.iter().sum::<Vec3>() / 4.0;
        assert_eq!((walls[1].albedo, middle(&walls[1])), (RED, Vec3::NEG_X));
        assert_eq!((walls[2].albedo, middle(&walls[2])), (GREEN, Vec3::X));
        let light = room.light(&CornellBox::default(), 0.3);
        assert!(light.edge_u.cross(light.edge_v).normalize().y < -0.999_999 && light.center.y < 1.0);
        // A quarter turn brings the red wall to the back.
        assert!((middle(&room.walls(-std::f64::consts::FRAC_PI_2)[1]) - Vec3::NEG_Z).length() < 1e-6);
    }

    #[test]
    fn a_camera_sees_the_open_side_to_its_edges() {
        let room = Room { center: DVec3::ZERO, edge: 2.0 };
        for (fov, aspect) in [(0.6, 1.0), (0.6, 2.0), (1.0, 0.5)] {
            let half = (0.5_f64 * fov).tan() * (room.distance(fov, aspect) - 1.0);
            let fits = half.min(half * aspect);
            assert!((1.0..1.05).contains(&fits), "{fov} {aspect}: {fits}");
        }
    }
}
