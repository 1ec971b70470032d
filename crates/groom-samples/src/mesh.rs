//! The head as a mesh.

use std::fmt::Write;

use glam::Vec3;

use crate::head::HEAD_RADII;
use crate::trigonometry::{cos, sin};

/// How much smaller than the roots' surface the mesh is, so that the straight pieces hair is made of
/// do not cut through it.
pub(crate) const SHRINK: f32 = 0.97;

/// The head as a Wavefront OBJ file: an ellipsoid of quads and triangles with smooth normals, y up,
/// in metres, a little smaller than the surface the hair grows on.
#[must_use]
pub fn head_obj() -> String {
    const RINGS: usize = 24;
    const SECTORS: usize = 32;
    let mut text = String::from("# Head for groomkit's sample hair: metres, y up, face towards +z\no head\n");
    let mut vertex = |direction: Vec3| {
        let (p, n) = (direction * HEAD_RADII * SHRINK, (direction / HEAD_RADII).normalize_or(Vec3::Y));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {:.6} {:.6} {:.6}\nvn {:.4} {:.4} {:.4}", p.x, p.y, p.z, n.x, n.y, n.z);
    };
    vertex(Vec3::Y);
    for ring in 1..RINGS {
        let polar = std::f64::consts::PI * ring as f64 / RINGS as f64;
        for sector in 0..SECTORS {
            let turn = std::f64::consts::TAU * sector as f64 / SECTORS as f64;
            vertex(Vec3::new(sin(polar) * sin(turn), cos(polar), sin(polar) * cos(turn)));
        }
    }
    vertex(Vec3::NEG_Y);
    let at = |ring: usize, sector: usize| 2 + (ring - 1) * SECTORS + sector % SECTORS;
    let bottom = 2 + (RINGS - 1) * SECTORS;
    let mut face = |corners: &[usize]| {
        let corners: Vec<String> = corners.iter().map(|i| format!("{i}//{i}")).collect();
        let _ = writeln!(text, "f {}", corners.join(" "));
    };
    for s in 0..SECTORS {
        face(&[1, at(1, s), at(1, s + 1)]);
        for r in 1..RINGS - 1 {
            face(&[at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)]);
        }
        face(&[at(RINGS - 1, s), bottom, at(RINGS - 1, s + 1)]);
    }
    text
}
