//! Matte surfaces: Lambert's law, on both sides.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;
use moving_mesh::TriangleMesh;
use strand_tracing::{Hit, HitKind, Primitive};

use crate::{MeshObject, RenderError};

/// What the render loop needs to know of one mesh, beside what the tracer holds.
#[derive(Debug)]
pub(crate) struct Surface {
    albedo: Vec3,
    /// Only of a mesh with normals.
    smooth: Option<Smooth>,
}

/// Normals, and the vertices of the triangles to find them by.
#[derive(Debug)]
struct Smooth {
    triangles: Vec<[u32; 3]>,
    /// One a vertex, at every key of the shutter; one key where they do not turn.
    keys: Vec<Vec<Vec3>>,
}

impl Smooth {
    /// Of any length, even 0. A ray's `time` is within the shutter where anything moves; outside it, the normal
    /// is that of the nearer end.
    fn normal(&self, triangle: u32, [b, c]: [f32; 2], time: f32) -> Vec3 {
        let vertices = self.triangles[triangle as usize];
        let at = |key: &[Vec3]| {
            let corners = vertices.map(|vertex| key[vertex as usize]);
            corners[0] * (1.0 - b - c) + corners[1] * b + corners[2] * c
        };
        let last = self.keys.len() - 1;
        if last == 0 {
            return at(&self.keys[0]);
        }
        let place = time.clamp(0.0, 1.0) * last as f32;
        let before = (place as usize).min(last - 1);
        at(&self.keys[before]).lerp(at(&self.keys[before + 1]), place - before as f32)
    }
}

impl Surface {
    pub fn new(object: &MeshObject) -> Result<Self, RenderError> {
        let MeshObject { mesh: TriangleMesh { positions, triangles, normals }, albedo, turning, .. } = object;
        // `min_element` alone would pass over one NaN of three.
        if !(albedo.is_finite() && albedo.min_element() >= 0.0 && albedo.max_element() <= 1.0) {
            return Err(RenderError::argument("mesh albedo", albedo, "0..1"));
        }
        if normals.as_ref().is_some_and(|n| n.len() != positions.len()) {
            return Err(RenderError::argument("number of mesh normals", "another", "one normal a vertex"));
        }
        turning.check("turning of normals", positions.len())?;
        let smooth = normals.as_ref().map(|normals| Smooth {
            triangles: triangles.clone(),
            keys: match turning.distinct() {
                [] => vec![normals.clone()],
                keys => keys.to_vec(),
            },
        });
        Ok(Surface { albedo: *albedo, smooth })
    }

    /// The surface at a hit; `toward` is the direction back along the ray, `time` the ray's.
    pub fn at(&self, hit: &Hit, toward: Vec3, time: f32) -> SurfaceHit {
        let (HitKind::Triangle { normal, barycentrics }, Primitive::Triangle { triangle, .. }) =
            (hit.kind, hit.primitive)
        else {
            return SurfaceHit::black(toward);
        };
        let smooth =
            self.smooth.as_ref().map_or(normal, |smooth| smooth.normal(triangle, barycentrics, time));
        SurfaceHit::new(self.albedo, normal, smooth, toward)
    }
}

/// A matte surface at a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceHit {
    albedo: Vec3,
    /// Of the triangle, on the side the ray came from.
    flat: Vec3,
    /// Of the surface that the triangles stand for, on the same side.
    smooth: Vec3,
    alike: bool,
}

impl SurfaceHit {
    /// `flat` is the triangle's unit normal, `smooth` what its vertices say (of any length, even 0),
    /// `toward` the direction back along the ray that hit.
    fn new(albedo: Vec3, flat: Vec3, smooth: Vec3, toward: Vec3) -> Self {
        let flat = if flat.dot(toward) < 0.0 { -flat } else { flat };
        let smooth = smooth.try_normalize().unwrap_or(flat);
        let smooth = if smooth.dot(flat) < 0.0 { -smooth } else { smooth };
        SurfaceHit { albedo, flat, smooth, alike: flat.dot(smooth) >= 1.0 - 1e-6 }
    }

    /// A surface that reflects nothing.
    pub fn black(toward: Vec3) -> Self {
        SurfaceHit { albedo: Vec3::ZERO, flat: toward, smooth: toward, alike: true }
    }

    /// The triangle's own normal, on the side the ray came from: where rays may start.
    pub fn flat_normal(&self) -> Vec3 {
        self.flat
    }

    /// Reflection times cosine, and the density of [`SurfaceHit::sample`].
    pub fn evaluate(&self, wi: Vec3) -> (Vec3, f32) {
        let cosine = self.smooth.dot(wi).max(0.0);
        (self.albedo * (FRAC_1_PI * cosine * self.terminator(wi, cosine)), FRAC_1_PI * cosine)
    }

    /// What becomes of light that grazes: a smooth normal sees light that the triangle itself hides,
    /// and a hard edge between the two would show the triangles. Chiang et al. 2019, "Taming the
    /// Shadow Terminator" (doi:10.1145/3306307.3328172), eq. 3 and 4. Only darkens, and only where the
    /// two normals differ.
    fn terminator(&self, wi: Vec3, cosine: f32) -> f32 {
        if self.alike {
            return 1.0;
        }
        let above = self.flat.dot(wi);
        if above <= 0.0 || cosine <= 0.0 {
            return 0.0;
        }
        let share = (above / (cosine * self.flat.dot(self.smooth)).max(f32::MIN_POSITIVE)).min(1.0);
        share * (1.0 + share * (1.0 - share))
    }

    /// A direction in proportion to the cosine against the smooth normal.
    pub fn sample(&self, u: f32, v: f32) -> Vec3 {
        let (across, other) = self.smooth.any_orthonormal_pair();
        let (sin, cos) = (2.0 * PI * u).sin_cos();
        let radius = v.sqrt();
        let height = (1.0 - v).sqrt();
        (across * (radius * cos) + other * (radius * sin) + self.smooth * height).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sloping_normals_darken_and_never_let_light_through() {
        let slope = Vec3::new(0.5, 0.0, 1.0).normalize();
        let hit = SurfaceHit::new(Vec3::ONE, Vec3::NEG_Z, -2.0 * slope, Vec3::Z);
        assert!(hit.flat_normal() == Vec3::Z && (hit.smooth - slope).length() < 1e-6);
        let mut sum = 0.0;
        let count = 64;
        for i in 0..count * count {
            let (u, v) = ((i / count) as f32 + 0.5, (i % count) as f32 + 0.5);
            let wi = hit.sample(u / count as f32, v / count as f32);
            let (value, pdf) = hit.evaluate(wi);
            assert!(value.x <= pdf * (1.0 + 1e-5) && (wi.z > 0.0 || value == Vec3::ZERO));
            sum += value.x / pdf / (count * count) as f32;
        }
        assert!(sum > 0.8 && sum < 1.0, "{sum}");
        // Without a step where the triangle's own horizon is.
        let near = |z: f32| hit.evaluate(Vec3::new((1.0 - z * z).sqrt(), 0.0, z)).0.x;
        assert!(near(1e-3) < 0.01 && near(-1e-3) == 0.0 && near(0.3) > 0.1);
    }

    #[test]
    fn without_slope_it_is_lamberts_law() {
        for smooth in [Vec3::Y, Vec3::NEG_Y, Vec3::ZERO] {
            let hit = SurfaceHit::new(Vec3::splat(0.5), Vec3::Y, smooth, Vec3::Y);
            let (value, pdf) = hit.evaluate(Vec3::new(0.8, 0.6, 0.0));
            assert!((value.x - 0.3 * FRAC_1_PI).abs() < 1e-7 && (pdf - 0.6 * FRAC_1_PI).abs() < 1e-7);
        }
        assert_eq!(SurfaceHit::black(Vec3::Y).evaluate(Vec3::Y).0, Vec3::ZERO);
    }
}
