//! The skin of the head: vertices with normals, texture coordinates, weights, and where the morph moves them.

use std::f64::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::head::{HEAD_RADII, is_scalp};
use crate::mesh::SHRINK;
use crate::trigonometry::{cos, sin};

const RINGS: usize = 24;
const SECTORS: usize = 32;

/// Where the joints turn, in the rest pose.
pub(super) const NECK: Vec3 = Vec3::new(0.0, -0.13, -0.02);
pub(super) const HEAD: Vec3 = Vec3::new(0.0, -0.06, -0.02);

/// Between these heights the skin goes over from the neck to the head.
const BLEND: [f32; 2] = [-0.10, -0.03];

/// How far the morph pulls the scalp over the skull, in metres.
const PULL: f32 = 0.008;

/// The mesh, one entry a vertex; the seam of the texture coordinates has its vertices twice.
pub(super) struct Surface {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    /// Weights of the neck and the head in 255ths.
    pub(super) weights: Vec<[u8; 2]>,
    /// How the morph target moves positions.
    pub(super) surprise: Vec<Vec3>,
    /// Triangles on which hair grows, and the others.
    pub(super) scalp: Vec<[u16; 3]>,
    pub(super) skin: Vec<[u16; 3]>,
}

impl Surface {
    pub(super) fn new() -> Surface {
        let mut surface = Surface {
            positions: Vec::new(),
            normals: Vec::new(),
            uvs: Vec::new(),
            weights: Vec::new(),
            surprise: Vec::new(),
            scalp: Vec::new(),
            skin: Vec::new(),
        };
        for ring in 0..=RINGS {
            for sector in 0..=SECTORS {
                let (down, around) = (ring as f64 / RINGS as f64, sector as f64 / SECTORS as f64);
                surface.vertex(down, around);
            }
        }
        for ring in 0..RINGS {
            for sector in 0..SECTORS {
                let at = |r: usize, s: usize| ((ring + r) * (SECTORS + 1) + sector + s) as u16;
                // At the poles one side of the quad is a point.
                if ring > 0 {
                    surface.triangle([at(0, 0), at(1, 1), at(0, 1)]);
                }
                if ring < RINGS - 1 {
                    surface.triangle([at(0, 0), at(1, 0), at(1, 1)]);
                }
            }
        }
        surface
    }

    fn vertex(&mut self, down: f64, around: f64) {
        // The seam is at the back of the head, and both its sides are the same bits.
        let turn = TAU * (around.fract() + 0.5);
        let (polar, turn) = (PI * down, turn);
        // Exactly closed at the bottom, where the sine misses 0 by a rounding.
        let ring = if down == 0.0 || down == 1.0 { 0.0 } else { sin(polar) };
        let direction = Vec3::new(ring * sin(turn), cos(polar), ring * cos(turn));
        let position = direction * HEAD_RADII * SHRINK;
        let normal = (direction / HEAD_RADII).normalize_or(Vec3::Y);
        self.positions.push(position);
        self.normals.push(normal);
        self.uvs.push(Vec2::new(around as f32, down as f32));
        let part = ((position.y - BLEND[0]) / (BLEND[1] - BLEND[0])).clamp(0.0, 1.0);
        let head = (255.0 * part * part * (3.0 - 2.0 * part)).round() as u8;
        self.weights.push([255 - head, head]);
        // Backwards along the skin, strongest between brow and crown, gone at the neck and at the back.
        let along = Vec3::new(0.0, 0.6, -1.0);
        let along = along - normal * along.dot(normal);
        let strength = direction.y.clamp(0.0, 1.0) * (0.5 + 0.5 * direction.z);
        self.surprise.push(along * (PULL * strength));
    }

    fn triangle(&mut self, corners: [u16; 3]) {
        let middle: Vec3 = corners.iter().map(|&i| self.positions[usize::from(i)] / HEAD_RADII).sum();
        let part = if is_scalp(middle.normalize_or(Vec3::Y)) { &mut self.scalp } else { &mut self.skin };
        part.push(corners);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_face_outwards_and_the_seam_is_closed() {
        let surface = Surface::new();
        assert_eq!(surface.scalp.len() + surface.skin.len(), 2 * SECTORS * (RINGS - 1));
        for corners in surface.scalp.iter().chain(&surface.skin) {
            let [a, b, c] = corners.map(|i| surface.positions[usize::from(i)]);
            let normal = (b - a).cross(c - a);
            assert!(normal.length() > 1e-9 && normal.dot(a + b + c) > 0.0, "{corners:?}");
        }
        for ring in 0..=RINGS {
            let first = ring * (SECTORS + 1);
            assert_eq!(surface.positions[first], surface.positions[first + SECTORS]);
        }
        assert!(surface.surprise.iter().map(|m| m.length()).fold(0.0, f32::max) > 0.5 * PULL);
    }
}
