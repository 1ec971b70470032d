//! The ball of hair of the benches, and the numbers it and their rays are drawn from.

use glam::{Vec3, vec3};

/// Uniform numbers from a counter (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1_u64 << 24) as f32
    }

    pub fn direction(&mut self) -> Vec3 {
        let z = 1.0 - 2.0 * self.next();
        let (sin, cos) = (std::f32::consts::TAU * self.next()).sin_cos();
        let across = (1.0 - z * z).max(0.0).sqrt();
        vec3(across * cos, across * sin, z).normalize()
    }
}

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
