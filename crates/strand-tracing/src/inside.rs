//! What it means for a ray to be inside a fibre.

use glam::{DVec3, Vec4Swizzles};

use crate::cone_sphere::ConeSphere;
use crate::line::Line;
use crate::pose::Pose;

/// An entry point counts as inside a neighbour when it is deeper than this share of the radius: points on
/// the joint they share are on both surfaces.
const ON_SURFACE: f64 = 1e-5;
/// How many neighbours along the strand are looked at on either side for an entry inside them.
const NEIGHBOURS: u32 = 8;

/// The stretch a ray starts in while it is still inside the fibre it leaves.
pub(crate) struct Departure {
    /// Numbers of the strand's points.
    strand: std::ops::Range<u32>,
    segment: u32,
}

impl Departure {
    pub(crate) fn new(strand: std::ops::Range<u32>, segment: u32) -> Self {
        Self { strand, segment }
    }

    #[inline]
    pub(crate) fn is_segment(&self, number: u32) -> bool {
        self.segment == number
    }

    #[inline]
    pub(crate) fn is_strand_of(&self, number: u32) -> bool {
        self.strand.contains(&number)
    }
}

/// Whether the fibre left is still around the ray at `t`: whether that is within the unbroken stretch
/// inside the strand that starts at the ray's origin. Entries in there are joints passed from within.
///
/// The strand is taken wider by the rounding of the origin and of its points, or a ray that grazes a
/// straight strand would come out of one segment and into the next.
pub(crate) fn still_inside(pose: &impl Pose, departure: &Departure, line: &Line, t: f64) -> bool {
    let span = |number| {
        let (a, b) = pose.ends(number)?;
        let size = a.xyz().abs().max(b.xyz().abs()).max_element();
        let size = f64::from(size).max(line.origin.abs().max_element());
        ConeSphere::new(a, b).inflated(2.0 * f64::from(f32::EPSILON) * size).span(line)
    };
    let mut out = span(departure.segment).map_or(0.0, |(_, exit)| exit.max(0.0));
    loop {
        if t <= out {
            return true;
        }
        let before = out;
        for forward in [true, false] {
            out = extended(pose, departure, line, out, forward, span);
        }
        if out <= before {
            return false;
        }
    }
}

/// Follows the strand one way for as long as its segments take over before `out`.
fn extended(
    pose: &impl Pose,
    departure: &Departure,
    line: &Line,
    mut out: f64,
    forward: bool,
    span: impl Fn(u32) -> Option<(f64, f64)>,
) -> f64 {
    let mut number = departure.segment;
    loop {
        let next = if forward { number.checked_add(1) } else { number.checked_sub(1) };
        let Some(next) = next.filter(|n| departure.strand.contains(n)) else { return out };
        let Some(cone) = pose.cone(next) else { return out };
        match span(next) {
            Some((entry, exit)) if entry <= out && exit >= 0.0 => out = out.max(exit),
            // A bend shorter than the strand is wide: the one after it may still take over.
            _ if cone.distance(line.at(out)) <= cone.ra.max(cone.rb) => {}
            _ => return out,
        }
        number = next;
    }
}

/// Whether an entry into a segment is inside one of its neighbours, so not on the union's surface. From
/// outside such an entry comes after the neighbour's own; from inside it must not count.
#[inline]
pub(crate) fn is_inner(pose: &impl Pose, number: u32, cone: &ConeSphere, at: DVec3) -> bool {
    let near = cone.ra.max(cone.rb) * 2.0;
    [true, false].into_iter().any(|forward| {
        let mut here = number;
        for _ in 0..NEIGHBOURS {
            let next = if forward { here.checked_add(1) } else { here.checked_sub(1) };
            let Some((next, (a, b))) = next.and_then(|n| Some((n, pose.ends(n)?))) else {
                return false;
            };
            let joint = if forward { a } else { b };
            if (joint.xyz().as_dvec3() - at).length_squared() > near * near {
                return false;
            }
            let neighbour = ConeSphere::new(a, b);
            if neighbour.distance(at) < -ON_SURFACE * neighbour.ra.max(neighbour.rb) {
                return true;
            }
            here = next;
        }
        false
    })
}
