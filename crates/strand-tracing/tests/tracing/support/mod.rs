//! An independent intersector to test against, and seeded numbers.

use glam::{DVec3, Vec3, vec3};
use strand_tracing::{BuildOptions, Radii, Ray, Strands, Tracer};

#[path = "../../../benches/common/random.rs"]
mod random;

pub use random::Random;

impl Random {
    pub fn cube(&mut self) -> Vec3 {
        vec3(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

/// Strands with storage of their own.
#[derive(Clone)]
pub struct Hair {
    pub offsets: Vec<u32>,
    pub positions: Vec<Vec3>,
    pub radii: Vec<f32>,
}

impl Hair {
    pub fn new() -> Self {
        Self { offsets: vec![0], positions: Vec::new(), radii: Vec::new() }
    }

    pub fn push(&mut self, points: impl IntoIterator<Item = (Vec3, f32)>) {
        for (position, radius) in points {
            self.positions.push(position);
            self.radii.push(radius);
        }
        self.offsets.push(self.positions.len() as u32);
    }

    pub fn strands(&self) -> Strands<'_> {
        Strands {
            offsets: &self.offsets,
            positions: &self.positions,
            radii: Radii::PerVertex(&self.radii),
            moved: &[],
        }
    }

    pub fn tracer(&self) -> Tracer {
        Tracer::build(&[self.strands()], &[], &BuildOptions::default()).unwrap()
    }

    /// Every segment with its strand and place.
    pub fn spheres(&self) -> Vec<(u32, u32, Swept)> {
        let mut all = Vec::new();
        for (strand, range) in self.offsets.windows(2).enumerate() {
            for point in range[0]..range[1].saturating_sub(1) {
                all.push((strand as u32, point - range[0], self.swept(point as usize)));
            }
        }
        all
    }

    fn swept(&self, i: usize) -> Swept {
        Swept {
            a: self.positions[i].as_dvec3(),
            b: self.positions[i + 1].as_dvec3(),
            ra: f64::from(self.radii[i]),
            rb: f64::from(self.radii[i + 1]),
        }
    }
}

/// A sphere swept along a segment. The set of all (u, t) with the ray's point at `t` in the sphere at `u`
/// is convex, so ternary searches over `u` find everything; none of the product's algebra is shared.
#[derive(Clone, Copy, Debug)]
pub struct Swept {
    pub a: DVec3,
    pub b: DVec3,
    pub ra: f64,
    pub rb: f64,
}

/// Where a line is inside a swept sphere.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    pub enter: f64,
    pub exit: f64,
    /// Sphere entered.
    pub u: f64,
    /// How deep the line goes, in radii: near 0 it only grazes.
    pub depth: f64,
}

impl Swept {
    pub fn centre(&self, u: f64) -> DVec3 {
        self.a * (1.0 - u) + self.b * u
    }

    pub fn radius(&self, u: f64) -> f64 {
        self.ra * (1.0 - u) + self.rb * u
    }

    pub fn distance(&self, p: DVec3) -> f64 {
        let f = |u: f64| (p - self.centre(u)).length() - self.radius(u);
        f(least(0.0, 1.0, f))
    }

    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let o = ray.origin.as_dvec3();
        let d = ray.direction.as_dvec3();
        let dd = d.length_squared();
        let foot = |u: f64| (self.centre(u) - o).dot(d) / dd;
        let gap = |u: f64| (o + d * foot(u) - self.centre(u)).length() - self.radius(u);
        let deepest = least(0.0, 1.0, gap);
        let depth = -gap(deepest) / self.radius(deepest);
        if depth < 0.0 {
            return None;
        }
        let half = |u: f64| {
            let r = self.radius(u);
            let across = (o + d * foot(u) - self.centre(u)).length_squared();
            ((r * r - across).max(0.0) / dd).sqrt()
        };
        let low = edge(deepest, 0.0, gap);
        let high = edge(deepest, 1.0, gap);
        let u = least(low, high, |u| foot(u) - half(u));
        let v = least(low, high, |u| -foot(u) - half(u));
        Some(Span { enter: foot(u) - half(u), exit: foot(v) + half(v), u, depth })
    }
}

/// Where a convex function is least.
fn least(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (start, end) = (low, high);
    for _ in 0..90 {
        let third = (high - low) / 3.0;
        let (a, b) = (low + third, high - third);
        if f(a) <= f(b) { high = b } else { low = a }
    }
    let found = 0.5 * (low + high);
    [start, end, found].into_iter().min_by(|a, b| f(*a).total_cmp(&f(*b))).unwrap()
}

/// The last place from `inside` towards `end` where `f` is not positive.
fn edge(inside: f64, end: f64, f: impl Fn(f64) -> f64) -> f64 {
    if f(end) <= 0.0 {
        return end;
    }
    let (mut good, mut bad) = (inside, end);
    for _ in 0..70 {
        let middle = 0.5 * (good + bad);
        if f(middle) <= 0.0 { good = middle } else { bad = middle }
    }
    good
}

/// Wandering strands in a cube of half side `scale` round `offset`.
pub fn wander(random: &mut Random, scale: f32, offset: Vec3, thickness: f32, bend: f32) -> Hair {
    let mut hair = Hair::new();
    for _ in 0..24 {
        let mut at = random.cube();
        let mut ahead = random.direction();
        let points = 3 + (random.next() * 7.0) as usize;
        let even = random.next() < 0.3;
        let first = thickness * (0.2 + 0.8 * random.next());
        let strand: Vec<_> = (0..points)
            .map(|_| {
                let radius = if even { first } else { thickness * (0.2 + 0.8 * random.next()) };
                let point = (at * scale + offset, radius * scale);
                ahead = (ahead + random.direction() * bend).normalize_or(Vec3::X);
                at += ahead * (0.05 + 0.3 * random.next());
                point
            })
            .collect();
        hair.push(strand);
    }
    hair
}
