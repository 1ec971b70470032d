//! Four segments side by side, and a test that rejects all four that a ray's line certainly misses.
//!
//! A needle that lies across the axes fills little of its box, so most boxes are crossed in vain. Here the
//! line's distance from the segment itself is compared with its radius, for four segments at a time and
//! in single precision; only what survives costs an exact intersection.

use glam::{DVec3, Vec3, Vec4, Vec4Swizzles};

use crate::Ray;
use crate::pieces::Piece;

/// Segments of one pack.
pub(crate) const PACKED: usize = 4;
/// The number in a lane that holds nothing.
pub(crate) const NOTHING: u32 = u32::MAX;
/// Farthest geometry whose squares are still numbers.
const FARTHEST: f64 = 1e18;

/// Up to four segments: two cache lines, as much as four boxes take.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Pack {
    /// Per axis, the four starts and the four ends.
    ends: [[Vec4; 2]; 3],
    /// The larger of each segment's radii; not a number where there is none.
    radii: Vec4,
    numbers: [u32; PACKED],
}

impl Pack {
    pub(crate) const EMPTY: Self =
        Self { ends: [[Vec4::ZERO; 2]; 3], radii: Vec4::NAN, numbers: [NOTHING; PACKED] };

    fn set(&mut self, lane: usize, &Piece { number, a, b }: &Piece) {
        for axis in 0..3 {
            self.ends[axis][0][lane] = a[axis];
            self.ends[axis][1][lane] = b[axis];
        }
        self.radii[lane] = a.w.abs().max(b.w.abs());
        self.numbers[lane] = number;
    }

    #[inline]
    pub(crate) fn number(&self, lane: usize) -> u32 {
        self.numbers[lane & (PACKED - 1)]
    }
}

/// All packs.
#[derive(Clone, Debug)]
pub(crate) struct Packs {
    packs: Vec<Pack>,
    /// Round every end of every segment.
    bounds: (Vec3, Vec3),
}

impl Default for Packs {
    fn default() -> Self {
        Self { packs: Vec::new(), bounds: (Vec3::INFINITY, Vec3::NEG_INFINITY) }
    }
}

impl Packs {
    /// Adds a pack and numbers it.
    pub(crate) fn push<'a>(&mut self, pieces: impl Iterator<Item = &'a Piece>) -> u32 {
        let mut pack = Pack::EMPTY;
        for (lane, piece) in pieces.take(PACKED).enumerate() {
            pack.set(lane, piece);
            let (a, b) = (piece.a.xyz(), piece.b.xyz());
            self.bounds = (self.bounds.0.min(a).min(b), self.bounds.1.max(a).max(b));
        }
        self.packs.push(pack);
        (self.packs.len() - 1) as u32
    }

    pub(crate) fn finish(&mut self) {
        self.packs.shrink_to_fit();
    }

    pub(crate) fn bytes(&self) -> usize {
        self.packs.capacity() * size_of::<Pack>()
    }

    #[inline]
    pub(crate) fn get(&self, number: u32) -> Option<&Pack> {
        self.packs.get(number as usize)
    }

    pub(crate) fn bounds(&self) -> (Vec3, Vec3) {
        self.bounds
    }
}

/// A ray's line seen along itself: where two axes across it place a point is how far off the line it is.
///
/// # The slack
/// With unit roundoff `e = 2^-24` and `P` the distance from the ray's origin to the farthest end of any
/// segment: differences of stored coordinates are off by `e`, the axes by `e`, a sum of three products by
/// `3e`, so a projected end is off by at most `sqrt(2) 5e P < 7.1e P`. Its difference from the other end
/// adds `2e P`, the place of the nearest point between them (a sum of two products, a quotient) `6e P`,
/// the point there `3e P`, its length `e P`: less than `20e P` together. Less than `2^-62` is lost to
/// underflow. `32e P + 2^-60` covers both.
pub(crate) struct Sight {
    origin: [Vec4; 3],
    right: [Vec4; 3],
    up: [Vec4; 3],
    slack: Vec4,
    /// All lanes' bits where single precision cannot tell.
    blind: u32,
}

impl Sight {
    /// `bounds` hold every end of every segment.
    pub(crate) fn new(ray: &Ray, bounds: (Vec3, Vec3)) -> Self {
        let origin = ray.origin.as_dvec3();
        let (right, up) = ray.direction.as_dvec3().normalize_or(DVec3::Z).any_orthonormal_pair();
        let (low, high) = (bounds.0.as_dvec3(), bounds.1.as_dvec3());
        let farthest = (low - origin).abs().max((high - origin).abs()).length();
        let slack = 16.0 * f64::from(f32::EPSILON) * farthest + 2.0_f64.powi(-60);
        let splat = |v: Vec3| v.to_array().map(Vec4::splat);
        Self {
            origin: splat(ray.origin),
            right: splat(right.as_vec3()),
            up: splat(up.as_vec3()),
            slack: Vec4::splat(slack as f32),
            blind: if farthest < FARTHEST { 0 } else { 0b1111 },
        }
    }

    /// With ends that are this much farther off than stored ones.
    pub(crate) fn blurred(self, by: f64) -> Self {
        Self { slack: self.slack + Vec4::splat((by as f32).next_up()), ..self }
    }

    /// A bit for every segment that the line may hit.
    #[inline(always)]
    pub(crate) fn near(&self, pack: &Pack) -> u32 {
        self.reached(|axis, end| pack.ends[axis][end], pack.radii)
    }

    /// The same, of ends given by axis and end (0 or 1).
    #[inline(always)]
    pub(crate) fn reached(&self, ends: impl Fn(usize, usize) -> Vec4, radii: Vec4) -> u32 {
        let place = |end: usize| {
            let x = ends(0, end) - self.origin[0];
            let y = ends(1, end) - self.origin[1];
            let z = ends(2, end) - self.origin[2];
            let across = |axis: &[Vec4; 3]| x * axis[0] + y * axis[1] + z * axis[2];
            (across(&self.right), across(&self.up))
        };
        let (ax, ay) = place(0);
        let (bx, by) = place(1);
        let (ex, ey) = (bx - ax, by - ay);
        let squared = (ex * ex + ey * ey).max(Vec4::splat(f32::MIN_POSITIVE));
        let u = (-(ax * ex + ay * ey) / squared).max(Vec4::ZERO).min(Vec4::ONE);
        let (x, y) = (ax + ex * u, ay + ey * u);
        let reach = radii + self.slack;
        (x * x + y * y).cmple(reach * reach).bitmask() | self.blind
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)]

    use glam::{Vec3Swizzles, vec3};
    use proptest::prelude::*;

    use super::*;
    use crate::cone_sphere::ConeSphere;
    use crate::line::Line;

    fn anywhere() -> impl Strategy<Value = Vec3> {
        (-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0).prop_map(|(x, y, z)| vec3(x, y, z))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40_000))]

        /// Whatever the scale and wherever the scene: what the exact test hits survives. Rays are aimed at
        /// the very rim, where rejection is closest to being wrong, from near and far.
        #[test]
        fn no_hit_is_rejected(
            (start, along, across) in (anywhere(), anywhere(), anywhere()),
            length in -5.0_f32..1.0,
            (thick, thin) in (-6.0_f32..1.0, 0.0_f32..1.0),
            (scale, far, back) in (-6.0_f32..6.0, -6.0_f32..6.0, -3.0_f32..4.0),
            (u, rim, slope) in (-0.1_f32..1.1, -1e-4_f32..1e-4, anywhere()),
            parallel in -6.0_f32..0.5,
        ) {
            let ten = |power: f32| 10.0_f32.powf(power);
            let scale = ten(scale);
            let a = start * scale + slope.zxy() * ten(far);
            let b = a + along * (scale * ten(length));
            let radius = scale * ten(thick);
            let piece = Piece { number: 7, a: a.extend(radius), b: b.extend(radius * thin) };
            let axis = (b - a).normalize_or(Vec3::X);
            let direction = (axis + slope * ten(parallel)).normalize_or(Vec3::Y);
            let off = across.cross(direction).normalize_or_zero() * (radius * (1.0 + (thin - 1.0) * u));
            let origin = a.lerp(b, u) + off * (1.0 + rim) - direction * (scale * ten(back));
            let ray = Ray { origin, direction, t_max: f32::INFINITY, time: 0.0 };
            let mut packs = Packs::default();
            packs.push([piece; 3].iter());
            let near = Sight::new(&ray, packs.bounds()).near(packs.get(0).unwrap());
            let hit = ConeSphere::new(piece.a, piece.b).entry(&Line::of(&ray)).is_some();
            prop_assert!(!hit || near & 0b111 == 0b111, "{ray:?} {piece:?}");
        }
    }

    #[test]
    fn far_misses_are_rejected_and_empty_lanes_stay_empty() {
        let piece = Piece { number: 7, a: vec3(-1.0, -1.0, 0.0).extend(0.01), b: Vec3::ONE.extend(0.01) };
        let mut packs = Packs::default();
        packs.push([piece].iter());
        let near = |x: f32| {
            let ray =
                Ray { origin: vec3(x, -x, 9.0), direction: Vec3::NEG_Z, t_max: f32::INFINITY, time: 0.0 };
            Sight::new(&ray, packs.bounds()).near(packs.get(0).unwrap())
        };
        assert_eq!([near(0.0), near(0.007), near(0.0072), near(0.5)], [1, 1, 0, 0]);
        assert_eq!(packs.get(0).unwrap().number(3), NOTHING);
    }

    #[test]
    fn beyond_single_precision_everything_survives() {
        let piece = Piece { number: 7, a: Vec3::splat(1e30).extend(1.0), b: Vec3::splat(-1e30).extend(1.0) };
        let mut packs = Packs::default();
        packs.push([piece; 4].iter());
        let ray = Ray { origin: Vec3::ONE, direction: Vec3::X, t_max: f32::INFINITY, time: 0.0 };
        assert_eq!(Sight::new(&ray, packs.bounds()).near(packs.get(0).unwrap()), 0b1111);
    }
}
