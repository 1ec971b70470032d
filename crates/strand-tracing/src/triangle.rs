//! Watertight ray against triangle.

use glam::{DVec3, Vec3};

use crate::line::Line;

/// The part of the test that depends on the ray only: the shear that turns its direction into +z.
///
/// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", in double precision: two triangles
/// that share an edge compute exactly opposite edge functions, so a ray cannot slip between them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shear {
    axes: [usize; 3],
    scale: [f64; 3],
}

/// A crossing: distance along the ray and the weights of the second and third vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    pub(crate) t: f64,
    pub(crate) weights: [f64; 2],
}

impl Shear {
    pub(crate) fn new(line: &Line) -> Self {
        let size = line.direction.abs();
        let z = if size.x > size.y && size.x > size.z {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let along = line.direction[z];
        let scale = [line.direction[axes[0]] / along, line.direction[axes[1]] / along, 1.0 / along];
        Self { axes, scale }
    }

    fn apply(&self, line: &Line, vertex: Vec3) -> [f64; 3] {
        let v: DVec3 = vertex.as_dvec3() - line.origin;
        let z = v[self.axes[2]];
        [v[self.axes[0]] - self.scale[0] * z, v[self.axes[1]] - self.scale[1] * z, self.scale[2] * z]
    }

    /// Where the line crosses the triangle, from either side, be it before or behind its origin.
    pub(crate) fn cross(&self, line: &Line, vertices: &[Vec3; 3]) -> Option<Crossing> {
        let [a, b, c] = vertices.map(|v| self.apply(line, v));
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let sum = u + v + w;
        if sum == 0.0 || !sum.is_finite() {
            return None;
        }
        let t = (u * a[2] + v * b[2] + w * c[2]) / sum;
        Some(Crossing { t, weights: [v / sum, w / sum] })
    }
}

/// Unit normal by the right-hand rule; zero for a triangle without area.
pub(crate) fn normal(vertices: &[Vec3; 3]) -> Vec3 {
    let [a, b, c] = vertices.map(|v| v.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero().as_vec3()
}

/// The point with these weights.
pub(crate) fn point(vertices: &[Vec3; 3], weights: [f64; 2]) -> Vec3 {
    let [a, b, c] = vertices.map(|v| v.as_dvec3());
    (a + (b - a) * weights[0] + (c - a) * weights[1]).as_vec3()
}

/// Whether a ray that leaves the triangle `left` meets the triangle `met` at `t` for no reason but rounding:
/// they share a vertex, and in single precision the ray starts on the one or meets the other where it still
/// lies in the first.
pub(crate) fn is_seam(line: &Line, left: &[Vec3; 3], met: &[Vec3; 3], t: f64) -> bool {
    if !met.iter().any(|vertex| left.contains(vertex)) {
        return false;
    }
    let size = left.iter().chain(met).fold(0.0, |size: f32, v| size.max(v.abs().max_element()));
    let rounding = 2.0 * f64::from(f32::EPSILON) * f64::from(size);
    let within = |triangle: &[Vec3; 3], point: DVec3| {
        let [a, b, c] = triangle.map(|v| v.as_dvec3());
        (b - a).cross(c - a).normalize_or_zero().dot(point - a).abs() <= rounding
    };
    within(met, line.origin) || within(left, line.at(t))
}
