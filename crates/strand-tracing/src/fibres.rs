//! The strands' points in one array, and what it means for a ray to be inside a fibre.
//!
//! A segment's number is the index of its first point, so its data is the 32 bytes from there on, its
//! neighbours along the strand lie beside it, and the tree's leaves need no table of indices.

use glam::{DVec3, Vec4, Vec4Swizzles};

use crate::cone_sphere::ConeSphere;
use crate::line::Line;
use crate::{Primitive, Radii, Strands, TracingError};

/// An entry point counts as inside a neighbour when it is deeper than this share of the radius: points on
/// the joint they share are on both surfaces.
const ON_SURFACE: f64 = 1e-5;
/// How many neighbours along the strand are looked at on either side for an entry inside them.
const NEIGHBOURS: u32 = 8;

/// All strands of all objects.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fibres {
    /// Position and radius. The radius of a strand's last point has its sign bit set: no segment starts
    /// there.
    points: Vec<Vec4>,
    /// First point of every strand, object after object, then the number of points.
    firsts: Vec<u32>,
    /// First strand of every object, then the number of strands.
    objects: Vec<u32>,
    /// Directions of segments without length, sorted by number.
    borrowed: Vec<(u32, DVec3)>,
}

/// The stretch a ray starts in while it is still inside the fibre it leaves.
pub(crate) struct Departure {
    /// Numbers of the strand's points.
    strand: std::ops::Range<u32>,
    segment: u32,
}

impl Fibres {
    pub(crate) fn gather(strands: &[Strands]) -> Result<Self, TracingError> {
        let mut fibres = Self::default();
        if strands.iter().all(|s| s.positions.is_empty()) {
            return Ok(fibres);
        }
        let total: usize = strands.iter().map(|s| s.positions.len()).sum();
        fibres.points.reserve_exact(total);
        fibres.firsts.reserve_exact(strands.iter().map(|s| s.offsets.len()).sum::<usize>() + 1);
        for (object, strands) in strands.iter().enumerate() {
            fibres.objects.push(fibres.firsts.len() as u32);
            fibres.append(object, strands)?;
        }
        fibres.objects.push(fibres.firsts.len() as u32);
        fibres.firsts.push(fibres.points.len() as u32);
        fibres.borrow_directions();
        Ok(fibres)
    }

    fn append(&mut self, object: usize, strands: &Strands) -> Result<(), TracingError> {
        check_offsets(object, strands)?;
        check_radii(object, strands)?;
        let base = self.points.len() as u32;
        for (point, &position) in strands.positions.iter().enumerate() {
            if !position.is_finite() {
                return Err(TracingError::Position { object, point, found: position });
            }
            let radius = match strands.radii {
                Radii::Constant(radius) => radius,
                Radii::PerVertex(radii) => radii[point],
            };
            self.points.push(position.extend(radius.abs()));
        }
        for pair in strands.offsets.windows(2) {
            self.firsts.push(base + pair[0]);
            if pair[1] > pair[0] {
                let last = &mut self.points[(base + pair[1] - 1) as usize];
                last.w = -last.w.abs();
            }
        }
        Ok(())
    }

    /// Gives every segment without length the direction of the nearest one of its strand that has one.
    fn borrow_directions(&mut self) {
        let without: Vec<u32> =
            self.numbers().filter(|&n| self.cone(n).is_some_and(|c| c.ab == DVec3::ZERO)).collect();
        for number in without {
            let direction = (1..=self.points.len() as u32)
                .map_while(|step| {
                    let back = number.checked_sub(step).filter(|&n| self.joined(n, number));
                    let forth = number.checked_add(step).filter(|&n| self.joined(number, n));
                    (back.is_some() || forth.is_some()).then_some([back, forth])
                })
                .flatten()
                .flatten()
                .filter_map(|n| self.cone(n))
                .find(|c| c.ab != DVec3::ZERO)
                .map_or(DVec3::Y, |c| c.ab.normalize_or(DVec3::Y));
            self.borrowed.push((number, direction));
        }
    }

    /// Whether two numbers are segments of one strand, from the table of strands.
    fn joined(&self, low: u32, high: u32) -> bool {
        self.cone(low).is_some() && self.cone(high).is_some() && self.strand_of(low) == self.strand_of(high)
    }

    fn strand_of(&self, number: u32) -> usize {
        self.firsts.partition_point(|&first| first <= number).saturating_sub(1)
    }

    pub(crate) fn bytes(&self) -> usize {
        self.points.capacity() * size_of::<Vec4>()
            + (self.firsts.capacity() + self.objects.capacity()) * size_of::<u32>()
            + self.borrowed.capacity() * size_of::<(u32, DVec3)>()
    }

    /// Numbers of all segments, those without radius included.
    fn numbers(&self) -> impl Iterator<Item = u32> {
        (0..self.points.len() as u32).filter(|&n| self.ends(n).is_some())
    }

    /// Numbers of the segments that can be hit.
    pub(crate) fn solid(&self) -> impl Iterator<Item = u32> {
        self.numbers().filter(|&n| self.ends(n).is_some_and(|(a, b)| a.w != 0.0 || b.w != 0.0))
    }

    /// The points of a segment; none where no segment starts.
    #[inline]
    pub(crate) fn ends(&self, number: u32) -> Option<(Vec4, Vec4)> {
        match self.points.get(number as usize..number as usize + 2) {
            Some(&[a, b]) if a.w.is_sign_positive() => Some((a, b)),
            _ => None,
        }
    }

    #[inline]
    pub(crate) fn cone(&self, number: u32) -> Option<ConeSphere> {
        self.ends(number).map(|(a, b)| ConeSphere::new(a, b))
    }

    pub(crate) fn primitive(&self, number: u32) -> Primitive {
        let strand = self.strand_of(number);
        let object = self.objects.partition_point(|&first| first as usize <= strand).saturating_sub(1);
        let segment = number - self.firsts.get(strand).copied().unwrap_or(number);
        let first = self.objects.get(object).copied().unwrap_or(0);
        Primitive::Segment { object: object as u32, strand: strand as u32 - first, segment }
    }

    /// Unit vector from root to tip.
    pub(crate) fn tangent(&self, number: u32, cone: &ConeSphere) -> DVec3 {
        cone.ab.try_normalize().unwrap_or_else(|| {
            match self.borrowed.binary_search_by_key(&number, |&(n, _)| n) {
                Ok(place) => self.borrowed[place].1,
                Err(_) => DVec3::Y,
            }
        })
    }

    /// The segment a ray leaves; none if there is no such segment.
    pub(crate) fn departure(&self, object: u32, strand: u32, segment: u32) -> Option<Departure> {
        let object = object as usize;
        let strand = self.objects.get(object)?.checked_add(strand)?;
        if strand >= *self.objects.get(object + 1)? {
            return None;
        }
        let first = *self.firsts.get(strand as usize)?;
        let end = *self.firsts.get(strand as usize + 1)?;
        let segment = first.checked_add(segment)?;
        (segment < end).then_some(Departure { strand: first..end, segment })
    }

    /// Whether the fibre left is still around the ray at `t`: whether that is within the unbroken stretch
    /// inside the strand that starts at the ray's origin. Entries in there are joints passed from within.
    ///
    /// The strand is taken wider by the rounding of the origin and of its points, or a ray that grazes a
    /// straight strand would come out of one segment and into the next.
    pub(crate) fn still_inside(&self, departure: &Departure, line: &Line, t: f64) -> bool {
        let span = |number| {
            let (a, b) = self.ends(number)?;
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
                out = self.extended(departure, line, out, forward, span);
            }
            if out <= before {
                return false;
            }
        }
    }

    /// Follows the strand one way for as long as its segments take over before `out`.
    fn extended(
        &self,
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
            let Some(cone) = self.cone(next) else { return out };
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
    pub(crate) fn is_inner(&self, number: u32, cone: &ConeSphere, at: DVec3) -> bool {
        let near = cone.ra.max(cone.rb) * 2.0;
        [true, false].into_iter().any(|forward| {
            let mut here = number;
            for _ in 0..NEIGHBOURS {
                let next = if forward { here.checked_add(1) } else { here.checked_sub(1) };
                let Some((next, (a, b))) = next.and_then(|n| Some((n, self.ends(n)?))) else {
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
}

impl Departure {
    #[inline]
    pub(crate) fn is_segment(&self, number: u32) -> bool {
        self.segment == number
    }

    #[inline]
    pub(crate) fn is_strand_of(&self, number: u32) -> bool {
        self.strand.contains(&number)
    }
}

fn check_offsets(object: usize, strands: &Strands) -> Result<(), TracingError> {
    let wrong = |index: usize, found: u32, expected: String| TracingError::Offsets {
        object,
        index,
        found: u64::from(found),
        expected,
    };
    let count = strands.positions.len();
    match (strands.offsets.first(), strands.offsets.last()) {
        (None, _) if count == 0 => return Ok(()),
        (Some(&first), _) if first != 0 => return Err(wrong(0, first, "0".into())),
        (Some(_), Some(&last)) if last as usize == count => {}
        (_, last) => {
            let index = strands.offsets.len().saturating_sub(1);
            let expected = format!("{count}, the number of points");
            return Err(wrong(index, last.copied().unwrap_or(0), expected));
        }
    }
    match strands.offsets.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(before) => {
            let [low, found] = [strands.offsets[before], strands.offsets[before + 1]];
            Err(wrong(before + 1, found, format!("{low} or more")))
        }
        None => Ok(()),
    }
}

fn check_radii(object: usize, strands: &Strands) -> Result<(), TracingError> {
    let expected = strands.positions.len();
    let radii = match &strands.radii {
        Radii::Constant(radius) => std::slice::from_ref(radius),
        Radii::PerVertex(radii) if radii.len() == expected => *radii,
        Radii::PerVertex(radii) => {
            return Err(TracingError::RadiusCount { object, found: radii.len(), expected });
        }
    };
    match radii.iter().position(|r| !(0.0..=f32::MAX).contains(r)) {
        Some(point) => Err(TracingError::Radius { object, point, found: radii[point] }),
        None => Ok(()),
    }
}
