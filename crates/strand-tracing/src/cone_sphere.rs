//! The cone-sphere: the convex hull of two spheres, and where a line enters and leaves it.

use glam::{DVec3, Vec4, Vec4Swizzles};

use crate::line::Line;

/// Below this share of the direction's squared length across the axis, the foot of the common
/// perpendicular is too far along the ray to be a useful place to solve from.
const NEARLY_PARALLEL: f64 = 1e-9;

/// The convex hull of the sphere `a`, `ra` and the sphere `b`, `rb`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConeSphere {
    pub(crate) a: DVec3,
    pub(crate) ab: DVec3,
    pub(crate) ra: f64,
    pub(crate) rb: f64,
}

/// A line coming into a cone-sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    /// Where along the line; negative behind its origin.
    pub(crate) t: f64,
    /// Which of the swept spheres is touched, 0 at `a` and 1 at `b`.
    pub(crate) u: f64,
}

impl ConeSphere {
    /// From two stored points; their `w` is the radius, its sign is not part of it.
    pub(crate) fn new(a: Vec4, b: Vec4) -> Self {
        let start = a.xyz().as_dvec3();
        Self { a: start, ab: b.xyz().as_dvec3() - start, ra: f64::from(a.w.abs()), rb: f64::from(b.w.abs()) }
    }

    pub(crate) fn inflated(&self, by: f64) -> Self {
        Self { ra: self.ra + by, rb: self.rb + by, ..*self }
    }

    pub(crate) fn radius(&self, u: f64) -> f64 {
        self.ra + (self.rb - self.ra) * u
    }

    /// Where the line comes in, be it before or behind its origin.
    #[inline]
    pub(crate) fn entry(&self, line: &Line) -> Option<Entry> {
        let from_a = line.origin - self.a;
        let across = self.ab.cross(line.direction);
        let offset = from_a.dot(across);
        let widest = self.ra.max(self.rb);
        // Most segments whose box is crossed end here: the lines are too far apart. No division needed.
        if offset * offset > widest * widest * across.length_squared() * (1.0 + 1e-12) {
            return None;
        }
        self.entry_near(line, from_a)
    }

    fn entry_near(&self, line: &Line, from_a: DVec3) -> Option<Entry> {
        let length_squared = self.ab.length_squared();
        let narrowing = self.ra - self.rb;
        if length_squared <= narrowing * narrowing {
            // One sphere holds the other (or there is no length at all).
            let u = if narrowing > 0.0 { 0.0 } else { 1.0 };
            return self.sphere_entry(line, from_a, u);
        }
        match self.side_entry(line, from_a, length_squared) {
            Side::Missed => None,
            Side::Hit(entry) => Some(entry),
            Side::Beyond => {
                let a = self.sphere_entry(line, from_a, 0.0);
                let b = self.sphere_entry(line, from_a, 1.0);
                match (a, b) {
                    (Some(a), Some(b)) => Some(if b.t < a.t { b } else { a }),
                    (a, b) => a.or(b),
                }
            }
        }
    }

    /// The conical side, in the segment's own frame: everything is split into a part along the axis and a
    /// part across it, with the line's origin moved to its point nearest the axis first.
    fn side_entry(&self, line: &Line, from_a: DVec3, length_squared: f64) -> Side {
        let per_length = 1.0 / length_squared;
        let narrowing = self.ra - self.rb;
        let along = line.direction.dot(self.ab) * per_length;
        let across = line.direction - self.ab * along;
        let start_along = from_a.dot(self.ab) * per_length;
        let start_across = from_a - self.ab * start_along;

        let across_squared = across.length_squared();
        let moved = if across_squared > NEARLY_PARALLEL * line.squared {
            -start_across.dot(across) / across_squared
        } else {
            (self.ab * 0.5 - from_a).dot(line.direction) / line.squared
        };
        let u0 = start_along + moved * along;
        let p = start_across + across * moved;

        // |p + t q|^2 (1 - n^2 / l^2) = r(u0 + t u')^2, the cone tangent to both spheres.
        let slant = 1.0 - narrowing * narrowing * per_length;
        let r0 = self.ra - narrowing * u0;
        let shrink = narrowing * along;
        let k2 = slant * across_squared - shrink * shrink;
        let k1 = slant * p.dot(across) + shrink * r0;
        let k0 = slant * p.length_squared() - r0 * r0;
        let discriminant = k1 * k1 - k0 * k2;
        if discriminant < 0.0 {
            // Both spheres lie inside the tangent double cone: who misses it misses all.
            return Side::Missed;
        }
        let root = discriminant.sqrt();
        // The entering root whatever the sign of k2, by the form that does not cancel.
        let t = if k1 <= 0.0 { k0 / (root - k1) } else { (-k1 - root) / k2 };
        let u = (u0 + t * along - self.ra * narrowing * per_length) / slant;
        if (0.0..=1.0).contains(&u) { Side::Hit(Entry { t: moved + t, u }) } else { Side::Beyond }
    }

    fn sphere_entry(&self, line: &Line, from_a: DVec3, u: f64) -> Option<Entry> {
        let from_centre = from_a - self.ab * u;
        let moved = -from_centre.dot(line.direction) / line.squared;
        let nearest = from_centre + line.direction * moved;
        let radius = if u == 0.0 { self.ra } else { self.rb };
        let inside = radius * radius - nearest.length_squared();
        if inside < 0.0 || radius <= 0.0 {
            return None;
        }
        Some(Entry { t: moved - (inside / line.squared).sqrt(), u })
    }

    /// Where the line comes in and where it goes out again.
    pub(crate) fn span(&self, line: &Line) -> Option<(f64, f64)> {
        let entry = self.entry(line)?;
        let exit = self.entry(&line.reversed())?;
        Some((entry.t, (-exit.t).max(entry.t)))
    }

    /// Distance of a point from the surface, negative inside.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        let from_a = point - self.a;
        let length_squared = self.ab.length_squared();
        let narrowing = self.ra - self.rb;
        let u = if length_squared <= narrowing * narrowing {
            if narrowing > 0.0 { 0.0 } else { 1.0 }
        } else {
            let along = from_a.dot(self.ab) / length_squared;
            let across = (from_a - self.ab * along).length();
            let slant = (1.0 - narrowing * narrowing / length_squared).sqrt();
            (along - across * narrowing / (length_squared * slant)).clamp(0.0, 1.0)
        };
        (from_a - self.ab * u).length() - self.radius(u)
    }

    /// The signed offset of the line from the axis over the radius at `u`; see
    /// [`HitKind::Segment`](crate::HitKind::Segment).
    pub(crate) fn offset(&self, line: &Line, tangent: DVec3, u: f64) -> f64 {
        let across = tangent.cross(line.direction);
        let length = across.length();
        if length * length <= NEARLY_PARALLEL * NEARLY_PARALLEL * line.squared {
            return 0.0;
        }
        let centre = line.origin - self.a - self.ab * u;
        (centre.dot(across) / (length * self.radius(u))).clamp(-1.0, 1.0)
    }
}

enum Side {
    /// The line misses the cone and so everything.
    Missed,
    Hit(Entry),
    /// The cone is met outside its tangent circles: only an end sphere can be entered.
    Beyond,
}
