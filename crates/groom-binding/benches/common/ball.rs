//! The mesh of the benches, of 60,000 triangles.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use moving_mesh::Pose;

const RINGS: u32 = 151;
const COLUMNS: u32 = 200;

/// A ball with bumps, so that no two triangles are alike.
pub fn ball() -> (Vec<[u32; 3]>, Pose) {
    let (mut triangles, mut positions) = (Vec::new(), Vec::new());
    for ring in 0..=RINGS {
        for column in 0..COLUMNS {
            let (polar, around) =
                (PI * f64::from(ring) / f64::from(RINGS), TAU * f64::from(column) / f64::from(COLUMNS));
            let bump = 1.0 + 0.05 * (7.0 * polar).sin() * (5.0 * around).cos();
            let radius = if ring == 0 || ring == RINGS { 0.0 } else { polar.sin() };
            positions.push(bump * DVec3::new(radius * around.cos(), polar.cos(), -radius * around.sin()));
        }
    }
    for ring in 0..RINGS {
        for column in 0..COLUMNS {
            let (a, b) = (ring * COLUMNS + column, ring * COLUMNS + (column + 1) % COLUMNS);
            if ring > 0 {
                triangles.push([a, a + COLUMNS, b]);
            }
            if ring + 1 < RINGS {
                triangles.push([b, a + COLUMNS, b + COLUMNS]);
            }
        }
    }
    (triangles, Pose { positions, normals: None })
}
