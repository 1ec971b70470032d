//! Matte surfaces: Lambert's law, on both sides.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

/// A matte surface at a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceHit {
    albedo: Vec3,
    /// On the side the ray came from.
    normal: Vec3,
}

impl SurfaceHit {
    /// `toward` is the direction back along the ray that hit.
    pub fn new(albedo: Vec3, normal: Vec3, toward: Vec3) -> Self {
        SurfaceHit { albedo, normal: if normal.dot(toward) < 0.0 { -normal } else { normal } }
    }

    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// Reflection times cosine, and the density of [`SurfaceHit::sample`].
    pub fn evaluate(&self, wi: Vec3) -> (Vec3, f32) {
        let cosine = self.normal.dot(wi).max(0.0);
        (self.albedo * (FRAC_1_PI * cosine), FRAC_1_PI * cosine)
    }

    /// A direction in proportion to the cosine.
    pub fn sample(&self, u: f32, v: f32) -> Vec3 {
        let (across, other) = self.normal.any_orthonormal_pair();
        let (sin, cos) = (2.0 * PI * u).sin_cos();
        let radius = v.sqrt();
        let height = (1.0 - v).sqrt();
        (across * (radius * cos) + other * (radius * sin) + self.normal * height).normalize()
    }
}
