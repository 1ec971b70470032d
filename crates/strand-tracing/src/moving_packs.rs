//! Four moving segments side by side: the pack of a still tree, at every key.

use glam::{Vec3, Vec4, Vec4Swizzles};

use crate::Ray;
use crate::moving_pieces::{MovingPiece, MovingPieces};
use crate::pack::{NOTHING, PACKED, Sight};
use crate::shares::Shares;

/// What does not change.
#[derive(Clone, Copy, Debug)]
struct Lanes {
    /// The larger of each segment's radii; not a number where there is none.
    radii: Vec4,
    numbers: [u32; PACKED],
}

/// Per axis, the four starts and the four ends.
type Ends = [[Vec4; 2]; 3];

/// All packs.
#[derive(Clone, Debug)]
pub(crate) struct MovingPacks {
    keys: usize,
    lanes: Vec<Lanes>,
    /// At every key, pack after pack.
    ends: Vec<Ends>,
    /// Round every end of every segment at every key.
    bounds: (Vec3, Vec3),
}

impl MovingPacks {
    pub(crate) fn new(keys: usize) -> Self {
        let bounds = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        Self { keys, lanes: Vec::new(), ends: Vec::new(), bounds }
    }

    /// Adds a pack and numbers it.
    pub(crate) fn push<'a>(
        &mut self,
        all: &MovingPieces,
        pieces: impl Iterator<Item = &'a MovingPiece>,
    ) -> u32 {
        let mut lanes = Lanes { radii: Vec4::NAN, numbers: [NOTHING; PACKED] };
        let start = self.ends.len();
        self.ends.resize(start + self.keys, Ends::default());
        for (lane, piece) in pieces.take(PACKED).enumerate() {
            lanes.numbers[lane] = piece.number;
            for (key, ends) in self.ends[start..].iter_mut().enumerate() {
                let (a, b) = all.ends(piece, key);
                for (axis, ends) in ends.iter_mut().enumerate() {
                    ends[0][lane] = a[axis];
                    ends[1][lane] = b[axis];
                }
                // The same at all keys.
                lanes.radii[lane] = a.w.max(b.w);
                let (a, b) = (a.xyz(), b.xyz());
                self.bounds = (self.bounds.0.min(a).min(b), self.bounds.1.max(a).max(b));
            }
        }
        self.lanes.push(lanes);
        (self.lanes.len() - 1) as u32
    }

    pub(crate) fn finish(&mut self) {
        self.lanes.shrink_to_fit();
        self.ends.shrink_to_fit();
    }

    pub(crate) fn bytes(&self) -> usize {
        self.lanes.capacity() * size_of::<Lanes>() + self.ends.capacity() * size_of::<Ends>()
    }

    /// A ray's line, for [`near`](MovingPacks::near).
    ///
    /// # The slack
    /// Beside what [`Sight`] needs. A point's coordinate is at most `e M` from the exact mix of two keys, `M`
    /// being the greatest magnitude of any coordinate and `e = 2^-24`. The mix found here is off by `e M` for
    /// the two shares, `e M` for the two products and `e M` for their sum. That is `4e M` in each of three
    /// axes, less than `7e M` together, and the line's distance from a segment is no more off than its ends.
    pub(crate) fn sight(&self, ray: &Ray) -> Sight {
        let (low, high) = (self.bounds.0.as_dvec3(), self.bounds.1.as_dvec3());
        let largest = low.abs().max(high.abs()).max_element();
        Sight::new(ray, self.bounds).blurred(4.0 * f64::from(f32::EPSILON) * largest)
    }

    /// A bit for every segment of a pack that the line may hit.
    #[inline(always)]
    pub(crate) fn near(&self, sight: &Sight, shares: &Shares, pack: u32) -> u32 {
        let Some(lanes) = self.lanes.get(pack as usize) else { return 0 };
        let start = pack as usize * self.keys + shares.before;
        let Some([before, after]) = self.ends.get(start..start + 2) else { return 0 };
        sight.reached(|axis, end| shares.mix(before[axis][end], after[axis][end]), lanes.radii)
    }

    #[inline]
    pub(crate) fn number(&self, pack: u32, lane: usize) -> u32 {
        self.lanes.get(pack as usize).map_or(NOTHING, |lanes| lanes.numbers[lane & (PACKED - 1)])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use glam::{Vec3Swizzles, vec3};
    use proptest::prelude::*;

    use super::*;
    use crate::cone_sphere::ConeSphere;
    use crate::fibres::Fibres;
    use crate::line::Line;
    use crate::meshes::Meshes;
    use crate::pose::{Moment, Pose};
    use crate::{Radii, Strands};

    fn anywhere() -> impl Strategy<Value = Vec3> {
        (-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0).prop_map(|(x, y, z)| vec3(x, y, z))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// As for still packs: what the exact test hits survives, at the very rim, whatever the scale, the
        /// place and the time; also where the tree has fewer keys than the strand.
        #[test]
        fn no_hit_is_rejected(
            ends in prop::array::uniform4(prop::array::uniform2(anywhere())),
            (length, thick, thin) in (-5.0_f32..1.0, -6.0_f32..1.0, 0.0_f32..1.0),
            (scale, far, back) in (-6.0_f32..6.0, -6.0_f32..6.0, -3.0_f32..4.0),
            (u, rim, across, slope) in (-0.1_f32..1.1, -1e-4_f32..1e-4, anywhere(), anywhere()),
            (parallel, time) in (-6.0_f32..0.5, 0.0_f32..=1.0),
            (keys, intervals) in (2_usize..5, 1_usize..5),
        ) {
            let ten = |power: f32| 10.0_f32.powf(power);
            let scale = ten(scale);
            let radius = scale * ten(thick);
            let keys: Vec<[Vec3; 2]> = ends[..keys]
                .iter()
                .map(|&[a, b]| (a * scale + slope.zxy() * ten(far), b * (scale * ten(length))))
                .map(|(a, along)| [a, a + along])
                .collect();
            let moved: Vec<&[Vec3]> = keys[1..].iter().map(|key| key.as_slice()).collect();
            let radii = [radius, radius * thin];
            let radii = Radii::PerVertex(&radii);
            let strands = Strands { offsets: &[0, 2], positions: &keys[0], radii, moved: &moved };
            let fibres = Fibres::gather(&[strands]).unwrap();
            let moment = Moment { fibres: &fibres, meshes: &Meshes::default(), time: f64::from(time) };
            let Some((a, b)) = moment.ends(0) else { return Ok(()) };
            let (p, q) = (a.xyz(), b.xyz());
            let direction = ((q - p).normalize_or(Vec3::X) + slope * ten(parallel)).normalize_or(Vec3::Y);
            let off = across.cross(direction).normalize_or_zero() * (radius * (1.0 + (thin - 1.0) * u));
            let origin = p.lerp(q, u) + off * (1.0 + rim) - direction * (scale * ten(back));
            let ray = Ray { origin, direction, t_max: f32::INFINITY, time };
            let pieces = MovingPieces::cut(&moment, intervals);
            let mut packs = MovingPacks::new(intervals + 1);
            packs.push(&pieces, pieces.all.iter());
            let shares = Shares::of(f64::from(time), intervals);
            let near = packs.near(&packs.sight(&ray), &shares, 0);
            let hit = ConeSphere::new(a, b).entry(&Line::of(&ray)).is_some();
            prop_assert!(!hit || near & 1 == 1, "{ray:?} {keys:?}");
        }
    }
}
