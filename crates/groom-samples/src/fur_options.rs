//! What can be asked for in a coat of fur.

use glam::{DVec3, Vec3};

use crate::SampleError;

/// The surface fur grows on, in any unit; fur comes out in the same numbers, rounded to 32 bits: far from the origin its
/// strands lose their shape.
#[derive(Clone, Copy, Debug)]
pub struct FurSurface<'a> {
    /// Vertices.
    pub positions: &'a [DVec3],
    /// Vertex indices, three a triangle, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Normals, one a vertex; without them they are the mean of the triangles that meet at a place.
    pub normals: Option<&'a [Vec3]>,
}

/// A coat of fur to be grown. The lengths are parts of others, so that the same options suit a mouse in metres
/// and a bear in inches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FurOptions {
    /// How many strands, 1 to 2^24.
    pub strands: u32,
    /// How many points each strand has, 2 to 1000.
    pub points: u32,
    /// Everything random hangs on it.
    pub seed: u64,
    /// Length of the longest strand, as a part of the diagonal of the surface's box; over 0, up to 1.
    pub length: f32,
    /// How much shorter than that the shortest may be: 0 all alike, 1 down to nothing.
    pub variation: f32,
    /// How much shorter fur is where the body is thin, as on ears, legs and noses: 0 not at all, 1 in proportion.
    pub thin: f32,
    /// 0 stands up from the skin, 1 lies along it at the tip.
    pub lean: f32,
    /// Where the fur lies to: a direction in the surface's space, laid onto the skin at every root. The default
    /// is towards the tail and down, for an animal that stands Y up and looks along +z.
    pub towards: Vec3,
    /// How far strands wind round their own course, as a part of their length; 0 to 1.
    pub curl: f32,
    /// How much tips gather in tufts, 0 to 1.
    pub clump: f32,
    /// Adds a colour at each point: brown, lighter towards the tip, no two strands alike.
    pub color: bool,
}

impl Default for FurOptions {
    fn default() -> Self {
        FurOptions {
            strands: 20_000,
            points: 8,
            seed: 1,
            length: 0.03,
            variation: 0.4,
            thin: 0.8,
            lean: 0.8,
            towards: Vec3::new(0.0, -0.5, -1.0),
            curl: 0.02,
            clump: 0.4,
            color: false,
        }
    }
}

impl FurOptions {
    /// Refuses options out of their range.
    pub(crate) fn check(&self) -> Result<(), SampleError> {
        let count = |what, found: u64, expected| Err(SampleError::Option { what, found, expected });
        if !(1..=1 << 24).contains(&self.strands) {
            return count("strands", self.strands.into(), "1 to 16777216");
        }
        if !(2..=1000).contains(&self.points) {
            return count("points per strand", self.points.into(), "2 to 1000");
        }
        let total = u64::from(self.strands) * u64::from(self.points);
        if total > u64::from(u32::MAX) {
            return count("strands x points", total, "fewer than 2^32");
        }
        let number = |what, found: String, expected| Err(SampleError::Number { what, found, expected });
        if !(self.length > 0.0 && self.length <= 1.0) {
            return number("length", self.length.to_string(), "over 0, up to 1 of the surface's diagonal");
        }
        for (what, value) in [
            ("variation", self.variation),
            ("thin", self.thin),
            ("lean", self.lean),
            ("curl", self.curl),
            ("clump", self.clump),
        ] {
            if !(0.0..=1.0).contains(&value) {
                return number(what, value.to_string(), "0 to 1");
            }
        }
        if !self.towards.is_finite() || self.towards.length() < f32::MIN_POSITIVE {
            return number("towards", self.towards.to_string(), "a direction: finite and not zero");
        }
        Ok(())
    }
}
