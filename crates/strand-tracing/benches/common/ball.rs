//! The ball of hair of the benches.

use glam::Vec3;

use super::random::Random;

/// Strands, ready to be traced.
pub struct Hair {
    pub name: &'static str,
    pub offsets: Vec<u32>,
    pub positions: Vec<Vec3>,
    pub radii: Vec<f32>,
}

/// Strands that hang from a ball, root to tip in `segments` steps.
pub fn ball(strands: u32, segments: u32) -> Hair {
    let mut random = Random(1);
    let mut hair = Hair { name: "ball", offsets: vec![0], positions: Vec::new(), radii: Vec::new() };
    for _ in 0..strands {
        let out = random.direction();
        let side = out.any_orthonormal_vector() * (random.next() - 0.5);
        for point in 0..=segments {
            let s = point as f32 / segments as f32;
            hair.positions.push(out * (5.0 + 5.0 * s) + (side + Vec3::NEG_Y) * 2.0 * s * s);
            hair.radii.push(0.05 - 0.03 * s);
        }
        hair.offsets.push(hair.positions.len() as u32);
    }
    hair
}
