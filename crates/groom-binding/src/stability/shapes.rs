//! Meshes and grooms to bind. The tests use them too.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3};
use groom::{Groom, GroomError, random};
use moving_mesh::Pose;

/// A mesh that comes from no file.
#[derive(Clone, Debug)]
pub struct Mesh {
    pub triangles: Vec<[u32; 3]>,
    pub rest: Pose,
    pub uvs: Vec<Vec2>,
}

impl Mesh {
    pub fn posed(&self, motion: impl Fn(DVec3) -> DVec3) -> Pose {
        Pose { positions: self.rest.positions.iter().map(|&p| motion(p)).collect(), normals: None }
    }
}

/// An egg round the origin, 2.6 high and 2 wide, in rings and columns. The seam's vertices are there twice, as in
/// files with texture coordinates, and a pole's once a column.
pub fn egg(rings: u32, columns: u32) -> Mesh {
    let (mut positions, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for ring in 0..=rings {
        for column in 0..=columns {
            let (u, v) = (f64::from(column) / f64::from(columns), f64::from(ring) / f64::from(rings));
            // The seam is closed to the bit.
            let around = TAU * f64::from(column % columns) / f64::from(columns);
            let polar = PI * (1.0 - v);
            let radius = if ring == 0 || ring == rings { 0.0 } else { polar.sin() };
            positions.push(DVec3::new(radius * around.cos(), 1.3 * polar.cos(), -radius * around.sin()));
            uvs.push(Vec2::new(u as f32, v as f32));
        }
    }
    let row = columns + 1;
    for ring in 0..rings {
        for column in 0..columns {
            let (a, b) = (ring * row + column, ring * row + column + 1);
            if ring > 0 {
                triangles.push([a, b, b + row]);
            }
            if ring + 1 < rings {
                triangles.push([a, b + row, a + row]);
            }
        }
    }
    Mesh { triangles, rest: Pose { positions, normals: None }, uvs }
}

/// A square sheet of `n` by `n` units in the plane of x and z, facing up.
pub fn sheet(n: u32) -> Mesh {
    let vertex = |x: u32, z: u32| z * (n + 1) + x;
    let at = |x: u32, z: u32| DVec3::new(f64::from(x), 0.0, f64::from(z));
    let positions: Vec<DVec3> = (0..=n).flat_map(|z| (0..=n).map(move |x| at(x, z))).collect();
    let square = |x: u32, z: u32| {
        let [a, b, c, d] = [vertex(x, z), vertex(x + 1, z), vertex(x + 1, z + 1), vertex(x, z + 1)];
        [[a, d, b], [b, d, c]]
    };
    let triangles = (0..n).flat_map(|z| (0..n).flat_map(move |x| square(x, z))).collect();
    let uvs = positions.iter().map(|p| Vec2::new(p.x as f32, p.z as f32) / n as f32).collect();
    Mesh { triangles, rest: Pose { positions, normals: None }, uvs }
}

/// Strands of 1 to 7 points that start within `off` of an egg's surface, and go anywhere.
pub fn strands(count: u32, off: f32, seed: u64) -> Result<Groom, GroomError> {
    let mut offsets = vec![0];
    let mut points = Vec::new();
    for strand in 0..count {
        let one = |purpose: u64| random(seed, strand, &purpose.to_string()) * 2.0 - 1.0;
        let direction = Vec3::new(one(0), one(1), one(2)).normalize_or(Vec3::X);
        let mut point = direction * Vec3::new(1.0, 1.3, 1.0) * (1.0 + off * one(3));
        for k in 0..=u64::from(strand % 7) {
            points.push(point);
            point += 0.2 * direction + 0.1 * Vec3::new(one(10 + 3 * k), one(11 + 3 * k), one(12 + 3 * k));
        }
        offsets.push(points.len() as u32);
    }
    Groom::new(offsets, points)
}

/// Strands of three points upwards from these roots.
pub fn tufts(roots: impl IntoIterator<Item = Vec3>) -> Result<Groom, GroomError> {
    let points: Vec<Vec3> =
        roots.into_iter().flat_map(|p| [p, p + 0.1 * Vec3::Y, p + Vec3::new(0.05, 0.2, 0.0)]).collect();
    Groom::new((0..=points.len() as u32 / 3).map(|strand| 3 * strand).collect(), points)
}
